// What the typed tests of tests/systems need of each system: lively states of all its variants, and how to turn one.
// A system is added by a specialisation here and its name in `Systems`.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dem/disks/engine.hpp"
#include "dem/disks/physical_hash.hpp"
#include "dem/files/state_file.hpp"
#include "dem/spheres/certificate.hpp"
#include "dem/spheres/engine.hpp"
#include "dem/spheres/physical_hash.hpp"
#include "dem/state/balance.hpp"
#include "dem/triangles/certificate.hpp"
#include "dem/triangles/engine.hpp"
#include "dem/triangles/physical_hash.hpp"
#include "tests/support/disk_states.hpp"
#include "tests/support/moving_triangles.hpp"
#include "tests/support/sphere_states.hpp"

namespace isostat::systems {

// A state in full motion, and what the cell does meanwhile.
template <class System>
struct Variant {
  std::string name;
  State<System> state;
  CellControl<System::dimension> control;
};

template <class System>
struct Fixture;

// The same control by a ramp that is not over within a test, of a cell that is damped.
template <class State>
void ramped(CellControl<State::D>& control, const State& s) {
  control.ramp.start = s.time, control.ramp.length = 1e4 * s.time_step;
  control.ramp.strain_rate = {};
  for (int a = 0; a < State::D; ++a)
    control.ramp.stress[a] = 0.5 * control.stress[static_cast<std::size_t>(a)].value_or(0);
  control.damping = 1e-3 / s.time_step;
}

template <>
struct Fixture<Disks> {
  static constexpr bool kLedger = true;  // energies can be watched

  // Between smooth walls: of a box that is shaken, of a drum that turns.
  static Variant<Disks> walled(const std::string& name, oracle::RandomDisks r, ContainerShape shape) {
    const double size = std::sqrt(r.count);
    r.container.shape = shape, r.container.walls = ContainerWalls::smooth;
    r.container.width = 0.96 * size, r.container.height = 1.3 * size, r.container.radius = 0.6 * size;
    if (shape == ContainerShape::drum)
      r.motion.rotation = 0.5;
    else
      r.motion.vibration_amplitude = 0.02, r.motion.vibration_frequency = 3;
    return {name, random_state(r), {}};
  }

  // Every law that a kernel exists for, in a fixed cell, in one that is compressed fast, in one that is sheared so fast
  // that its tilt is lowered on the way, without a cell and between smooth walls.
  static std::vector<Variant<Disks>> variants(int count) {
    std::vector<Variant<Disks>> list;
    for (const char* around : {"fixed cell", "free cell", "sheared cell", "no cell", "smooth box", "smooth drum"})
      for (const bool adhesion : {false, true})
        for (const char* axes : {"frictionless", "friction", "rolling", "undamped rolling"}) {
          const std::string law(axes), room(around);
          oracle::RandomDisks r;
          r.count = count, r.speed = 2, r.law = oracle::soft_law();
          if (!adhesion) r.law.attraction = 0;
          if (law.starts_with("undamped")) r.law.damping = 0;
          if (law == "frictionless") r.law.friction = 0;
          r.law.rolling = law.ends_with("rolling");
          const std::string name = law + (adhesion ? ", adhesion, " : ", ") + room;
          if (room.starts_with("smooth")) {
            list.push_back(walled(name, r, room == "smooth box" ? ContainerShape::box : ContainerShape::drum));
            continue;
          }
          Variant<Disks> v{name, random_state(r), {}};
          if (room == "free cell") {
            v.control.stress = isotropic<2>(100), v.control.max_strain_rate = 2;
            v.control.inertia = 0.3 * oracle::total_mass(v.state);
            if (law == "rolling") ramped(v.control, v.state);  // and damped
          }
          if (room == "sheared cell") {
            v.control.stress[1] = 100, v.control.shear_rate = 5, v.control.max_strain_rate = 2;
            v.control.inertia = 0.3 * oracle::total_mass(v.state);
          }
          if (room == "no cell") v.state.packing.cell.reset(), v.state.cell_motion = {};
          list.push_back(std::move(v));
        }
    Variant<Disks> unlike = list[6];
    unlike.name += ", unlike densities";
    for (std::size_t k = 0; k < unlike.state.packing.bodies.size(); k += 3)
      unlike.state.packing.bodies.mass[k] *= 4, unlike.state.packing.bodies.inertia[k] *= 4;
    list.push_back(std::move(unlike));
    return list;
  }

