// What the typed tests of tests/systems need of each system: lively states of all its variants, and how to turn one.
// A system is added by a specialisation here and its name in `Systems`.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "dem/disks/engine.hpp"
#include "dem/disks/physical_hash.hpp"
#include "dem/files/state_file.hpp"
#include "tests/support/disk_states.hpp"

namespace isostat::systems {

// A state in full motion, and what the cell does meanwhile.
template <class System>
struct Variant {
  std::string name;
  State<System> state;
  CellControl control;
};

template <class System>
struct Fixture;

template <>
struct Fixture<Disks> {
  // Every law that a kernel exists for, in a fixed cell, in one that is compressed fast, and without a cell.
  static std::vector<Variant<Disks>> variants(int count) {
    std::vector<Variant<Disks>> list;
    for (const char* around : {"fixed cell", "free cell", "no cell"})
      for (const bool adhesion : {false, true})
        for (const char* axes : {"frictionless", "friction", "rolling", "undamped rolling"}) {
          const std::string law(axes), room(around);
          oracle::RandomDisks r;
          r.count = count, r.speed = 2, r.law = oracle::soft_law();
          if (!adhesion) r.law.attraction = 0;
          if (law.starts_with("undamped")) r.law.damping = 0;
          if (law == "frictionless") r.law.friction = 0;
          r.law.rolling = law.ends_with("rolling");
          Variant<Disks> v{law + (adhesion ? ", adhesion, " : ", ") + room, random_state(r), {}};
          if (room == "free cell") {
            v.control.stress = isotropic(100), v.control.max_strain_rate = 2;
            v.control.inertia = 0.3 * oracle::total_mass(v.state);
          }
          if (room == "no cell") v.state.packing.cell.reset(), v.state.cell_motion = {};
          list.push_back(std::move(v));
        }
    return list;
  }

  // Turned about the origin by an angle; springs and spins of the plane turn with the bodies.
  static State<Disks> turned(State<Disks> s, double angle) {
    const double c = std::cos(angle), t = std::sin(angle);
    const auto turn = [c, t](Vec2& v) { v = {{c * v[0] - t * v[1], t * v[0] + c * v[1]}}; };
    for (Vec2& r : s.packing.bodies.position) turn(r);
    for (Vec2& v : s.packing.bodies.velocity) turn(v);
    s.memory = {};
    return s;
  }
  static double inertia(const State<Disks>& s, std::size_t k) { return s.packing.bodies.inertia[k]; }
};

using Systems = ::testing::Types<Disks>;

template <class System>
State<System> marched(State<System> s, const CellControl& control, std::int64_t steps, SolverOptions options = {}) {
  Solver<System> solver(s, control, options);
  solver.run(steps);
  solver.snapshot(s);
  return s;
}

// Everything in the state, memory included.
template <class System>
std::string bytes(State<System> s) {
  s.scene = default_scene(s.scene.system), s.progress.stage = 0;  // keys that do not apply are not kept
  return encode_state(s);
}

}  // namespace isostat::systems
