// The certificate of a packing of disks, dem/state/certificate.hpp.
#pragma once
#include "dem/disks/disks.hpp"
#include "dem/scene/scene.hpp"
#include "dem/state/certificate.hpp"

namespace isostat {

// F1 = max(F0, a P, heaviest weight of a free grain) [F0], a = 1 the largest diameter; the unit of force where none is
// positive.
double force_scale(const DiskLaw& law, const ImposedStress<2>& imposed, double heaviest_weight = 0);

// That of a packing, under a gravity [a/T0^2] along -y.
double heaviest_weight(const Packing<2>& packing, double gravity);

// O(grains + links). The kinetic energy is a mean over grains; without cohesion the grains that touch nothing do not
// count (they keep their spin for ever) unless none touches, and without friction spins do not count (no force acts on
// them). The pressure criterion applies to the directions with an imposed stress, and to sigma_12 where it is imposed.
// Walls and lids are not judged: they stand where the container is. gravity [a/T0^2]: weights act along -y. `finishing`
// is left at "none".
Certificate evaluate_certificate(const Packing<2>& packing, const DiskLaw& law, const ImposedStress<2>& imposed,
                                 const EquilibriumScene& tolerance, double gravity = 0);
// Contacts that carry a force, or with cohesion all of them. Without it the contacts of rattlers come and go.
std::size_t loaded_contacts(const State<Disks>& state);

// From everything a state holds; keeps the state's record of its finishing method.
Certificate evaluate_certificate(const State<Disks>& state);

}  // namespace isostat
