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

template <int D>
std::string Percolation<D>::direction() const {
  std::string axes;
  for (std::size_t k = 0; k < D; ++k)
    if (winding[k] != 0) axes += "xyz"[k];
  return axes;
}

template <int D>
std::optional<Percolation<D>> force_percolation(const Packing<D>& packing) {
  std::vector<double> force(packing.links.size());
  for (std::size_t l = 0; l < force.size(); ++l) force[l] = force_magnitude(packing.links[l]);
  std::vector<std::size_t> order(force.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return force[a] != force[b] ? force[a] > force[b] : a < b; });
  PlacedSets<D> clusters(packing.bodies.size());
  for (const std::size_t l : order) {
    const Link<D>& link = packing.links[l];
    const auto winding = clusters.join(link.i, link.j, link.shift);
    if (winding && *winding != ImageShift<D>{}) return Percolation<D>{force[l], *winding};
  }
  return std::nullopt;
}

template struct Percolation<2>;
template struct Percolation<3>;
template std::optional<Percolation<2>> force_percolation(const Packing<2>&);
template std::optional<Percolation<3>> force_percolation(const Packing<3>&);

namespace {

template <int D>
nlohmann::ordered_json percolation_of(const Packing<D>& packing) {
  if (const auto p = force_percolation(packing)) return {{"F_perc", p->force}, {"direction", p->direction()}};
  return {{"F_perc", nullptr}, {"direction", nullptr}};
}

}  // namespace

nlohmann::ordered_json percolation_section(const AnalysisInput& input, const AnalysisOptions&) {
  return input.packing_3d ? percolation_of(*input.packing_3d) : percolation_of(input.packing());
}

}  // namespace isostat
