// Positions denser than a gas can be mixed at: grains placed anywhere are pushed apart until none overlaps, that is,
// the energy of soft, frictionless grains is brought to zero (O'Hern, Silbert, Liu and Nagel 2003) by the minimiser
// FIRE (Bitzek et al. 2006). It succeeds below the density at which the grains jam: about 0.84 for disks, 0.64 for
// spheres, more if their sizes differ much. What comes out is no gas in equilibrium: neighbours stand close, as on the
// way to jamming. Only + - * / and roots: the same bits everywhere.
#pragma once
#include "dem/state/packing.hpp"

namespace isostat {

// Leaves at least `gap` [a] between all surfaces; false, with the bodies somewhere on the way, if they jam.
template <int D>
bool push_apart(const PeriodicCell<D>& cell, double gap, Bodies<D>& bodies);

}  // namespace isostat
