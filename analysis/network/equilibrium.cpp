// Section "equilibrium": the certificate of dem/state/certificate.hpp, recomputed from the file, beside the one it
// stores.
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/network/force_scale.hpp"
#include "analysis/network/sections.hpp"
#include "analysis/plain_number.hpp"
#include "dem/disks/at_rest.hpp"
#include "dem/disks/certificate.hpp"
#include "dem/spheres/certificate.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/balance_3d.hpp"
#include "dem/state/link_ends.hpp"
#include "dem/triangles/certificate.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
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

Json certificate_json(const Certificate& c, bool yields) {
  return {{"max_force", c.max_force},
          {"max_moment", c.max_moment},
          {"pressure_error", c.pressure_controlled ? c.pressure_error : kUndefined},
          {"kinetic_energy_per_grain", c.kinetic_energy_per_grain},
          {"tolerance",
           {{"force", c.tolerance_force},
            {"moment", c.tolerance_force},
            {"pressure", c.pressure_controlled ? c.tolerance_pressure : kUndefined},
            {"kinetic_energy", c.tolerance_kinetic}}},
          {"force_scale", c.force_scale},
          {"sliding", c.sliding},
          {"rolling_yielded", c.rolling_yielded},
          {"smallest_margin", yields ? c.smallest_margin : kUndefined},
          {"moving", c.moving},
          {"inertial_number", c.inertial_number},
          {"stress_error", c.stress_error},
          {"finishing", c.finishing},
          {"equilibrated", c.equilibrated}};
}

template <int D>
bool any_contact(const Packing<D>& packing) {
  return std::any_of(packing.links.begin(), packing.links.end(), [](const Link<D>& l) { return is_contact(l.kind); });
}
template <class Law>
bool can_yield(const Law& law) {
  return law.friction > 0 || law.rolling_friction > 0;
}
bool slides(const State<TriangleGrains>& state) { return state.law.friction > 0 && !state.packing.overlaps.empty(); }

// Walls and their contacts stay with the state.
Json equilibrium_of_spheres(const State<Spheres>& state, const Packing<3>& packing) {
  SpherePacking whole = state.packing;
  static_cast<Packing<3>&>(whole) = packing;
  Certificate c = evaluate_certificate(whole, state.law, state.imposed_stress, state.scene.equilibrium);
  keep_record(c, state.certificate);
  return certificate_json(c, (any_contact(packing) || !whole.wall_links.empty()) && can_yield(state.law));
}

double net_force(const BodyLoad& load) { return std::hypot(load.fx, load.fy); }
double net_force(const BodyLoad3& load) { return norm(load.force); }
double net_moment(const BodyLoad& load) { return std::abs(load.moment); }
double net_moment(const BodyLoad3& load) { return norm(load.moment); }

// What the forces of a packing without a law leave: they are all that is known of its equilibrium.
struct Imbalance {
  double force = 0, moment = 0;  // largest on a grain
  double scale = 0;              // mean |N| of the links
  double diameter = 0;           // of the largest grain
  std::int64_t worst = 0;        // id of the grain with the largest net force
  std::int64_t grains = 0;       // with a net force above kBadBalance scale
};
// Of the mean |N|: a simulation leaves 1e-2 at most, forces measured in an experiment some 5 %.
constexpr double kBadBalance = 0.1;

template <int D>
Imbalance imbalance(const Packing<D>& packing) {
  Imbalance all;
  for (const Link<D>& link : packing.links) all.scale += std::abs(link.normal_force);
  all.scale /= static_cast<double>(packing.links.size());
  const auto loads = net_loads(packing);
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (!is_free(packing.part, k)) continue;
    const double force = net_force(loads[k]);
    if (force > all.force) all.force = force, all.worst = packing.bodies.id[k];
    all.moment = std::max(all.moment, net_moment(loads[k]));
    all.diameter = std::max(all.diameter, 2 * packing.bodies.radius[k]);
    all.grains += force > kBadBalance * all.scale;
  }
  return all;
}
Imbalance imbalance(const AnalysisInput& input) {
  return input.packing_3d ? imbalance(*input.packing_3d) : imbalance(input.packing());
}

Json loads_json(const Imbalance& all) {
  return {{"max_force", all.force / all.scale},
          {"max_moment", all.moment / (all.scale * all.diameter)},
          {"force_scale", all.scale}};
}

}  // namespace

std::string balance_warning(const AnalysisInput& input) {
  if (input.has_law() || !read_forces(input).known) return "";
  const Imbalance all = imbalance(input);
  if (!(all.force > kBadBalance * all.scale)) return "";
  return "forces do not balance: " + std::to_string(all.grains) + " of " + std::to_string(input.grains()) +
         " grains have a net force above " + plain_number(kBadBalance) + " of the mean |N|, grain " +
         std::to_string(all.worst) + " one of " + plain_number(all.force / all.scale) +
         "; what the file leaves out (tangential forces, walls, weight), or a sign";
}

Json equilibrium_section(const AnalysisInput& input, const AnalysisOptions&) {
  if (input.spheres_state) return equilibrium_of_spheres(*input.spheres_state, *input.packing_3d);
  if (input.triangles) {
    Json json = certificate_json(evaluate_certificate(*input.triangles), slides(*input.triangles));
    json.erase("rolling_yielded");  // no rolling resistance
    return json;
  }
  if (!input.has_law()) return loads_json(imbalance(input));
  const State<Disks>& state = input.state;
  const Certificate c = evaluate_certificate(state);
  Json json = certificate_json(c, any_contact(state.packing) && can_yield(state.law));
  json["law_residual"] = law_residual(state, c.force_scale);
  return json;
}

}  // namespace isostat
