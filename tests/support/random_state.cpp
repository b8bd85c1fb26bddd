#include "tests/support/random_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>
#include <vector>

namespace isostat {
namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double real() { return std::uniform_real_distribution<>(-3, 3)(engine_); }
  double positive() { return std::uniform_real_distribution<>(0.1, 3)(engine_); }
  int integer(int low, int high) { return std::uniform_int_distribution<>(low, high)(engine_); }
  bool coin() { return integer(0, 1) == 1; }
  Vec2 vec() {
    const double x = real();
    return {{x, real()}};
  }
  std::uint64_t word() { return engine_(); }
  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_;
};

template <class T>
std::vector<double> numbers(const T& x) {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    return {static_cast<double>(x)};
  } else if constexpr (requires { x.c; }) {
    return {x.c.begin(), x.c.end()};
  } else {
    std::vector<double> all;
    for (const auto& element : x)
      for (const double v : numbers(element)) all.push_back(v);
    return all;
  }
}

#define EXPECT_SAME(member) EXPECT_EQ(numbers(a.member), numbers(b.member)) << #member

}  // namespace

State<Disks> random_state(std::uint64_t seed, int grains, int links) {
  Draw d(seed);
  State<Disks> s;
  if (d.coin() || links > 0) s.packing.cell = PeriodicCell<2>{{{d.positive(), d.positive()}}, d.coin() ? d.real() : 0};
  Bodies<2>& b = s.packing.bodies;
  for (int k = 0; k < grains; ++k) {
    b.id.push_back(7 * k - 20);
    b.position.push_back(d.vec()), b.velocity.push_back(d.vec()), b.spin.push_back(d.real());
    b.radius.push_back(d.positive()), b.mass.push_back(d.positive()), b.inertia.push_back(d.positive());
  }
  std::shuffle(b.id.begin(), b.id.end(), d.engine());
  for (int k = 0; k < links && grains > 0; ++k) {
    Link<2> l;
    l.i = d.integer(0, grains - 1), l.j = d.integer(0, grains - 1);
    l.shift = {d.integer(-1, 1), l.i == l.j ? 1 : d.integer(-1, 1)};
    l.kind = static_cast<LinkKind>(d.integer(0, 4));
    l.gap = d.real(), l.normal_force = d.real(), l.tangential_force = d.real(), l.moment = d.real();
    s.packing.links.push_back(l);
    s.memory.pairs.push_back({l.i, l.j, l.shift, {d.real(), d.real()}});
  }
  auto& law = s.law;
  for (double* x : {&law.normal_stiffness, &law.tangential_stiffness, &law.damping, &law.friction,
                    &law.rolling_friction, &law.rolling_stiffness, &law.attraction, &law.attraction_range})
    *x = d.positive();
  s.time = d.positive(), s.step = d.integer(0, 1 << 30), s.time_step = d.positive();
  s.cell_motion = {d.vec(), d.vec(), d.vec(), d.real(), d.real(), d.real()};
  if (d.coin()) s.imposed_stress.shear = d.real();
  for (auto& stress : s.imposed_stress)
    if (d.coin()) stress = d.real();
  if (d.coin())
    for (int k = 0; k < grains; ++k) {
      s.memory.half_velocity.push_back(d.vec()), s.memory.half_spin.push_back(d.real());
      s.memory.force.push_back(d.vec()), s.memory.torque.push_back(d.real());
      s.memory.lists.outer_position.push_back(d.vec()), s.memory.lists.inner_position.push_back(d.vec());
    }
  s.memory.lists.outer_length = d.vec(), s.memory.lists.inner_length = d.vec();
  s.memory.lists.outer_tilt = d.real(), s.memory.lists.inner_tilt = d.real();
  s.memory.lists.outer_skin = d.real(), s.memory.lists.inner_skin = d.real();
  s.memory.lists.outer_travel = d.real(), s.memory.lists.inner_travel = d.real();
  s.scene.stages.resize(static_cast<std::size_t>(d.integer(0, 3)));
  for (StageScene& stage : s.scene.stages) stage.pressure = d.positive(), stage.velocity = d.positive();
  s.scene.law.friction = d.positive(), s.scene.output.series = "a \"quoted\"\nname";
  s.scene.seed = d.word() >> 1;
  s.progress.stage = d.integer(0, static_cast<int>(s.scene.stages.size()));
  s.progress.start_time = d.real(), s.progress.started = d.coin();
  s.progress.drag_on = d.coin(), s.progress.quiet_since = d.real();
  s.progress.ramp_stress = d.vec(), s.progress.ramp_rate = d.vec();
  s.progress.carried_stress = d.real(), s.progress.carried_at = d.real(), s.progress.peak_stress = d.real();
  s.progress.drifting = d.coin();
  s.progress.solves = d.integer(0, 3);
  if (d.coin()) s.progress.add_unmet("stage 0: stopped");
  if (d.coin()) s.surroundings = {d.vec(), d.real(), d.coin(), d.integer(0, 9), d.positive(), d.real()};
  s.ledger = {d.real(), d.real(), d.real(), d.real(), d.real(), d.real(), d.real(), d.real()};
  Certificate& c = s.certificate;
  for (double* x :
       {&c.max_force, &c.max_moment, &c.pressure_error, &c.kinetic_energy_per_grain, &c.force_scale, &c.tolerance_force,
        &c.tolerance_pressure, &c.tolerance_kinetic, &c.smallest_margin, &c.inertial_number, &c.stress_error})
    *x = d.real();
  c.sliding = d.integer(0, 99), c.rolling_yielded = d.integer(0, 99), c.moving = d.integer(0, 99);
  c.pressure_controlled = d.coin(), c.equilibrated = d.coin();
  c.finishing = "drag";
  s.seed = d.word(), s.random_counter = d.word();
  return s;
}

