#include "analysis/stiffness/vibration.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/stiffness/lowest_modes.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "dem/input_error.hpp"

namespace isostat {

namespace {
constexpr double kDistantStiffness = 0.01;  // F0/D0 over K_N, as in the default scene
}

DiskLaw law_of(const AnalysisInput& input, const AnalysisOptions& options) {
  if (input.has_law() && !input.triangles) return input.state.law;
  DiskLaw law = default_network_law();
  const std::vector<double>& given = options.stiffness;
  if (!given.empty()) {
    law.normal_stiffness = given[0];
    law.tangential_stiffness = given.size() > 1 ? given[1] : given[0];
    law.rolling_stiffness = given.size() > 2 ? given[2] : 1e-4 * given[0];
    law.attraction_range = law.attraction / (kDistantStiffness * given[0]);
  }
  return law;
}

std::vector<double> dof_masses(const LinkNetwork& network, NetworkLaw network_law) {
  const Packing<2>& packing = network.packing;
  std::vector<double> mass;
  const bool spins = dof_layout(network, network_law, false).per_body == 3;
  for (std::size_t i = 0; i < static_cast<std::size_t>(network.free); ++i) {
    if (!(packing.bodies.mass[i] > 0) || !(packing.bodies.inertia[i] > 0))
      throw InputError("bodies", 0, "mass", std::to_string(packing.bodies.mass[i]),
                       "vibrations need positive masses and inertias");
    mass.insert(mass.end(), {packing.bodies.mass[i], packing.bodies.mass[i]});
    if (spins) mass.push_back(packing.bodies.inertia[i]);
  }
  return mass;
}

void take_modes(VibrationModes& modes, LowestModes lowest, const std::vector<double>& mass, bool displacements) {
  modes.converged = lowest.converged;
  for (const double lambda : lowest.value) modes.omega.push_back(lambda >= 0 ? std::sqrt(lambda) : -std::sqrt(-lambda));
  const auto per_body = static_cast<std::size_t>(modes.per_body);
  for (const std::vector<double>& u : lowest.vector) {
    double squares = 0;
    for (std::size_t first = 0; first < u.size(); first += per_body) {
      double share = 0;  // they add up to 1
      for (std::size_t c = first; c < first + per_body; ++c) share += mass[c] * u[c] * u[c];
      squares += share * share;
    }
    modes.participation.push_back(static_cast<double>(per_body) / (static_cast<double>(u.size()) * squares));
  }
  if (displacements) modes.displacement = std::move(lowest.vector);
}

VibrationModes vibration_modes(const LinkNetwork& network, NetworkLaw network_law, const DiskLaw& law, int count,
                               bool displacements) {
  const RigidityMatrix g = rigidity_matrix(network, network_law, false);
  const std::vector<double> k = row_stiffness(network, g, law);
  const std::vector<char> dependent = dependent_columns(network, network_law, false);

  VibrationModes modes;
  modes.per_body = g.layout.per_body;
  const std::vector<double> mass = dof_masses(network, network_law);
  modes.zero_modes = std::count(dependent.begin(), dependent.end(), 1);
  const bool definite = std::all_of(k.begin(), k.end(), [](double v) { return v > 0; });
  take_modes(modes, lowest_modes(weighted_normal_matrix(g, k), dependent, mass, count, definite, true), mass,
             displacements);
  return modes;
}

}  // namespace isostat
