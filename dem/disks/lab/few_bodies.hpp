// A few disks in a large fixed cell, marched by the same solver as everything else; the common part of the `lab`
// experiments.
#pragma once
#include <vector>

#include "dem/disks/disks.hpp"
#include "dem/disks/engine.hpp"
#include "dem/scene/scene.hpp"

namespace isostat::lab {

struct Disk {
  double x = 0, y = 0, radius = 0.5;  // [a]
  double vx = 0, vy = 0, spin = 0;    // [a/T0], [1/T0]
};

// An isolated set of disks (ids in the order given) in a cell much larger than it; dt = fraction * sqrt(m_max / K_N).
State<Disks> few_bodies(const LawScene& law, const std::vector<Disk>& disks, double fraction);

// The disk with that id, whatever the storage order.
Disk disk(const State<Disks>& state, std::int64_t id);

// The link between two ids, or nullptr.
const Link<2>* find_link(const State<Disks>& state, std::int64_t id_i, std::int64_t id_j);

}  // namespace isostat::lab
