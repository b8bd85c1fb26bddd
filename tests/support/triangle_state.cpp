#include "tests/support/triangle_state.hpp"

#include <algorithm>
#include <random>
#include <type_traits>

#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/grain_template.hpp"

namespace isostat {
namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double real(double low = -3, double high = 3) { return std::uniform_real_distribution<>(low, high)(engine_); }
  double positive() { return real(0.1, 3); }
  Vec2 vec() {
    const double x = real();
    return {{x, real()}};
  }
  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_;
};

void add_grain(TrianglePacking& p, Draw& d, const char* shape, GrainPart part) {
  const GrainTemplate grain = grain_template(grain_shape(shape), {});
  const auto first = static_cast<std::int32_t>(p.bodies.size());
  const Vec2 place = d.vec();
  if (p.grains.begin.empty()) p.grains.begin.push_back(0);
  for (const GrainTriangle& t : grain.triangles) {
    p.bodies.position.push_back(place + t.centroid), p.bodies.velocity.push_back(d.vec());
    p.bodies.spin.push_back(d.real()), p.bodies.radius.push_back(d.positive());
    p.bodies.mass.push_back(t.mass), p.bodies.inertia.push_back(t.inertia);
    p.bodies.id.push_back(static_cast<std::int64_t>(3 * p.bodies.id.size()) - 7);
    p.corner.push_back(t.corner), p.angle.push_back(d.real());
  }
  for (const GrainBeam& b : grain.beams) {
    p.links.push_back({.i = first + b.i, .j = first + b.j, .kind = LinkKind::beam});
    Link<2>& l = p.links.back();
    l.gap = d.real(), l.normal_force = d.real(), l.tangential_force = d.real(), l.moment = d.real();
    p.beams.push_back(b.beam);
  }
  p.grains.begin.push_back(static_cast<std::int32_t>(p.bodies.size()));
  p.grains.part.push_back(part), p.grains.radius.push_back(grain.radius);
}

void add_memory(State<TriangleGrains>& s, Draw& d) {
  TriangleMemory& m = s.memory;
  const Grains& g = s.packing.grains;
  for (std::size_t k = 0; k < s.packing.bodies.size(); ++k) {
    m.half_velocity.push_back(d.vec()), m.half_spin.push_back(d.real());
    m.force.push_back(d.vec()), m.torque.push_back(d.real());
    m.derivatives.push_back({d.vec(), d.vec()}), m.spin_derivatives.push_back(d.vec());
    m.candidate_position.push_back(d.vec()), m.candidate_angle.push_back(d.real());
  }
  for (std::size_t k = 0; k < g.size(); ++k) {
    m.lists.outer_position.push_back(d.vec()), m.lists.inner_position.push_back(d.vec());
    if (g.part[k] == GrainPart::free) continue;
    for (std::int32_t t = g.begin[k]; t < g.begin[k + 1]; ++t)
      m.wall_position.push_back(d.vec()), m.wall_angle.push_back(d.real());
  }
  m.lists.outer_length = d.vec(), m.lists.inner_length = d.vec();
  m.lists.outer_skin = d.real(), m.lists.inner_skin = d.real();
  m.lists.outer_travel = d.real(), m.lists.inner_travel = d.real();
  m.pairs = {{0, 2, {}, {d.real()}}, {1, 2, {}, {d.real()}}};
}

class Numbers {
 public:
  template <class... T>
  void add(const T&... values) {
    (add_one(values), ...);
  }
  std::vector<double> all;

 private:
  template <class T>
  void add_one(const T& x) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      all.push_back(static_cast<double>(x));
    } else if constexpr (requires { x.c; }) {
      add(x[0], x[1]);
    } else if constexpr (requires { x.has_value(); }) {
      add(x.has_value());
      if (x) add_one(*x);
    } else if constexpr (requires { x.begin(); }) {
      add(x.size());
      for (const auto& element : x) add_one(element);
    } else {
      add_struct(x);
    }
  }
  void add_struct(const PeriodicCell<2>& cell) { add(cell.length); }
  void add_struct(const Link<2>& link) {
    const auto& [i, j, shift, kind, beam, gap, normal_force, tangential_force, moment] = link;
    add(i, j, shift, kind, beam, gap, normal_force, tangential_force, moment);
  }
  void add_struct(const Beam& beam) {
    const auto& [length, angle_i, angle_j, stiffness, bending] = beam;
    add(length, angle_i, angle_j, stiffness, bending);
  }
  void add_struct(const Overlap& overlap) {
    const auto& [i, j, shift, area, normal_force, normal, point, tangential_force] = overlap;
    add(i, j, shift, area, normal_force, normal, point, tangential_force);
  }
  void add_struct(const BeamEvent& event) {
    const auto& [time, body_i, body_j, mode, broken] = event;
    add(time, body_i, body_j, mode, broken);
  }
  void add_struct(const PairMemory<GrainHistory>& pair) {
    add(pair.i, pair.j, pair.shift, pair.history.tangential_force);
  }
};

}  // namespace

