// Section "equilibrium": the certificate of dem/state/certificate.hpp, recomputed from the file, beside the one it
// stores.
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/network/force_scale.hpp"
#include "analysis/network/sections.hpp"
#include "analysis/network/triangle_sections.hpp"
#include "dem/disks/at_rest.hpp"
#include "dem/disks/certificate.hpp"
#include "dem/state/balance_3d.hpp"
#include "dem/state/link_ends.hpp"

namespace isostat {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

// Largest difference between a link's stored normal force and the static law at the gap of the stored positions [F1]:
// shows a file whose forces and positions do not belong together.
double law_residual(const State<Disks>& state, double scale) {
  double largest = 0;
  for (const Link<2>& link : state.packing.links) {
    const double gap = frame(ends(state.packing, link)).gap;
    largest = std::max(largest, std::abs(link.normal_force - at_rest(state.law, gap).force));
  }
  return largest / scale;
}

// Without a law: loads only, in units of the mean |F|, and of that times the largest diameter.
nlohmann::ordered_json equilibrium_of_spheres(const Packing<3>& packing, const ForceReading& reading) {
  double force = 0, moment = 0, diameter = 0;
  const std::vector<BodyLoad3> loads = net_loads(packing);
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (!is_free(packing.part, k)) continue;
    force = std::max(force, norm(loads[k].force)), moment = std::max(moment, norm(loads[k].moment));
    diameter = std::max(diameter, 2 * packing.bodies.radius[k]);
  }
  return {{"max_force", force / reading.scale},
          {"max_moment", moment / (reading.scale * diameter)},
          {"force_scale", reading.scale}};
}

}  // namespace

nlohmann::ordered_json equilibrium_section(const AnalysisInput& input, const AnalysisOptions&) {
  if (input.packing_3d) return equilibrium_of_spheres(*input.packing_3d, read_forces(input));
  if (input.triangles) return triangle_equilibrium(*input.triangles);
  const State<Disks>& state = input.state;
  const Certificate c = evaluate_certificate(state);
  const auto contacts = std::count_if(state.packing.links.begin(), state.packing.links.end(),
                                      [](const Link<2>& l) { return is_contact(l.kind); });
  const bool yields = contacts > 0 && (state.law.friction > 0 || state.law.rolling_friction > 0);
  nlohmann::ordered_json json;
  json["max_force"] = c.max_force;
  json["max_moment"] = c.max_moment;
  json["pressure_error"] = c.pressure_controlled ? c.pressure_error : kUndefined;
  json["kinetic_energy_per_grain"] = c.kinetic_energy_per_grain;
  json["tolerance"] = {{"force", c.tolerance_force},
                       {"moment", c.tolerance_force},
                       {"pressure", c.pressure_controlled ? c.tolerance_pressure : kUndefined},
                       {"kinetic_energy", c.tolerance_kinetic}};
  json["force_scale"] = c.force_scale;
  json["sliding"] = c.sliding;
  json["rolling_yielded"] = c.rolling_yielded;
  json["smallest_margin"] = yields ? c.smallest_margin : kUndefined;
  json["law_residual"] = law_residual(state, c.force_scale);
  json["moving"] = c.moving;
  json["finishing"] = c.finishing;
  json["equilibrated"] = c.equilibrated;
  return json;
}

}  // namespace isostat
