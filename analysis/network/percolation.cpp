// Section "percolation".
#include "analysis/network/percolation.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "analysis/network/force_scale.hpp"
#include "analysis/network/sections.hpp"
#include "geometry/placed_sets.hpp"

namespace isostat {

std::string Percolation::direction() const {
  return std::string(winding[0] != 0 ? "x" : "") + (winding[1] != 0 ? "y" : "");
}

std::optional<Percolation> force_percolation(const Packing<2>& packing) {
  std::vector<double> force(packing.links.size());
  for (std::size_t l = 0; l < force.size(); ++l) force[l] = force_magnitude(packing.links[l]);
  std::vector<std::size_t> order(force.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return force[a] != force[b] ? force[a] > force[b] : a < b; });
  PlacedSets<2> clusters(packing.bodies.size());
  for (const std::size_t l : order) {
    const Link<2>& link = packing.links[l];
    const auto winding = clusters.join(link.i, link.j, link.shift);
    if (winding && *winding != ImageShift<2>{}) return Percolation{force[l], *winding};
  }
  return std::nullopt;
}

nlohmann::ordered_json percolation_section(const AnalysisInput& input, const AnalysisOptions&) {
  nlohmann::ordered_json json{{"F_perc", nullptr}, {"direction", nullptr}};
  if (const auto p = force_percolation(input.packing())) json = {{"F_perc", p->force}, {"direction", p->direction()}};
  return json;
}

}  // namespace isostat