State<TriangleGrains> random_triangle_state(std::uint64_t seed, bool with_cell) {
  Draw d(seed);
  State<TriangleGrains> s;
  TrianglePacking& p = s.packing;
  if (with_cell) p.cell = PeriodicCell<2>{{{d.positive(), d.positive()}}};
  add_grain(p, d, "square", GrainPart::free);
  add_grain(p, d, "triangle", GrainPart::wall);
  add_grain(p, d, "square", GrainPart::free);
  add_grain(p, d, "triangle", GrainPart::lid);
  p.grains.id = {8, -2, 5, 40};
  std::shuffle(p.grains.id.begin(), p.grains.id.end(), d.engine());
  std::shuffle(p.beams.begin(), p.beams.end(), d.engine());
  for (std::size_t k = 0; k < p.links.size(); ++k) p.links[k].beam = static_cast<std::int32_t>((k + 3) % 8);
  for (Beam& b : p.beams) b.rest_length *= d.positive(), b.rest_angle_i = d.real(), b.rest_angle_j = d.real();
  p.overlaps.resize(3);
  p.overlaps[0].grain_i = 0, p.overlaps[0].grain_j = 2;
  p.overlaps[1].grain_i = 1, p.overlaps[1].grain_j = 2;
  p.overlaps[2].grain_i = 0, p.overlaps[2].grain_j = 3;
  if (with_cell) p.overlaps[2].shift = {1, -1};
  for (Overlap& o : p.overlaps) {
    o.area = d.positive(), o.normal_force = d.positive(), o.tangential_force = d.real();
    o.normal = d.vec(), o.point = d.vec();
  }
  p.events = {{0.25, -7, -1, BeamMode::shear, false}, {0.5, -7, 5, BeamMode::bending, true}};

  TriangleLaw& law = s.law;
  for (double* x : {&law.modulus, &law.overlap_length, &law.friction, &law.tangential_stiffness, &law.damping,
                    &law.limit_tension, &law.limit_stretch, &law.limit_angle})
    *x = d.positive();
  law.contact = ContactLaw::paper, law.failure = BeamFailure::yield;  // limits of shear and bending stay infinite
  add_memory(s, d);
  s.time = 1 + d.positive(), s.step = 77, s.time_step = d.positive();
  s.cell_motion = {d.vec(), d.vec(), d.vec()};
  s.surroundings = {d.vec(), d.real(), true, 3, d.positive(), d.positive()};
  s.scene.system = SceneSystem::triangles;
  s.scene.stages.resize(2);
  s.progress.stage = 1;
  s.seed = d.engine()(), s.random_counter = d.engine()();
  return s;
}

std::vector<double> all_numbers(const State<TriangleGrains>& s) {
  Numbers n;
  const auto& [cell, bodies, corner, angle, grains, links, beams, overlaps, events] = s.packing;
  const auto& [id, position, velocity, spin, radius, mass, inertia] = bodies;
  n.add(cell, id, position, velocity, spin, radius, mass, inertia, corner, angle);
  n.add(grains.id, grains.begin, grains.part, grains.radius, links, beams, overlaps, events);
  const auto& [contact, modulus, overlap_length, friction, tangential_stiffness, damping, failure, tension, shear,
               bending, stretch, limit_angle] = s.law;
  n.add(contact, modulus, overlap_length, friction, tangential_stiffness, damping, failure, tension, shear, bending,
        stretch, limit_angle);
  const auto& [half_velocity, half_spin, force, torque, derivatives, spin_derivatives, candidate_position,
               candidate_angle, wall_position, wall_angle, pairs, lists] = s.memory;
  n.add(half_velocity, half_spin, force, torque, derivatives, spin_derivatives, candidate_position, candidate_angle,
        wall_position, wall_angle, pairs);
  n.add(lists.outer_position, lists.inner_position, lists.outer_length, lists.inner_length, lists.outer_skin,
        lists.inner_skin, lists.outer_travel, lists.inner_travel);
  const auto& [start_offset, start_angle, open, grains_left, mass_left, last_left] = s.surroundings;
  n.add(start_offset, start_angle, open, grains_left, mass_left, last_left);
  n.add(s.time, s.step, s.time_step, s.progress.stage, s.cell_motion.reference_length, s.cell_motion.strain_rate,
        s.cell_motion.stress);
  return n.all;
}

}  // namespace isostat
