#include "analysis/conditions.hpp"

namespace isostat {

Conditions::Conditions(const AnalysisInput& input) {
  if (!input.has_law()) return;
  const auto take = [&](const auto& stress) { stress_.assign(stress.begin(), stress.end()); };
  if (input.spheres_state) {
    spheres_ = input.spheres_state->law;
    take(input.spheres_state->imposed_stress);
  } else if (input.triangles) {
    triangles_ = input.triangles->law;
    take(input.triangles->imposed_stress);
  } else {
    const auto& [kn, kt, zeta, mu, mu_r, kr, f0, d0] = input.state.law;
    disks_ = {kn, kt, zeta, mu, mu_r, kr, f0, d0};
    take(input.state.imposed_stress);
  }
}

std::string Conditions::difference(const Conditions& other) const {
  const bool law = disks_ != other.disks_ || !(spheres_ == other.spheres_) || !(triangles_ == other.triangles_);
  const bool stress = stress_ != other.stress_;
  return law && stress ? "laws and imposed stresses" : law ? "laws" : stress ? "imposed stresses" : "";
}

}  // namespace isostat
