// Section "stress": Eq. 3 with each pair once, and the Rumpf formula against the mean normal force (Eqs. 15-18).
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/network/coordination.hpp"
#include "analysis/network/principal.hpp"
#include "analysis/network/sections.hpp"
#include "analysis/network/triangle_sections.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/balance_3d.hpp"
#include "dem/state/link_ends.hpp"

namespace isostat {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

// Eq. 17 with D = 2 solved for F_N = pi P <d^2> / (<d> z Phi); Eq. 18 is its value for d uniform in [a/2, a]. With D =
// 3 it is pi P <d^3> / (<d> z Phi).
double rumpf_force(const Packing<2>& packing, double pressure, double z) {
  double sum_d = 0, sum_d2 = 0;
  for (const double r : packing.bodies.radius) sum_d += 2 * r, sum_d2 += 4 * r * r;
  const double phi = std::numbers::pi / 4 * sum_d2 / packing.cell->measure();
  return z > 0 ? std::numbers::pi * pressure * sum_d2 / (sum_d * z * phi) : kUndefined;
}
double rumpf_force(const Packing<3>& packing, double pressure, double z) {
  double sum_d = 0, sum_d3 = 0;
  for (const double r : packing.bodies.radius) sum_d += 2 * r, sum_d3 += 8 * r * r * r;
  const double phi = std::numbers::pi / 6 * sum_d3 / packing.cell->measure();
  return z > 0 ? std::numbers::pi * pressure * sum_d3 / (sum_d * z * phi) : kUndefined;
}

// Mean over the interactions.
template <int D>
double mean_normal_force(const Packing<D>& packing, const Coordination& c) {
  double sum = 0;
  for (std::size_t l = 0; l < packing.links.size(); ++l)
    if (c.counted[l]) sum += packing.links[l].normal_force;
  const auto interactions = static_cast<double>(c.contacts + c.distant);
  return interactions > 0 ? sum / interactions : kUndefined;
}

// <N (R_i + R_j)> over the interactions. To h << R_i + R_j it is Rumpf's force times <d>; Eq. 16 puts <N> <d> in its
// place.
template <int D>
double mean_force_diameter(const Packing<D>& packing, const Coordination& c) {
  double sum = 0;
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const LinkEnds<D> end = ends(packing, packing.links[l]);
    if (c.counted[l]) sum += packing.links[l].normal_force * (end.radius_i + end.radius_j);
  }
  const auto interactions = static_cast<double>(c.contacts + c.distant);
  return interactions > 0 ? sum / interactions : kUndefined;
}

// <n_a n_b> over the interactions: its trace is 1.
template <int D>
nlohmann::ordered_json fabric(const Packing<D>& packing, const Coordination& c) {
  Tensor<D> sum{};
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    if (!c.counted[l]) continue;
    const Vec<D> r = ends(packing, packing.links[l]).branch, n = r / norm(r);
    for (int a = 0; a < D; ++a) sum[static_cast<std::size_t>(a)] += n[a] * n;
  }
  const auto interactions = static_cast<double>(c.contacts + c.distant);
  nlohmann::ordered_json json;
  for (Vec<D>& row : sum) row = interactions > 0 ? row / interactions : kUndefined * row;
  for (const Vec<D>& row : sum) json["tensor"].push_back(row.c);
  add_principal<D>(json, sum);
  return json;
}

nlohmann::ordered_json stress_of_spheres(const Packing<3>& packing, const ForceReading& reading) {
  const StressTensor3 s = measured_stress(packing);
  const Coordination c = coordination(packing, reading);
  const double pressure = (s[0][0] + s[1][1] + s[2][2]) / 3;
  nlohmann::ordered_json json;
  json["tensor"] = {s[0].c, s[1].c, s[2].c};
  add_principal<3>(json, s);
  json["pressure"] = pressure;
  json["rumpf_force"] = rumpf_force(packing, pressure, mean_degree(packing, c));
  json["mean_normal_force"] = mean_normal_force(packing, c);
  json["mean_force_diameter"] = mean_force_diameter(packing, c);
  json["fabric"] = fabric(packing, c);
  return json;
}

}  // namespace

nlohmann::ordered_json stress_section(const AnalysisInput& input, const AnalysisOptions&) {
  if (input.triangles) return triangle_stress(*input.triangles);
  if (input.packing_3d) return stress_of_spheres(*input.packing_3d, read_forces(input));
  const Packing<2>& packing = input.packing();
  const ForceReading reading = read_forces(input);
  const StressTensor s = measured_stress(packing);
  const Coordination c = coordination(packing, reading);
  const auto interactions = static_cast<double>(c.contacts + c.distant);
  nlohmann::ordered_json json;
  json["tensor"] = {{s.xx, s.xy}, {s.yx, s.yy}};
  add_principal<2>(json, {Vec2{{s.xx, s.xy}}, Vec2{{s.yx, s.yy}}});
  json["pressure"] = 0.5 * (s.xx + s.yy);
  json["rumpf_force"] =
      rumpf_force(packing, 0.5 * (s.xx + s.yy), 2 * interactions / static_cast<double>(packing.bodies.size()));
  json["mean_normal_force"] = mean_normal_force(packing, c);
  json["mean_force_diameter"] = mean_force_diameter(packing, c);
  json["fabric"] = fabric(packing, c);
  return json;
}

}  // namespace isostat
