#include "analysis/network/force_scale.hpp"

#include <algorithm>
#include <cmath>

#include "dem/disks/certificate.hpp"
#include "dem/spheres/certificate.hpp"
#include "dem/triangles/certificate.hpp"

namespace isostat {

template <>
double force_magnitude(const Link<2>& link) {
  return std::hypot(link.normal_force, link.tangential_force);
}
template <>
double force_magnitude(const Link<3>& link) {
  return std::hypot(link.normal_force, norm(link.tangential_force));
}

namespace {

template <int D>
ForceReading read_foreign(const Packing<D>& packing) {
  ForceReading reading;
  double sum = 0, most_tensile = 0;
  for (const Link<D>& link : packing.links) {
    sum += force_magnitude(link);
    if (link.kind != LinkKind::beam) most_tensile = std::min(most_tensile, link.normal_force);
  }
  if (!(sum > 0)) return reading;
  reading.known = true;
  reading.scale = sum / static_cast<double>(packing.links.size());
  reading.threshold = kLoadTolerance * reading.scale;
  reading.cohesive = most_tensile < -reading.threshold;
  return reading;
}

}  // namespace

ForceReading read_forces(const AnalysisInput& input) {
  if (input.packing_3d) {
    if (!input.spheres_state) return read_foreign(*input.packing_3d);
    const SphereLaw& law = input.spheres_state->law;
    const double scale = force_scale(law, input.spheres_state->imposed_stress);
    return {true, true, law.attraction > 0, scale, kLoadTolerance * scale};
  }
  if (input.triangles) {  // forces follow from the positions
    ForceReading reading;
    reading.known = reading.law_known = true, reading.cohesive = false;
    reading.scale =
        force_scale(input.triangles->packing, input.triangles->imposed_stress, input.triangles->scene.gravity);
    reading.threshold = kLoadTolerance * reading.scale;
    return reading;
  }
  if (!input.has_law()) return read_foreign(input.packing());
  ForceReading reading;
  reading.known = reading.law_known = true;
  reading.cohesive = input.state.law.attraction > 0;
  reading.scale = force_scale(input.state.law, input.state.imposed_stress,
                              heaviest_weight(input.state.packing, input.state.scene.gravity));
  reading.threshold = kLoadTolerance * reading.scale;
  return reading;
}

}  // namespace isostat
