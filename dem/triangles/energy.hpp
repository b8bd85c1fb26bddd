// Where the energy of a state of triangle grains is [erg].
#pragma once
#include "dem/state/energy.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

struct TriangleEnergies {
  double kinetic = 0;   // translation and rotation of the triangles
  double beams = 0;     // E (L - L0)^2/2 + (EI/L0)(2 Ta^2 + 2 Ta Tb + 2 Tb^2)
  double overlaps = 0;  // Y A_c^2/(2 L_c); not a number with the paper's law, whose forces have no energy
  double springs = 0;   // T^2/(2 k_t)
  double weight = 0;    // m g y
  EnergyLedger ledger;
  double stored() const { return kinetic + beams + overlaps + springs + weight; }
  // Constant in an exact integration, but for what beams take along that break or yield.
  double total() const { return stored() + dissipated(ledger) - put_in(ledger); }
};
TriangleEnergies energies(const State<TriangleGrains>& state);

}  // namespace isostat