  // The richest: thousands of bodies take their time.
  static std::vector<Variant<Disks>> large(int count) {
    std::vector<Variant<Disks>> list = variants(count);
    std::erase_if(list, [](const Variant<Disks>& v) { return !v.name.starts_with("rolling, adhesion"); });
    return list;
  }
  static int chunks(const State<Disks>& s) { return DiskEngine::Lists::chunk_count(s.packing.bodies.size()); }
  // Something of all that the variant is there for has happened.
  static bool is_lively(const Variant<Disks>& v, const State<Disks>& end) {
    const bool turned_back =
        v.control.shear_rate == 0 ||
        end.packing.cell->tilt < 0.9 * v.control.shear_rate * end.time * end.packing.cell->length[1];
    return !end.packing.links.empty() && (closed(v.state) || !end.packing.feet.empty()) && turned_back;
  }
  static unsigned least_rebuilds(const State<Disks>&) { return 6; }  // of the inner lists, in 150 steps
  // No force from outside.
  static bool closed(const State<Disks>& s) { return s.scene.container.shape == ContainerShape::none; }

  // Turned about the origin by an angle; springs and spins of the plane turn with the bodies.
  static State<Disks> turned(State<Disks> s, double angle) {
    const double c = std::cos(angle), t = std::sin(angle);
    const auto turn = [c, t](Vec2& v) { v = {{c * v[0] - t * v[1], t * v[0] + c * v[1]}}; };
    for (Vec2& r : s.packing.bodies.position) turn(r);
    for (Vec2& v : s.packing.bodies.velocity) turn(v);
    s.memory = {};
    return s;
  }
  static std::vector<BodyLoad> loads(const State<Disks>& s) { return net_loads(s.packing); }
  static double largest_force(const State<Disks>& s) {
    double scale = 0;
    for (const Link<2>& l : s.packing.links) scale = std::max(scale, std::abs(l.normal_force));
    return scale;
  }
  // With the velocities of the same instant as the positions it is kept to the order of the step.
  static double angular_tolerance(const State<Disks>&) { return 1e-3; }
};

template <>
struct Fixture<TriangleGrains> {
  static constexpr bool kLedger = true;
  using Moving = oracle::MovingTriangles;

  static Variant<TriangleGrains> variant(const std::string& name, const Moving& moving, bool cell = true) {
    Variant<TriangleGrains> v{name, moving_triangles(moving), {}};
    if (!cell) v.state.packing.cell.reset(), v.state.cell_motion = {};
    return v;
  }
  static void free_cell(Variant<TriangleGrains>& v) {
    v.control.stress = isotropic<2>(2e3), v.control.max_strain_rate = 20;
    v.control.inertia = 0.3 * oracle::total_mass(v.state);
  }
  static TriangleLawScene failing(BeamFailure failure) {
    TriangleLawScene law;
    law.failure = failure, law.friction = 0.3;
    law.limit_tension = failure == BeamFailure::break_ ? 400 : 200;
    law.limit_bending = failure == BeamFailure::break_ ? 12 : 6;
    return law;
  }
  // A box as wide as the grains want, shaken up and down.
  static Moving shaken(int count, ContainerWalls walls) {
    Moving m;
    m.count = count, m.gravity = 981;
    m.container.shape = ContainerShape::box, m.container.walls = walls;
    m.container.width = 0.3 * std::sqrt(count), m.container.height = 0.6 * std::sqrt(count);
    m.motion.vibration_amplitude = 0.05, m.motion.vibration_frequency = 200;
    return m;
  }

