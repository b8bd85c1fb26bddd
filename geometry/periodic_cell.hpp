// A periodic cell and the images of a body in it: a rectangle (3D: cuboid) with edges along the axes, or one that is
// sheared along the first. The only place that turns image shifts into vectors and positions into fractions.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/vec.hpp"

namespace isostat {

template <int D>
using ImageShift = std::array<int, D>;  // [cells] image of body j that a pair (i, j) is about

// Edges (L1, 0), (tilt, L2); in 3D (L1, 0, 0), (tilt, L2, 0), (0, 0, L3). Cells whose tilts differ by a multiple of L1
// have the same images. Without tilt every operation gives the bits of the rectangle.
template <int D>
struct PeriodicCell {
  Vec<D> length{};  // [a] L1, L2(, L3): edges of the rectangle of the same area
  double tilt = 0;  // [a] of the second edge along the first

  // Vector to add to r_j so that it becomes the image meant by the shift.
  Vec<D> offset(const ImageShift<D>& shift) const {
    Vec<D> o;
    for (int k = 0; k < D; ++k) o[k] = shift[static_cast<std::size_t>(k)] * length[k];
    o[0] += shift[1] * tilt;
    return o;
  }

  double slant() const { return tilt / length[1]; }  // [-] x of the second edge per y

  // Coordinates along the edges [cells]; and the other way round.
  Vec<D> fractions(const Vec<D>& r) const {
    Vec<D> f;
    for (int k = 0; k < D; ++k) f[k] = (k == 0 ? r[0] - slant() * r[1] : r[k]) / length[k];
    return f;
  }
  Vec<D> point(const Vec<D>& f) const {
    Vec<D> r;
    for (int k = 0; k < D; ++k) r[k] = f[k] * length[k];
    r[0] += f[1] * tilt;
    return r;
  }

  // Distance of opposite edges (3D: faces), which a grid or a cutoff must respect: L_k without tilt [a].
  Vec<D> spacing() const {
    Vec<D> s = length;
    s[0] /= std::sqrt(1 + slant() * slant());
    return s;
  }
  double shortest_spacing() const {
    const Vec<D> s = spacing();
    return *std::min_element(s.c.begin(), s.c.end());
  }

  // Shift of the image of j nearest to i, from the raw separation r_j - r_i. With a tilt the nearest one of a row of
  // images need not be the nearest of all: rows are tried as long as they are nearer than the best so far.
  ImageShift<D> nearest_image(const Vec<D>& separation) const {
    ImageShift<D> s{};
    for (int k = D - 1; k >= 0; --k) s[static_cast<std::size_t>(k)] = nearest_along(separation, k, s);
    if (tilt == 0) return s;
    const auto distance = [&](const ImageShift<D>& shift) { return norm(separation + offset(shift)); };
    ImageShift<D> best = s;
    for (const int way : {-1, 1})
      for (int row = s[1] + way; std::abs(separation[1] + row * length[1]) < distance(best); row += way) {
        ImageShift<D> in_row = s;
        in_row[1] = row, in_row[0] = nearest_along(separation, 0, in_row);
        if (distance(in_row) < distance(best)) best = in_row;
      }
    return best;
  }

  // The point's image inside the cell: fractions in [0, 1).
  Vec<D> wrap(Vec<D> r) const {
    for (int k = D - 1; k >= 0; --k) {
      const double start = k == 0 ? slant() * r[1] : 0, cells = std::floor((r[k] - start) / length[k]);
      r[k] -= length[k] * cells;
      if (k == 1) r[0] -= tilt * cells;
      if (r[k] - start >= length[k]) {  // -1e-17 wraps to L by rounding
        r[k] = start;
        if (k == 1) r[0] -= tilt;
      }
    }
    return r;
  }

  double measure() const {
    double a = 1;
    for (int k = 0; k < D; ++k) a *= length[k];
    return a;
  }

  // By how many L1 the tilt is to be lowered so that it is L1/2 at most: the shape of cell nearest to a rectangle.
  // Image shifts of links then become s1 + turns s2, s2.
  int turns() const { return std::abs(tilt) > 0.5 * length[0] ? static_cast<int>(std::lround(tilt / length[0])) : 0; }

 private:
  int nearest_along(const Vec<D>& separation, int axis, const ImageShift<D>& so_far) const {
    const double x = axis == 0 ? separation[0] + so_far[1] * tilt : separation[axis];
    return -static_cast<int>(std::lround(x / length[axis]));
  }
};

}  // namespace isostat
