#include "analysis/input.hpp"

#include <algorithm>

namespace isostat {

std::optional<NetworkLaw> network_law_named(std::string_view name) {
  const auto found = std::find(kNetworkLawNames.begin(), kNetworkLawNames.end(), name);
  if (found == kNetworkLawNames.end()) return std::nullopt;
  return static_cast<NetworkLaw>(found - kNetworkLawNames.begin());
}

void AnalysisInput::set_triangles(State<TriangleGrains> of_grains, const std::vector<Triangle>& corners) {
  triangle_links = triangle_network(of_grains.packing, corners, of_grains.law);
  triangles = std::move(of_grains);
}

NetworkLaw AnalysisInput::network_law(const AnalysisOptions& options) const {
  if (options.law) return *options.law;
  if (triangles) return triangles->law.friction > 0 ? NetworkLaw::friction : NetworkLaw::frictionless;
  if (!has_law()) return NetworkLaw::friction;
  const auto rows = [](const auto& law) {
    if (!(law.friction > 0)) return NetworkLaw::frictionless;
    return law.rolling_friction > 0 ? NetworkLaw::rolling : NetworkLaw::friction;
  };
  return spheres_state ? rows(spheres_state->law) : rows(state.law);
}

}  // namespace isostat
