#include "dem/sample/placement.hpp"

#include <algorithm>
#include <cmath>

#include "dem/sample/free_volume.hpp"
#include "dem/sample/grain_index.hpp"

namespace isostat {
namespace {

// Radii descend. How many there are in each factor of two below the first.
template <int D>
std::vector<std::size_t> tiers_of(const std::vector<double>& radii, std::size_t count) {
  std::vector<std::size_t> tiers;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t t = GrainIndex<D>::tier(radii.front(), radii[k]);
    if (tiers.size() <= t) tiers.resize(t + 1);
    ++tiers[t];
  }
  return tiers;
}

// Trials up to and with the first success, each of chance p: infinite for p = 0.
double geometric(double p, Random& random) {
  if (p >= 1) return 1;
  return 1 + std::floor(std::log1p(-random.uniform()) / std::log1p(-p));
}

}  // namespace

template <int D>
Placed<D> place(const Enclosure<D>& enclosure, const std::vector<double>& radii, double trials, Random random) {
  GrainIndex<D> grains(enclosure, radii.front(), tiers_of<D>(radii, radii.size()));
  FreeVolume<D> open(enclosure, grains, radii.front(), radii.back());
  Placed<D> placed;
  InsertionWork& work = placed.work;
  for (const double radius : radii) {
    open.descend(radius);
    for (double used = 0;;) {
      const double p = open.fraction(), next = p > 0 ? geometric(p, random) : INFINITY;
      if (used + next > trials) {
        work.blind_trials += trials;
        break;
      }
      used += next;
      const auto point = open.draw(random);
      ++work.points;
      const bool fits = radius <= enclosure.largest_at(point.position);
      const auto* in_the_way = fits ? grains.overlapping(point.position, radius) : nullptr;
      if (!fits || in_the_way) {
        open.refine(point, in_the_way);
        continue;
      }
      const Vec<D> at = enclosure.cell ? enclosure.cell->wrap(point.position) : point.position;  // L by rounding is 0
      grains.add(at, radius);
      placed.position.push_back(at), placed.radius.push_back(radius);
      work.blind_trials += used;
      break;
    }
    work.cells = std::max(work.cells, open.cells());
  }
  work.listed = radii.size();
  return placed;
}

template <int D>
std::vector<double> grown(const Enclosure<D>& enclosure, const Placed<D>& placed, std::size_t count, double most,
                          double kept) {
  if (count == 0) return {};
  GrainIndex<D> grains(enclosure, placed.radius.front(), tiers_of<D>(placed.radius, count));
  for (std::size_t k = 0; k < count; ++k) grains.add(placed.position[k], placed.radius[k]);
  std::vector<double> radius(count);
  for (std::size_t k = 0; k < count; ++k) {
    radius[k] = placed.radius[k];
    if (radius[k] == kept) continue;
    const double alone = std::min(most, enclosure.largest_at(placed.position[k]));
    double free = alone;
    for (double reach = 2 * placed.radius[k];; reach *= 2) {
      grains.any_within(placed.position[k], std::min(reach, alone), [&](std::size_t other, double distance) {
        if (other != k) free = std::min(free, distance - grains.grains()[other].radius);
        return false;
      });
      if (free <= reach) break;
    }
    radius[k] = std::max(placed.radius[k], free);
    grains.grow(k, radius[k]);
  }
  return radius;
}

template Placed<2> place(const Enclosure<2>&, const std::vector<double>&, double, Random);
template Placed<3> place(const Enclosure<3>&, const std::vector<double>&, double, Random);
template std::vector<double> grown(const Enclosure<2>&, const Placed<2>&, std::size_t, double, double);
template std::vector<double> grown(const Enclosure<3>&, const Placed<3>&, std::size_t, double, double);

}  // namespace isostat
