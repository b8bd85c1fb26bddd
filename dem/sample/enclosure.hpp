// What grains are put into: a spherical (in the plane circular) rigid shell around the origin, or a periodic box with
// a corner there.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/cell_grid.hpp"
#include "geometry/periodic_cell.hpp"

namespace isostat {

template <int D>
double ball_measure(double radius) {
  static_assert(D == 2 || D == 3);
  return D == 2 ? std::numbers::pi * radius * radius : 4 * std::numbers::pi / 3 * radius * radius * radius;
}

template <int D>
struct Enclosure {
  std::optional<PeriodicCell<D>> cell;  // none: the shell
  double shell_radius = 0;

  static Enclosure shell(double radius) { return {std::nullopt, radius}; }
  static Enclosure box(const Vec<D>& length) { return {PeriodicCell<D>{length}, 0}; }

  double measure() const { return cell ? cell->measure() : ball_measure<D>(shell_radius); }
  Frame<D> frame() const {
    if (cell) return {Vec<D>{}, cell->length, true};
    Frame<D> box;
    for (int k = 0; k < D; ++k) box.origin[k] = -shell_radius, box.length[k] = 2 * shell_radius;
    return box;
  }

  // b - a, in a box to the nearest image; there both points lie in it.
  Vec<D> separation(const Vec<D>& a, const Vec<D>& b) const {
    Vec<D> d = b - a;
    if (cell)
      for (int k = 0; k < D; ++k) {
        const double l = cell->length[k];
        if (d[k] > l / 2)
          d[k] -= l;
        else if (d[k] < -l / 2)
          d[k] += l;
      }
    return d;
  }

  // Radius at which a grain there touches the shell, or its own image.
  double largest_at(const Vec<D>& r) const {
    if (!cell) return shell_radius - norm(r);
    double shortest = cell->length[0];
    for (int k = 1; k < D; ++k) shortest = std::min(shortest, cell->length[k]);
    return shortest / 2;
  }
};

}  // namespace isostat
