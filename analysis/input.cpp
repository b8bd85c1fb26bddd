#include "analysis/input.hpp"

#include <algorithm>

namespace isostat {

std::optional<NetworkLaw> network_law_named(std::string_view name) {
  const auto found = std::find(kNetworkLawNames.begin(), kNetworkLawNames.end(), name);
  if (found == kNetworkLawNames.end()) return std::nullopt;
  return static_cast<NetworkLaw>(found - kNetworkLawNames.begin());
}

NetworkLaw AnalysisInput::network_law(const AnalysisOptions& options) const {
  if (options.law) return *options.law;
  if (!has_law()) return NetworkLaw::friction;
  if (!(state.law.friction > 0)) return NetworkLaw::frictionless;
  return state.law.rolling_friction > 0 ? NetworkLaw::rolling : NetworkLaw::friction;
}

}  // namespace isostat
