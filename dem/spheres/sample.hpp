// The state that a scene of spheres begins with.
#pragma once
#include <cstdint>

#include "dem/sample/insertion.hpp"
#include "dem/spheres/spheres.hpp"

namespace isostat {

// [m/a^3]; of a soft-particle the mass of what it holds over the volume of its shell.
struct SphereDensities {
  double grain = 0, second = 0, soft = 0;
};
// Mass by density and inertia 2/5 m R^2 of bodies with radii; of all, or by kind.
void set_sphere_inertia(Bodies<3>& bodies, double density);
void set_sphere_inertia(SpherePacking& packing, const SphereDensities& densities);

// Soft-particles (seed 000): the groups of the first and of the one below it, the direction in which the first goes,
// and what tells the random stream of the second packing of a seed from that of the first.
inline constexpr std::int32_t kFirstSoft = 0, kSecondSoft = 1;
inline constexpr Vec3 kSoftApproach{{0, 0, -1}};
inline constexpr std::uint64_t kSecondStream = std::uint64_t{1} << 32;
// Adds grains, soft-particles among them where there are any, around a place as a group.
void add_grains(SpherePacking& packing, const InsertedGrains<3>& grains, const Vec3& at, std::int32_t group);
// Adds grains and their shell around a centre as a group of their own.
void add_soft_particle(SpherePacking& packing, const InsertedGrains<3>& grains, const Vec3& centre, std::int32_t group);
// The wall that a shell around the origin touches.
SphereWall soft_partner_wall(double shell_radius);

// What a scene with another arrangement than random asks of insertion.
InsertionScene insertion_of(const SphereGrainsScene& grains);

// N spheres at random positions without overlap in a cube, what hierarchical insertion makes, or the packing of
// grains.file under the scene's law. Throws InputError if they do not fit, or the file is no packing of spheres.
State<Spheres> initial_spheres(const Scene& scene, std::uint64_t seed);

}  // namespace isostat
