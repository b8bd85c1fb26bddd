// The state that a scene of spheres begins with.
#pragma once
#include <cstdint>

#include "dem/spheres/spheres.hpp"

namespace isostat {

// Mass by density [m/a^3] and inertia 2/5 m R^2 of bodies with radii.
void set_sphere_inertia(Bodies<3>& bodies, double density);

// N spheres at random positions without overlap in a cube, or the packing of grains.file under the scene's law.
// Throws InputError if they do not fit, or the file is no packing of spheres.
State<Spheres> initial_spheres(const Scene& scene, std::uint64_t seed);

}  // namespace isostat
