// The energy of a state and its ledger: what is stored in bodies and links, and what has been dissipated or put in.
#pragma once
#include "dem/state/state.hpp"

namespace isostat {

inline double dissipated(const EnergyLedger& e) { return e.viscous + e.sliding + e.rolling + e.drag; }
inline double put_in(const EnergyLedger& e) { return e.cell_work + e.injected + e.wall_work; }

struct Energies {       // all [F0 a]
  double kinetic = 0;   // peculiar translation and rotation, full-step velocities
  double elastic = 0;   // K_N h^2/2 + T^2/(2 K_T) + M^2/(2 K_r)
  double adhesive = 0;  // -F0 D0/2 + F0 h in contact, -F0 (D0 - h)^2/(2 D0) across a gap
  double weight = 0;    // m g y
  EnergyLedger ledger;
  double stored() const { return kinetic + elastic + adhesive + weight; }
  // Constant in an exact integration: stored + dissipated - put in. The error falls with dt^2.
  double total() const { return stored() + dissipated(ledger) - put_in(ledger); }
};

}  // namespace isostat