  // Both laws and integrators, friction, dampers or none, beams that fail; in a fixed cell, in one that moves, without
  // a cell and between both kinds of walls.
  static std::vector<Variant<TriangleGrains>> variants(int count) {
    Moving plain;
    plain.count = count;
    Moving gear = plain, undamped = plain, paper = plain, friction = plain, mixed = plain;
    gear.integrator = Integrator::gear;
    undamped.law.damping = 0;
    paper.law.contact = ContactLaw::paper;
    friction.law.friction = 0.3;
    mixed.law = oracle::soft_beams(), mixed.law.friction = 0.3, mixed.shapes = "square,L,polygon5", mixed.speed = 60;
    std::vector<Variant<TriangleGrains>> list;
    for (const bool cell : {true, false}) {
      const std::string room = cell ? ", fixed cell" : ", no cell";
      list.push_back(variant("frictionless" + room, plain, cell));
      list.push_back(variant("undamped" + room, undamped, cell));
      list.push_back(variant("friction" + room, friction, cell));
      list.push_back(variant("paper" + room, paper, cell));
      list.push_back(variant("mixed shapes" + room, mixed, cell));
      for (const BeamFailure failure : {BeamFailure::break_, BeamFailure::yield}) {
        Moving m = plain;
        m.law = failing(failure);
        list.push_back(variant((failure == BeamFailure::break_ ? "breaking" : "yielding") + room, m, cell));
        m.integrator = Integrator::gear;
        list.push_back(variant((failure == BeamFailure::break_ ? "breaking, Gear" : "yielding, Gear") + room, m, cell));
      }
      Moving m = gear;
      list.push_back(variant("Gear" + room, m, cell));
      m.law.friction = 0.3;
      list.push_back(variant("Gear, friction" + room, m, cell));
      m.law.contact = ContactLaw::paper, m.law.friction = 0;
      list.push_back(variant("Gear, paper" + room, m, cell));
    }
    for (const Moving& m : {plain, undamped, friction, paper, mixed}) {
      list.push_back(variant("free cell", m));
      list.back().name += ", " + std::to_string(list.size());
      free_cell(list.back());
    }
    ramped(list.back().control, list.back().state);
    for (const ContainerWalls walls : {ContainerWalls::smooth, ContainerWalls::grains}) {
      const std::string room = walls == ContainerWalls::smooth ? ", smooth walls" : ", walls of grains";
      Moving m = shaken(count, walls);
      m.law.friction = 0.3;
      list.push_back(variant("shaken" + room, m));
      m.integrator = Integrator::gear;
      list.push_back(variant("shaken, Gear" + room, m));
      m = shaken(count, walls), m.law = failing(BeamFailure::break_);
      list.push_back(variant("shaken, breaking" + room, m));
      m = shaken(count, walls), m.law.contact = ContactLaw::paper;
      list.push_back(variant("shaken, paper" + room, m));
    }
    return list;
  }

  static std::vector<Variant<TriangleGrains>> large(int count) {
    Moving mixed;
    mixed.count = count, mixed.shapes = "square,L", mixed.law = failing(BeamFailure::break_), mixed.speed = 40;
    Moving yielding = shaken(count, ContainerWalls::grains), gear = shaken(count, ContainerWalls::smooth);
    yielding.law = failing(BeamFailure::yield), yielding.speed = 40;
    gear.integrator = Integrator::gear;
    for (Moving* m : {&mixed, &yielding, &gear}) m->solid_fraction = 0.3;  // room is found soon
    std::vector<Variant<TriangleGrains>> list{variant("breaking, free cell", mixed),
                                              variant("yielding, shaken, walls of grains", yielding),
                                              variant("Gear, shaken, smooth walls", gear)};
    free_cell(list.front());
    return list;
  }
  static int chunks(const State<TriangleGrains>& s) {
    return TriangleEngine::Lists::chunk_count(s.packing.grains.size());
  }
  static bool is_lively(const Variant<TriangleGrains>& v, const State<TriangleGrains>& end) {
    const bool spring = std::any_of(end.memory.pairs.begin(), end.memory.pairs.end(),
                                    [](const auto& pair) { return pair.history.tangential_force != 0; });
    const bool broken = end.packing.grains.size() > v.state.packing.grains.size();
    return end.packing.overlaps.size() > 3 && spring == (end.law.friction > 0) &&
           !end.packing.events.empty() == (end.law.failure != BeamFailure::none) &&
           broken == (end.law.failure == BeamFailure::break_);
  }
  // Lists, and the count, are begun anew when grains break or outgrow their circles.
  static unsigned least_rebuilds(const State<TriangleGrains>& s) {
    return s.law.failure == BeamFailure::none && s.law.damping > 1 ? 6 : 0;
  }
  static bool closed(const State<TriangleGrains>& s) {
    return count_free(s.packing) == s.packing.grains.size() && s.scene.gravity == 0;
  }

