// Hierarchical insertion as seed 000, Sec. 3 tells it: every random point is drawn, every grain is looked at, in a box
// with all its images.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "dem/sample/enclosure.hpp"
#include "dem/solver/random.hpp"

namespace isostat::oracle {

template <int D>
struct BlindPacking {
  Enclosure<D> room;
  std::vector<Vec<D>> position;
  std::vector<double> radius;
};

// Distance of a point from the nearest image of another.
template <int D>
double image_distance(const Enclosure<D>& room, const Vec<D>& a, const Vec<D>& b) {
  Vec<D> d = b - a;
  for (int k = 0; room.cell && k < D; ++k) {
    const double l = room.cell->length[k];
    d[k] = std::min({std::abs(d[k] - l), std::abs(d[k]), std::abs(d[k] + l)});
  }
  return norm(d);
}

// Radius of a grain there, alone, that touches the shell or its own image.
template <int D>
double alone(const Enclosure<D>& room, const Vec<D>& x) {
  return room.cell ? *std::min_element(room.cell->length.c.begin(), room.cell->length.c.end()) / 2
                   : room.shell_radius - norm(x);
}

// Gap between grain k and the nearest surface: grain, own image or shell.
template <int D>
double nearest_gap(const Enclosure<D>& room, const std::vector<Vec<D>>& x, const std::vector<double>& r,
                   std::size_t k) {
  double gap = alone(room, x[k]) - r[k];
  for (std::size_t i = 0; i < x.size(); ++i)
    if (i != k) gap = std::min(gap, image_distance(room, x[k], x[i]) - r[k] - r[i]);
  return gap;
}

template <int D>
Vec<D> random_point(const Enclosure<D>& room, Random& random) {
  const Frame<D> frame = room.frame();
  for (;;) {
    Vec<D> x;
    for (int k = 0; k < D; ++k) x[k] = frame.origin[k] + frame.length[k] * random.uniform();
    if (room.cell || norm(x) < room.shell_radius) return x;
  }
}

// free(x, r): has a grain room there? taken(x, r): it is put there. Returns the trials.
template <int D, class Free, class Taken>
double place_blind(const Enclosure<D>& room, const std::vector<double>& radii, double trials, Random& random,
                   const Free& free, const Taken& taken) {
  double all = 0;
  for (const double r : radii)
    for (double trial = 0; trial < trials; ++trial, ++all) {
      const Vec<D> x = random_point(room, random);
      if ((!room.cell && norm(x) + r > room.shell_radius) || !free(x, r)) continue;
      taken(x, r);
      break;
    }
  return all;
}

template <int D>
BlindPacking<D> place_blind(const Enclosure<D>& room, const std::vector<double>& radii, double trials, Random random) {
  BlindPacking<D> p{room, {}, {}};
  const auto free = [&](const Vec<D>& x, double r) {
    for (std::size_t i = 0; i < p.position.size(); ++i)
      if (image_distance(room, x, p.position[i]) < r + p.radius[i]) return false;
    return true;
  };
  place_blind(room, radii, trials, random, free,
              [&](const Vec<D>& x, double r) { p.position.push_back(x), p.radius.push_back(r); });
  return p;
}

template <int D>
std::vector<double> grow_blind(const Enclosure<D>& room, const std::vector<Vec<D>>& x, std::vector<double> radius,
                               double most) {
  for (std::size_t k = 0; k < x.size(); ++k) {
    double to = alone(room, x[k]);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (i != k) to = std::min(to, image_distance(room, x[k], x[i]) - radius[i]);
    radius[k] = std::max(radius[k], std::min(to, most));
  }
  return radius;
}

}  // namespace isostat::oracle
