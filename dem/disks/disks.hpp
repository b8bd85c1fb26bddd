// The system of cohesive or cohesionless disks in the plane: its types alone, no kernel in sight, so that analysis can
// read states without reaching the solver.
#pragma once
#include <string_view>
#include <vector>

#include "dem/disks/disk_law.hpp"
#include "dem/state/list_memory.hpp"
#include "dem/state/packing.hpp"
#include "dem/state/state.hpp"

namespace isostat {

// Springs of a contact.
struct DiskHistory {
  double tangential_force = 0;  // [F0] T
  double moment = 0;            // [F0 a] M
  friend bool operator==(const DiskHistory&, const DiskHistory&) = default;
};

// A static solve under way (analysis/finishing/solve_memory.hpp); empty: none.
struct SolveMemory {
  std::vector<double> numbers;
  std::vector<std::int32_t> indices;
};

// What a restart needs beside the packing: leapfrog half-step velocities, the total forces at `time`, lists and
// histories.
struct DiskMemory {
  std::vector<Vec2> half_velocity;             // [a/T0] at time - dt/2
  std::vector<double> half_spin;               // [1/T0]
  std::vector<Vec2> force;                     // [F0] total, viscous part included
  std::vector<double> torque;                  // [F0 a]
  std::vector<PairMemory<DiskHistory>> pairs;  // any order
  ListMemory<2> lists;
  std::vector<Vec2> wall_position;  // [a] of walls and lids, in storage order, where they were built
  SolveMemory solve;                // in a state kept within a static solve
};

class DiskEngine;

struct Disks {
  static constexpr std::string_view name = "disks";
  static constexpr int dimension = 2;
  using Packing = isostat::Packing<2>;
  using Law = DiskLaw;
  using Memory = DiskMemory;
  using Engine = DiskEngine;
};

}  // namespace isostat
