// What is derived from pores: their mean, their walls as polygons, and the enclosed pores of a packing in the plane.
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/pores.hpp"

namespace isostat {

double mean_radius_weighted(std::span<const Pore> pores) {
  double area = 0, sum = 0;
  for (const auto& p : pores) {
    if (p.percolating || std::isnan(p.equivalent_radius)) continue;
    area += p.area, sum += p.area * p.equivalent_radius;
  }
  return area > 0 ? sum / area : std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::vector<Vec2>> pore_polygons(const Pores& pores, std::size_t pore, double step) {
  const auto& p = pores.pores[pore];
  std::vector<std::vector<Vec2>> loops;
  std::vector<bool> done(p.arcs, false);
  for (std::uint32_t k = 0; k < p.arcs; ++k) {
    if (done[k]) continue;
    auto& loop = loops.emplace_back();
    for (auto n = k; !done[n]; n = pores.arcs[p.first_arc + n].next - p.first_arc) {
      done[n] = true;
      const auto& arc = pores.arcs[p.first_arc + n];
      const int pieces = std::max(1, static_cast<int>(std::ceil(arc.sweep / step)));
      Vec2 centre = arc.centre;
      if (!loop.empty()) {  // go on from where the wall is: a percolating pore has no one frame
        const Vec2 first{centre[0] + arc.radius * std::cos(arc.start), centre[1] + arc.radius * std::sin(arc.start)};
        centre += pores.cell.offset(pores.cell.nearest_image(first - loop.back()));
      }
      for (int m = 0; m <= pieces; ++m) {
        const double angle = arc.start + arc.sweep * m / pieces;
        loop.push_back({centre[0] + arc.radius * std::cos(angle), centre[1] + arc.radius * std::sin(angle)});
      }
    }
  }
  return loops;
}

Pores find_enclosed_pores(std::span<const Vec2> centre, std::span<const double> radius, const PoreOptions& options) {
  if (centre.empty()) return {};
  // In a cell so large that the packing cannot touch its images, the outside is the one pore that percolates.
  Vec2 low = centre[0], high = centre[0];
  double largest = 0;
  for (std::size_t i = 0; i < centre.size(); ++i) {
    for (int k = 0; k < 2; ++k) low[k] = std::min(low[k], centre[i][k]), high[k] = std::max(high[k], centre[i][k]);
    largest = std::max(largest, radius[i]);
  }
  const double margin = largest > 0 ? 4 * largest + 2 * options.gap_tolerance : 1 + 2 * options.gap_tolerance;
  const PeriodicCell<2> cell{{high[0] - low[0] + margin, high[1] - low[1] + margin}};
  Pores out = find_pores(centre, radius, cell, options);
  std::erase_if(out.pores, [](const Pore& p) { return p.percolating; });
  return out;
}

}  // namespace isostat