  static State<TriangleGrains> turned(State<TriangleGrains> s, double angle) {
    const double c = std::cos(angle), t = std::sin(angle);
    const auto turn = [c, t](Vec2& v) { v = {{c * v[0] - t * v[1], t * v[0] + c * v[1]}}; };
    for (Vec2& r : s.packing.bodies.position) turn(r);
    for (Vec2& v : s.packing.bodies.velocity) turn(v);
    for (double& a : s.packing.angle) a += angle;
    s.memory = {};
    return s;
  }
  static std::vector<BodyLoad> loads(const State<TriangleGrains>& s) { return net_loads(s.packing, s.law, 0); }
  static double largest_force(const State<TriangleGrains>& s) {
    double scale = 0;
    for (const Link<2>& l : s.packing.links) scale = std::max(scale, std::abs(l.normal_force));
    for (const Overlap& o : s.packing.overlaps) scale = std::max(scale, o.normal_force);
    return scale;
  }
  // Verlet's dampers balance exactly; Gear corrects positions and velocities by different parts of an error.
  static double angular_tolerance(const State<TriangleGrains>& s) {
    return s.scene.step.integrator == Integrator::gear ? 1e-7 : 1e-12;
  }
};

template <>
struct Fixture<Spheres> {
  static constexpr bool kLedger = false;

  static Variant<Spheres> variant(const SphereLaw& law, int count, const std::string& room) {
    oracle::RandomSpheres r;
    r.count = count, r.law = law, r.cell = room != "no cell" && room != "walls";
    r.room = 0.5;
    if (room == "no cell") r.time_step = 2e-4;  // or they have parted before the run ends
    Variant<Spheres> v{oracle::words(law) + ", " + room, random_state(r), {}};
    v.state.scene.system = SceneSystem::spheres;
    if (room == "free cell") {
      v.control.stress = isotropic<3>(100), v.control.max_strain_rate = 2;
      v.control.inertia = 0.3 * oracle::total_mass(v.state);
      if (law.rolling_friction > 0) ramped(v.control, v.state);
    }
    if (room == "sheared cell") {  // so fast that its tilt is lowered on the way
      v.control.stress[1] = 100, v.control.shear_rate = 8, v.control.max_strain_rate = 2;
      v.control.inertia = 0.3 * oracle::total_mass(v.state);
    }
    if (room == "walls") enclose(v.state.packing);
    return v;
  }
  // Grains of two materials and soft-particles.
  static Variant<Spheres> unlike(int count, const std::string& room) {
    SphereLaw law = oracle::soft_sphere_law();
    law.attraction = law.attraction_range = law.rolling_friction = law.rolling_stiffness = 0;
    law.second = {300, 0.1};
    law.soft_solid = {0.8, 1.7, -1e-3, 4, 1.1, 0.25}, law.soft_soft = {0.5, 2.2, -1e-4, 3, 1.3, 0.4};
    law.soft_curvature = 0.4;
    Variant<Spheres> v = variant(law, count, room);
    v.name = "unlike bodies, " + room;
    std::vector<SphereKind>& kind = v.state.packing.kind;
    for (std::size_t k = 0; k < v.state.packing.bodies.size(); ++k) kind.push_back(static_cast<SphereKind>(k % 3));
    return v;
  }
  // A shell around half of them, and a plane that closes on all.
  static void enclose(SpherePacking& p) {
    Vec3 low = p.bodies.position.front(), high = low;
    for (const Vec3& r : p.bodies.position)
      for (int a = 0; a < 3; ++a) low[a] = std::min(low[a], r[a]), high[a] = std::max(high[a], r[a]);
    SphereWall plane, shell;
    plane.point = low, plane.normal = {{0, 0, 1}}, plane.velocity = {{0.3, 0, 0.5}};
    shell.shape = WallShape::shell, shell.point = 0.5 * (low + high), shell.radius = 0.6 * norm(high - low);
    shell.group = 0;
    p.walls = {plane, shell};
    p.group.resize(p.bodies.size());
    for (std::size_t k = 0; k < p.group.size(); ++k) p.group[k] = static_cast<std::int32_t>(k % 2);
  }