void expect_equal(const State<Disks>& a, const State<Disks>& b) {
  ASSERT_EQ(a.packing.cell.has_value(), b.packing.cell.has_value());
  if (a.packing.cell) {
    EXPECT_SAME(packing.cell->length);
    EXPECT_SAME(packing.cell->tilt);
  }
  EXPECT_EQ(a.packing.bodies.id, b.packing.bodies.id);
  EXPECT_SAME(packing.bodies.position);
  EXPECT_SAME(packing.bodies.velocity);
  EXPECT_SAME(packing.bodies.spin);
  EXPECT_SAME(packing.bodies.radius);
  EXPECT_SAME(packing.bodies.mass);
  EXPECT_SAME(packing.bodies.inertia);
  ASSERT_EQ(a.packing.links.size(), b.packing.links.size());
  for (std::size_t k = 0; k < a.packing.links.size(); ++k) {
    const auto row = [k](const State<Disks>& s) {
      const Link<2>& l = s.packing.links[k];
      return std::make_tuple(l.i, l.j, l.shift, l.kind, l.gap, l.normal_force, l.tangential_force, l.moment);
    };
    EXPECT_EQ(row(a), row(b));
  }
  ASSERT_EQ(a.memory.pairs.size(), b.memory.pairs.size());
  for (std::size_t k = 0; k < a.memory.pairs.size(); ++k) {
    const auto row = [k](const State<Disks>& s) {
      const PairMemory<DiskHistory>& p = s.memory.pairs[k];
      return std::make_tuple(p.i, p.j, p.shift, p.history.tangential_force, p.history.moment);
    };
    EXPECT_EQ(row(a), row(b));
  }
  EXPECT_SAME(law.normal_stiffness);
  EXPECT_SAME(law.tangential_stiffness);
  EXPECT_SAME(law.damping);
  EXPECT_SAME(law.friction);
  EXPECT_SAME(law.rolling_friction);
  EXPECT_SAME(law.rolling_stiffness);
  EXPECT_SAME(law.attraction);
  EXPECT_SAME(law.attraction_range);
  EXPECT_SAME(time);
  EXPECT_EQ(a.step, b.step);
  EXPECT_SAME(time_step);
  EXPECT_SAME(cell_motion.reference_length);
  EXPECT_SAME(cell_motion.shear_strain_rate);
  EXPECT_SAME(cell_motion.shear_stress);
  EXPECT_SAME(cell_motion.shear_strain);
  EXPECT_SAME(cell_motion.strain_rate);
  EXPECT_SAME(cell_motion.stress);
  EXPECT_EQ(a.imposed_stress, b.imposed_stress);
  EXPECT_SAME(memory.half_velocity);
  EXPECT_SAME(memory.half_spin);
  EXPECT_SAME(memory.force);
  EXPECT_SAME(memory.torque);
  EXPECT_SAME(memory.lists.outer_position);
  EXPECT_SAME(memory.lists.inner_position);
  EXPECT_SAME(memory.lists.outer_length);
  EXPECT_SAME(memory.lists.inner_length);
  EXPECT_SAME(memory.lists.outer_tilt);
  EXPECT_SAME(memory.lists.inner_tilt);
  EXPECT_SAME(memory.lists.outer_skin);
  EXPECT_SAME(memory.lists.inner_skin);
  EXPECT_SAME(memory.lists.outer_travel);
  EXPECT_SAME(memory.lists.inner_travel);
  EXPECT_SAME(progress.stage);
  EXPECT_SAME(progress.start_time);
  EXPECT_SAME(progress.started);
  EXPECT_SAME(progress.drag_on);
  EXPECT_SAME(progress.quiet_since);
  EXPECT_SAME(progress.contact_set);
  EXPECT_SAME(progress.unchanged_since);
  EXPECT_SAME(progress.start_stiffness);
  EXPECT_SAME(progress.start_stress);
  EXPECT_SAME(progress.start_shear_stress);
  EXPECT_SAME(progress.ramp_stress);
  EXPECT_SAME(progress.ramp_rate);
  EXPECT_SAME(progress.ramp_shear_stress);
  EXPECT_SAME(progress.ramp_shear_rate);
  EXPECT_SAME(progress.carried_stress);
  EXPECT_SAME(progress.carried_at);
  EXPECT_SAME(progress.peak_stress);
  EXPECT_SAME(progress.drifting);
  EXPECT_SAME(progress.solves);
  EXPECT_SAME(progress.unmet);
  EXPECT_EQ(a.surroundings, b.surroundings);
  EXPECT_SAME(ledger.viscous);
  EXPECT_SAME(ledger.sliding);
  EXPECT_SAME(ledger.rolling);
  EXPECT_SAME(ledger.drag);
  EXPECT_SAME(ledger.cell_work);
  EXPECT_SAME(ledger.injected);
  EXPECT_SAME(ledger.viscous_due);
  EXPECT_SAME(ledger.cell_work_due);
  EXPECT_SAME(certificate.max_force);
  EXPECT_SAME(certificate.max_moment);
  EXPECT_SAME(certificate.pressure_error);
  EXPECT_SAME(certificate.kinetic_energy_per_grain);
  EXPECT_SAME(certificate.force_scale);
  EXPECT_SAME(certificate.tolerance_force);
  EXPECT_SAME(certificate.tolerance_pressure);
  EXPECT_SAME(certificate.tolerance_kinetic);
  EXPECT_SAME(certificate.sliding);
  EXPECT_SAME(certificate.rolling_yielded);
  EXPECT_SAME(certificate.smallest_margin);
  EXPECT_SAME(certificate.moving);
  for (const auto number : {&Certificate::inertial_number, &Certificate::stress_error})
    EXPECT_TRUE(a.certificate.*number == b.certificate.*number ||
                (std::isnan(a.certificate.*number) && std::isnan(b.certificate.*number)));
  EXPECT_SAME(certificate.pressure_controlled);
  EXPECT_SAME(certificate.equilibrated);
  EXPECT_EQ(a.certificate.finishing, b.certificate.finishing);
  EXPECT_EQ(a.scene, b.scene);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.random_counter, b.random_counter);
}

}  // namespace isostat
