// Bases of the two null spaces of G in double precision, their dimensions known exactly beforehand.
#pragma once
#include <vector>

#include "analysis/input.hpp"
#include "analysis/sphere_network.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

struct NullVector {
  std::vector<double> value;  // by column of G (floppy mode) or by row of G (self-stress); largest magnitude 1
  double residual = 0;        // largest |G u| or |G^T f|
};

// Floppy modes, rigid motions included: the first `most` of K. Each belongs to one dependent column of the elimination
// and lives on what was eliminated before it.
std::vector<NullVector> floppy_modes(const LinkNetwork& network, NetworkLaw law, bool cell_free, std::size_t most);
std::vector<NullVector> floppy_modes(const SphereNetwork& network, NetworkLaw law, bool cell_free, std::size_t most);

// Self-stress states, first those that live on one rigid cluster each, then those that do not (gears): the first `most`
// of H. Orthogonal to each other.
std::vector<NullVector> self_stress_states(const LinkNetwork& network, NetworkLaw law, bool cell_free,
                                           std::size_t most);
std::vector<NullVector> self_stress_states(const SphereNetwork& network, NetworkLaw law, bool cell_free,
                                           std::size_t most);

// Link forces split as f = balancing + self_stress: the first is G x and balances the same load, the second is in
// null G^T; the two are orthogonal.
struct ForceSplit {
  std::vector<double> balancing, self_stress;
  double residual = 0;  // largest |G^T self_stress|
};
ForceSplit split_forces(const LinkNetwork& network, NetworkLaw law, bool cell_free, const std::vector<double>& forces);
ForceSplit split_forces(const SphereNetwork& network, NetworkLaw law, bool cell_free,
                        const std::vector<double>& forces);

}  // namespace isostat
