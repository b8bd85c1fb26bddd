// Relaxation of spheres to rest by FIRE (Bitzek, Koskinen, Gaehler, Moseler, Gumbsch, Phys. Rev. Lett. 97, 170201,
// 2006) at a fixed step: no dashpots, the springs of friction are carried and may slip.
#pragma once
#include "dem/spheres/engine.hpp"

namespace isostat {

// |net forces|_2 / (sqrt(2) |contact forces|_2); 0 without contacts.
double fire_residual(const Solver<Spheres>& solver);

// Until the residual is met, or so many steps; the solver has its own law again afterwards, and is at rest. Steps
// taken.
int relax_by_fire(Solver<Spheres>& solver, const SphereLaw& law, double residual, int most_steps);

}  // namespace isostat
