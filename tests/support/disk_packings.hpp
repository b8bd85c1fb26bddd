// Disk configurations for the tests of the void: the files of data/geometry, and random and adversarial ones.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/periodic_cell.hpp"

namespace isostat::oracle {

struct Disks {
  PeriodicCell<2> cell;
  std::vector<Vec2> centre;
  std::vector<double> radius;
};

Disks read_disks(const std::string& json_path);

// n disks at uniformly random places, radii uniform in [r_min, r_max], overlapping freely.
Disks poisson_disks(std::size_t n, Vec2 length, double r_min, double r_max, std::uint64_t seed);

// Random sequential addition without overlaps; stops at n disks or when 1000 n trials have failed.
Disks rsa_disks(std::size_t n, Vec2 length, double r_min, double r_max, std::uint64_t seed);

// Cohesive-looking chains: walls of touching disks (overlap `overlap`) along random closed polygons, with some grains
// loose inside; islands, thin walls and pores of all sizes.
Disks chain_disks(std::size_t walls, Vec2 length, double overlap, std::uint64_t seed);

// Square or hexagonal lattice whose voids are closed but for rounding; half of the coordinates moved by up to `jitter`,
// so that many of the corners of voids still coincide.
Disks closing_lattice(bool hexagonal, double jitter, std::uint64_t seed);

}  // namespace isostat::oracle
