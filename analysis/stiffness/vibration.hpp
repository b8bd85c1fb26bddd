// Vibration modes of the grains in a fixed cell: K u = omega^2 M u.
#pragma once
#include <vector>

#include "analysis/input.hpp"
#include "analysis/stiffness/lowest_modes.hpp"
#include "dem/scene/scene.hpp"

namespace isostat {

struct VibrationModes {
  int per_body = 3;             // 2 for frictionless networks without beams
  std::int64_t zero_modes = 0;  // K, exact; not among those below
  std::vector<double> omega;    // [1/T0] ascending magnitude; -|omega| for an unstable mode (omega^2 < 0)
  std::vector<std::vector<double>> displacement;  // by mode: per_body numbers a body (vx, vy, spin), M-orthonormal
  // By mode: 1 / (bodies sum e_i^2), e_i the share of body i in the kinetic energy. 1 where all share alike, 1/bodies
  // where one has it all.
  std::vector<double> participation;
  bool converged = true;
};

// Diagonal of M by column of G in a fixed cell: masses and, with spins, inertias. Throws InputError unless positive.
std::vector<double> dof_masses(const LinkNetwork& network, NetworkLaw network_law);

// The `count` modes of smallest |omega| > 0; kAllModes (lowest_modes.hpp): all. Throws InputError for grains without
// mass; FactorisationFailed as in lowest_modes.hpp.
VibrationModes vibration_modes(const LinkNetwork& network, NetworkLaw network_law, const DiskLaw& law, int count,
                               bool displacements);

// The vectors of `lowest` and what follows from them into `modes`. mass: by column.
void take_modes(VibrationModes& modes, LowestModes lowest, const std::vector<double>& mass, bool displacements);

// Of contacts between disks: the state's own law, or the default of a network with what --stiffness says
// (distant links -K_N/100).
DiskLaw law_of(const AnalysisInput& input, const AnalysisOptions& options = {});

}  // namespace isostat
