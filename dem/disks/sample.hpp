// The I-state: disks in random non-overlapping positions of a periodic cell, at rest (Gilabert 2007, Sec. III.A), or of
// a container, which they fill from below.
#pragma once
#include "dem/disks/disks.hpp"

namespace isostat {

// Disk of diameter d: mass d^2, moment of inertia m d^2 / 8 (a = m = 1). Of the bodies from `first` on.
void set_disk_inertia(Bodies<2>& bodies, std::size_t first = 0);

// A state before its first stage: bodies, cell, law, time step. Throws InputError if the disks cannot be placed.
State<Disks> initial_disks(const Scene& scene, std::uint64_t seed);

// dt = c sqrt(m_max / K_N), m_max of the free grains; c of the scene, or what its smallest and lightest grains bear.
double time_step(const Scene& scene, double normal_stiffness, const Packing<2>& packing);

}  // namespace isostat
