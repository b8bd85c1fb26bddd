// A periodic rectangular (3D: cuboid) cell with edges along the axes, and the images of a body in it.
#pragma once
#include <array>
#include <cmath>

#include "geometry/vec.hpp"

namespace isostat {

template <int D>
using ImageShift = std::array<int, D>;  // [cells] image of body j that a pair (i, j) is about

template <int D>
struct PeriodicCell {
  Vec<D> length{};  // [a] edges L1, L2(, L3)

  // Vector to add to r_j so that it becomes the image meant by the shift.
  Vec<D> offset(const ImageShift<D>& shift) const {
    Vec<D> o;
    for (int k = 0; k < D; ++k) o[k] = shift[static_cast<std::size_t>(k)] * length[k];
    return o;
  }

  // Shift of the image of j nearest to i, from the raw separation r_j - r_i.
  ImageShift<D> nearest_image(const Vec<D>& separation) const {
    ImageShift<D> s{};
    for (int k = 0; k < D; ++k)
      s[static_cast<std::size_t>(k)] = -static_cast<int>(std::lround(separation[k] / length[k]));
    return s;
  }

  // The point's image inside [0, L).
  Vec<D> wrap(Vec<D> r) const {
    for (int k = 0; k < D; ++k) {
      r[k] -= length[k] * std::floor(r[k] / length[k]);
      if (r[k] >= length[k]) r[k] = 0;  // -1e-17 wraps to L by rounding
    }
    return r;
  }

  double measure() const {
    double a = 1;
    for (int k = 0; k < D; ++k) a *= length[k];
    return a;
  }
};

}  // namespace isostat
