#include "analysis/report_units.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace isostat {
namespace {

enum class Kind {
  force,
  scale,
  moment_scale,
  stress_scale,
  stress,
  stiffness,
  moment,
  energy,
  length,
  area,
  wave,
  frequency,
  angle
};

// By section.key; a key of an object that ends so too (fit.xi).
const std::vector<std::pair<std::string_view, Kind>>& kinds() {
  static const std::vector<std::pair<std::string_view, Kind>> table{
      {"equilibrium.max_force", Kind::scale},
      {"equilibrium.max_moment", Kind::moment_scale},
      {"equilibrium.pressure_error", Kind::stress_scale},
      {"equilibrium.kinetic_energy_per_grain", Kind::moment_scale},
      {"equilibrium.tolerance.force", Kind::scale},
      {"equilibrium.tolerance.moment", Kind::moment_scale},
      {"equilibrium.tolerance.pressure", Kind::stress_scale},
      {"equilibrium.tolerance.kinetic_energy", Kind::moment_scale},
      {"equilibrium.force_scale", Kind::force},
      {"equilibrium.law_residual", Kind::scale},
      {"stress.tensor", Kind::stress},
      {"stress.pressure", Kind::stress},
      {"stress.principal", Kind::stress},
      {"stress.deviator", Kind::stress},
      {"stress.rumpf_force", Kind::force},
      {"stress.mean_normal_force", Kind::force},
      {"stress.mean_force_diameter", Kind::moment},
      {"beams.energy", Kind::energy},
      {"beams.largest.tension", Kind::force},
      {"beams.largest.compression", Kind::force},
      {"beams.largest.shear", Kind::force},
      {"beams.largest.moment", Kind::moment},
      {"beams.largest.angle", Kind::angle},
      {"forces.N_plus", Kind::force},
      {"forces.N_minus", Kind::force},
      {"forces.N_plus_2", Kind::force},
      {"forces.N_minus_2", Kind::force},
      {"forces.threshold", Kind::force},
      {"percolation.F_perc", Kind::force},
      {"stressed.threshold", Kind::force},
      {"stressed.above", Kind::force},
      {"stressed.compensation.rim.pressure", Kind::stress},
      {"stressed.compensation.inside.pressure", Kind::stress},
      {"stressed.compensation.bridges.pressure", Kind::stress},
      {"loops.scale", Kind::force},
      {"loops.trees.mean", Kind::force},
      {"loops.trees.rms", Kind::force},
      {"loops.trees.median", Kind::force},
      {"loops.trees.largest", Kind::force},
      {"loops.loops.mean", Kind::force},
      {"loops.loops.rms", Kind::force},
      {"loops.loops.median", Kind::force},
      {"loops.loops.largest", Kind::force},
      {"loops.clusters.mean", Kind::force},
      {"loops.clusters.rms", Kind::force},
      {"loops.clusters.median", Kind::force},
      {"loops.clusters.largest", Kind::force},
      {"stiffness.stiffness.normal", Kind::stiffness},
      {"stiffness.stiffness.tangential", Kind::stiffness},
      {"stiffness.stiffness.distant", Kind::stiffness},
      {"moduli.tensor", Kind::stress},
      {"moduli.stiffness.normal", Kind::stiffness},
      {"moduli.stiffness.tangential", Kind::stiffness},
      {"moduli.stiffness.distant", Kind::stiffness},
      {"modes.omega", Kind::frequency},
      {"modes.density.omega_min", Kind::frequency},
      {"modes.density.omega_max", Kind::frequency},
      {"modes.density.resolution", Kind::frequency},
      {"modes.stiffness.normal", Kind::stiffness},
      {"modes.stiffness.tangential", Kind::stiffness},
      {"modes.stiffness.distant", Kind::stiffness},
      {"pores.mean_radius_weighted", Kind::length},
      {"pores.gap_tolerance", Kind::length},
      {"pores.covered_area", Kind::area},
      {"pores.perimeter", Kind::length},
      {"scattering.k_edges", Kind::wave},
      {"scattering.k", Kind::wave},
      {"scattering.I", Kind::area},
      {"scattering.sigma", Kind::area},
      {"scattering.fit.xi", Kind::length},
      {"scattering.fit.xi_error", Kind::length},
      {"scattering.fit.k_from", Kind::wave},
      {"scattering.fit.k_limit", Kind::wave},
      {"dacf.r", Kind::length},
      {"dacf.slope_at_0", Kind::wave},
      {"dacf.k_cut", Kind::wave},
      {"dacf.cell_area", Kind::area},
      {"dacf.fit.xi", Kind::length},
      {"dacf.fit.xi_error", Kind::length},
      {"dacf.mass_radius.M", Kind::area},
      {"dacf.mass_radius.window", Kind::length},
      {"rdf.r_edges", Kind::length},
  };
  return table;
}

}  // namespace

std::string unit_of(std::string_view key, const nlohmann::ordered_json& units) {
  if (!units.contains("length")) return "";
  const auto word = [&](const char* name) { return units.at(name).get<std::string>(); };
  const std::string length = word("length"), force = word("force"), time = word("time");
  const bool cgs = units.at("system") == "cgs";
  const std::string scale_length = cgs ? "l" : length;  // the root of the area of the largest grain
  const bool space = word("pressure").ends_with("^2");
  for (const auto& [name, kind] : kinds()) {
    if (name != key) continue;
    switch (kind) {
      case Kind::force:
        return force;
      case Kind::scale:
        return "F1";
      case Kind::moment_scale:
        return "F1 " + scale_length;
      case Kind::stress_scale:
        return "F1/" + scale_length + (space ? "^2" : "");
      case Kind::stress:
        return word("pressure");
      case Kind::stiffness:
        return space ? force + "/" + length : word("pressure");
      case Kind::moment:
        return force + " " + length;
      case Kind::energy:
        return cgs ? "erg" : force + " " + length;
      case Kind::length:
        return length;
      case Kind::area:
        return length + "^2";
      case Kind::wave:
        return "1/" + length;
      case Kind::frequency:
        return "1/" + (time.find(' ') == std::string::npos ? time : "(" + time + ")");
      case Kind::angle:
        return "rad";
    }
  }
  return "";
}

}  // namespace isostat