  // Every law that a kernel exists for, in a fixed cell, in one that is sheared, and without one; one of each normal
  // law in a cell that is compressed fast, and between walls that move.
  static std::vector<Variant<Spheres>> variants(int count) {
    std::vector<Variant<Spheres>> list;
    for (const char* room : {"fixed cell", "sheared cell", "no cell"})
      for (const SphereLaw& law : oracle::sphere_laws()) list.push_back(variant(law, count, room));
    for (const char* room : {"free cell", "walls"})
      for (const NormalForce normal : {NormalForce::hertz, NormalForce::linear})
        list.push_back(variant(oracle::soft_sphere_law(normal), count, room));
    for (const char* room : {"fixed cell", "sheared cell", "no cell", "free cell", "walls"})
      list.push_back(unlike(count, room));
    return list;
  }
  static std::vector<Variant<Spheres>> large(int count) {
    return {variant(oracle::soft_sphere_law(), count, "free cell"),
            variant(oracle::soft_sphere_law(), count, "sheared cell"),
            variant(oracle::soft_sphere_law(), count, "walls"), unlike(count, "free cell")};
  }
  static int chunks(const State<Spheres>& s) { return SphereEngine::Lists::chunk_count(s.packing.bodies.size()); }
  static bool is_lively(const Variant<Spheres>&, const State<Spheres>& end) {
    return !end.packing.links.empty() && end.packing.wall_links.empty() == end.packing.walls.empty();
  }
  static unsigned least_rebuilds(const State<Spheres>&) { return 1; }
  static bool closed(const State<Spheres>& s) { return s.packing.walls.empty(); }

  // Turned about the z axis through the origin.
  static State<Spheres> turned(State<Spheres> s, double angle) {
    const double c = std::cos(angle), t = std::sin(angle);
    const auto turn = [c, t](Vec3& v) { v = {{c * v[0] - t * v[1], t * v[0] + c * v[1], v[2]}}; };
    for (Vec3& r : s.packing.bodies.position) turn(r);
    for (Vec3& v : s.packing.bodies.velocity) turn(v);
    for (Vec3& w : s.packing.bodies.spin) turn(w);
    for (Link<3>& l : s.packing.links) turn(l.tangential_force), turn(l.moment);
    s.memory = {};
    return s;
  }
  static std::vector<BodyLoad3> loads(const State<Spheres>& s) { return net_loads(s.packing); }
  static double largest_force(const State<Spheres>& s) {
    double scale = 0;
    for (const Link<3>& l : s.packing.links) scale = std::max(scale, std::abs(l.normal_force));
    return scale;
  }
  // As of disks.
  static double angular_tolerance(const State<Spheres>&) { return 1e-3; }
};

using Systems = ::testing::Types<Disks, TriangleGrains, Spheres>;

// The parts of a load, and of what the memory holds of one, side by side.
inline std::vector<double> parts(const BodyLoad& b) { return {b.fx, b.fy, b.moment}; }
inline std::vector<double> parts(const BodyLoad3& b) {
  return {b.force[0], b.force[1], b.force[2], b.moment[0], b.moment[1], b.moment[2]};
}
inline std::vector<double> parts(const Vec2& force, double torque) { return {force[0], force[1], torque}; }
inline std::vector<double> parts(const Vec3& force, const Vec3& torque) {
  return {force[0], force[1], force[2], torque[0], torque[1], torque[2]};
}

// Angular momentum about the origin.
inline double turning(const Bodies<2>& b, std::size_t k) {
  return b.mass[k] * (b.position[k][0] * b.velocity[k][1] - b.position[k][1] * b.velocity[k][0]) +
         b.inertia[k] * b.spin[k];
}
inline Vec3 turning(const Bodies<3>& b, std::size_t k) {
  return b.mass[k] * cross(b.position[k], b.velocity[k]) + b.inertia[k] * b.spin[k];
}
inline double size_of(double x) { return std::abs(x); }
inline double size_of(const Vec3& v) { return norm(v); }

template <class System>
State<System> marched(State<System> s, const CellControl<System::dimension>& control, std::int64_t steps,
                      SolverOptions options = {}) {
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
