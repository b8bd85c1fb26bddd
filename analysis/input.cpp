#include "analysis/input.hpp"

#include "dem/input_error.hpp"

namespace isostat {

NetworkLaw AnalysisInput::network_law(const AnalysisOptions& options) const {
  if (options.law) return *options.law;
  if (!state || !(state->law.normal_stiffness > 0)) return NetworkLaw::friction;
  if (!(state->law.friction > 0)) return NetworkLaw::frictionless;
  return state->law.rolling_friction > 0 ? NetworkLaw::rolling : NetworkLaw::friction;
}

const Packing<2>& AnalysisInput::planar(std::string_view section) const {
  if (packing_3d) refuse_section(*this, section, "is defined for packings in the plane; this one is in 3D");
  return packing;
}

void refuse_section(const AnalysisInput& input, std::string_view section, std::string why) {
  throw InputError(input.path, 0, "--only", std::string(section), std::move(why));
}

}  // namespace isostat
