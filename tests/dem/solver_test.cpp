// The solver against the reference of tests/oracle/disk_reference: lists, sorting, wrapping, batches and cell against
// all pairs by brute force.
#include "dem/disks/engine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "dem/run_error.hpp"
#include "tests/oracle/disk_reference.hpp"
#include "tests/support/disk_states.hpp"

namespace isostat {
namespace {

using oracle::DiskReference;
using oracle::random_state;
using oracle::RandomDisks;
using oracle::soft_law;

// Largest differences over the bodies, positions by their nearest image.
struct Difference {
  double position = 0, velocity = 0, spin = 0;
};
Difference difference(const State<Disks>& s, const DiskReference& reference) {
  Difference d;
  const Bodies<2>& b = s.packing.bodies;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const oracle::DiskMoment& r = reference.disk(b.id[k]);
    Vec2 apart = b.position[k] - Vec2{{r.x, r.y}};
    apart += s.packing.cell->offset(s.packing.cell->nearest_image(apart));
    d.position = std::max(d.position, norm(apart));
    const Vec2 v{{r.velocity_x(s.time_step), r.velocity_y(s.time_step)}};
    d.velocity = std::max(d.velocity, norm(b.velocity[k] - v));
    d.spin = std::max(d.spin, std::abs(b.spin[k] - r.spin(s.time_step)));
  }
  return d;
}

CellControl<2> barostat(const State<Disks>& s, double pressure, double cap = 0) {
  CellControl<2> c;
  c.stress = isotropic<2>(pressure), c.max_strain_rate = cap, c.inertia = 0.3 * oracle::total_mass(s);
  return c;
}

struct RunCase {
  const char* name;
  RandomDisks disks;
  std::optional<double> pressure;
  bool rate_coupling = false;
  double drag = 0;
  std::int64_t steps = 300;
  double edge_speed = INFINITY;
};

RandomDisks with(LawScene law, std::uint64_t seed = 1) {
  RandomDisks r;
  r.law = law, r.seed = seed;
  return r;
}
LawScene frictionless() {
  LawScene law = soft_law();
  law.friction = 0, law.rolling = false;
  return law;
}
LawScene no_cohesion(LawScene law) {
  law.attraction = 0;
  return law;
}
LawScene no_rolling(LawScene law) {
  law.rolling = false;
  return law;
}

std::vector<RunCase> run_cases() {
  RandomDisks polydisperse = with(soft_law(), 5);
  polydisperse.diameter_min = 0.1, polydisperse.step_fraction = 0.01, polydisperse.speed = 0.5,
  polydisperse.squeeze = 0.96;
  RandomDisks pair = with(soft_law(), 3);
  pair.count = 2, pair.solid_fraction = 0.3, pair.squeeze = 0.8;
  RandomDisks strip = with(soft_law(), 4);
  strip.aspect = 9;
  return {{"cohesion friction rolling, fixed", with(soft_law(), 1), {}},
          {"cohesion friction rolling, free", with(soft_law(), 2), 40.0},
          {"friction rolling, free", with(no_cohesion(soft_law()), 3), 40.0},
          {"friction, fixed", with(no_cohesion(no_rolling(soft_law())), 4), {}},
          {"cohesion friction, free", with(no_rolling(soft_law()), 5), 20.0},
          {"frictionless, fixed", with(no_cohesion(frictionless()), 6), {}},
          {"cohesion, free", with(frictionless(), 7), 20.0},
          {"rate coupling and drag", with(soft_law(), 8), 30.0, true, 0.5},
          {"size ratio 10", polydisperse, 10.0},
          {"two disks", pair, 2.0},
          {"a strip", strip, 30.0},
          {"a strip with slow edges", strip, 30.0, false, 0, 300, 0.7},
          {"expanding", with(soft_law(), 9), -20.0}};
}

TEST(Solver, DrivesOneDirectionAndLoadsTheOther) {
  State<Disks> s = random_state(with(soft_law(), 11));
  CellControl<2> control = barostat(s, 20, 2.0);
  control.stress[1].reset();
  control.strain_rate = {{0, -0.7}};
  DiskReference reference(s, control);
  Solver solver(s, control);
  for (int k = 0; k < 300; ++k) solver.step(), reference.step();
  solver.snapshot(s);
  const Difference d = difference(s, reference);
  EXPECT_LT(d.position, 1e-10);
  EXPECT_LT(d.velocity, 1e-8);
  EXPECT_DOUBLE_EQ(s.cell_motion.strain_rate[1], -0.7);
  EXPECT_NEAR(s.packing.cell->length[1] / s.cell_motion.reference_length[1], 1 + 0.7 * s.time, 1e-12);
  EXPECT_NEAR(s.packing.cell->length[0], reference.length()[0], 1e-10);
  EXPECT_NE(s.packing.cell->length[0], s.cell_motion.reference_length[0]);
}

TEST(Solver, MarchesLikeTheReferenceSolver) {
  for (const RunCase& c : run_cases()) {
    SCOPED_TRACE(c.name);
    State<Disks> s = random_state(c.disks);
    CellControl<2> control;
    if (c.pressure) control = barostat(s, *c.pressure, 2.0);
    control.rate_coupling = c.rate_coupling;
    control.max_edge_speed = c.edge_speed;
    DiskReference reference(s, control);
    Solver solver(s, control);
    solver.set_drag(c.drag), reference.set_drag(c.drag);
    std::size_t most = 0;
    for (std::int64_t k = 0; k < c.steps; ++k) {
      solver.step(), reference.step();
      most = std::max(most, reference.interactions());
    }
    solver.snapshot(s);
    const Difference d = difference(s, reference);
    EXPECT_LT(d.position, 1e-10);
    EXPECT_LT(d.velocity, 1e-8);
    EXPECT_LT(d.spin, 1e-7);
    EXPECT_GT(most, c.disks.count / 4) << "the test looks at interacting grains";
    if (c.pressure) {
      for (int a = 0; a < 2; ++a) {
        const auto k = static_cast<std::size_t>(a);
        EXPECT_NEAR(s.packing.cell->length[a], reference.length()[k], 1e-10);
        EXPECT_NEAR(s.cell_motion.strain_rate[a], reference.strain_rate()[k], 1e-9);
        EXPECT_NEAR(s.cell_motion.stress[a], reference.stress()[k], 1e-7 * std::abs(*c.pressure));
      }
      EXPECT_GT(std::abs(s.packing.cell->length[0] / s.cell_motion.reference_length[0] - 1), 0.005) << "the cell moved";
    }
    EXPECT_GT(solver.engine().lists().inner_rebuilds(), 2u);
  }
}

// The reference never lowers its tilt: that the cell turns back, several times here, changes nothing.
TEST(Solver, ShearsLikeTheReferenceSolver) {
  struct Case {
    const char* name;
    RandomDisks disks;
    std::optional<double> stress_1, stress_2, stress_12;
    double shear_rate;
    bool rate_coupling = false;
    double drag = 0;
  };
  RandomDisks strip = with(soft_law(), 4), polydisperse = with(soft_law(), 5);
  strip.aspect = 5;
  polydisperse.diameter_min = 0.1, polydisperse.step_fraction = 0.02, polydisperse.speed = 0.5;
  for (const Case& c : {Case{"constant volume", with(soft_law(), 1), {}, {}, {}, 6},
                        Case{"constant normal stress", with(soft_law(), 2), {}, 40, {}, -6},
                        Case{"both edges free", with(no_cohesion(soft_law()), 3), 30, 40, {}, 6},
                        Case{"shear stress alone", with(frictionless(), 4), {}, {}, -30, 0},
                        Case{"all three stresses", with(no_rolling(soft_law()), 5), 30, 40, 20, 0},
                        Case{"rate coupling and drag", with(soft_law(), 6), 30, 40, {}, 6, true, 0.5},
                        Case{"a strip", strip, 30, 40, {}, 6}, Case{"size ratio 10", polydisperse, {}, 10, {}, 6}}) {
    SCOPED_TRACE(c.name);
    State<Disks> s = random_state(c.disks);
    CellControl<2> control = barostat(s, 0, 2.0);
    control.stress[0] = c.stress_1, control.stress[1] = c.stress_2, control.stress.shear = c.stress_12;
    control.shear_rate = c.shear_rate, control.rate_coupling = c.rate_coupling;
    DiskReference reference(s, control);
    Solver solver(s, control);
    solver.set_drag(c.drag), reference.set_drag(c.drag);
    int lowered = 0;
    for (int k = 0; k < 400; ++k) {
      const double before = solver.cell()->tilt;
      solver.step(), reference.step();
      lowered += std::abs(solver.cell()->tilt - before) > 0.5 * solver.cell()->length[0];
      ASSERT_LE(std::abs(solver.cell()->tilt), 0.5 * solver.cell()->length[0]);
    }
    solver.snapshot(s);
    const PeriodicCell<2>& cell = *s.packing.cell;
    EXPECT_GE(lowered, c.shear_rate != 0 && c.disks.aspect == 1 && c.disks.diameter_min > 0.2 ? 2 : 0);
    EXPECT_NEAR(cell.tilt, reference.tilt() - std::lround(reference.tilt() / cell.length[0]) * cell.length[0], 1e-9);
    EXPECT_NEAR(s.cell_motion.shear_strain_rate, reference.shear_strain_rate(), 1e-9);
    EXPECT_NEAR(s.cell_motion.shear_stress, reference.shear_stress(), 1e-6);
    const Difference d = difference(s, reference);
    EXPECT_LT(d.position, 1e-9);
    EXPECT_LT(d.velocity, 1e-7);
    EXPECT_LT(d.spin, 1e-6);
    EXPECT_GT(reference.interactions(), 10u);
    for (int a = 0; a < 2; ++a) EXPECT_NEAR(cell.length[a], reference.length()[static_cast<std::size_t>(a)], 1e-9);
  }
}

// Every interacting pair and image, once, as brute force finds it.
using PairName = std::tuple<std::int64_t, std::int64_t, int, int>;
PairName named(std::int64_t a, std::int64_t b, int s1, int s2) {
  return a < b ? PairName{a, b, s1, s2} : PairName{b, a, -s1, -s2};
}
std::set<PairName> brute_force_links(const State<Disks>& s) {
  std::set<PairName> found;
  const Bodies<2>& b = s.packing.bodies;
  for (std::size_t i = 0; i < b.size(); ++i)
    for (std::size_t j = i + 1; j < b.size(); ++j)
      for (int s1 = -3; s1 <= 3; ++s1)
        for (int s2 = -3; s2 <= 3; ++s2) {
          const Vec2 r = b.position[j] + s.packing.cell->offset({s1, s2}) - b.position[i];
          const double gap = norm(r) - b.radius[i] - b.radius[j];
          if (gap < 0 || gap < s.law.attraction_range) found.insert(named(b.id[i], b.id[j], s1, s2));
        }
  return found;
}
std::multiset<PairName> listed_links(const State<Disks>& s) {
  std::multiset<PairName> found;
  for (const Link<2>& l : s.packing.links)
    found.insert(named(s.packing.bodies.id[static_cast<std::size_t>(l.i)],
                       s.packing.bodies.id[static_cast<std::size_t>(l.j)], l.shift[0], l.shift[1]));
  return found;
}

TEST(NeighbourLists, HoldEveryInteractionOnceWhateverTheCellDoes) {
  struct Case {
    const char* name;
    int count;
    double solid_fraction, squeeze, diameter_min, aspect, pressure, range;
    std::int64_t steps;
    std::size_t links;  // seen at once, at least
    double shear_rate = 0;
  };
  // Cells down to just above the interaction range: there a pair touches through several images at once.
  for (const Case& c : {Case{"compression", 60, 0.4, 1, 0.5, 1, 200, 0.05, 400, 60},
                        Case{"size ratio 10", 80, 0.35, 1, 0.1, 1, 100, 0.05, 300, 25},
                        Case{"long range", 40, 0.15, 0.8, 0.5, 1, 20, 0.6, 200, 60},
                        Case{"two disks", 2, 0.3, 0.8, 0.5, 1, 5, 0.05, 300, 1},
                        Case{"two equal disks, tiny cell", 2, 0.3, 0.56, 0.99, 1, 0, 0.05, 300, 3},
                        Case{"three disks in a narrow strip", 3, 0.3, 0.75, 0.9, 3.2, 0, 0.05, 300, 2},
                        Case{"expansion", 60, 0.5, 0.92, 0.5, 1, -100, 0.05, 300, 30},
                        Case{"more pairs than a deck", 300, 0.5, 0.92, 0.5, 1, 200, 0.05, 140, 300},
                        Case{"shear", 60, 0.5, 0.92, 0.5, 1, 0, 0.05, 400, 60, 6},
                        Case{"shear and compression", 60, 0.4, 1, 0.5, 1, 200, 0.05, 400, 60, -6},
                        Case{"shear, size ratio 10", 80, 0.35, 1, 0.1, 1, 100, 0.05, 300, 25, 20},
                        Case{"shear, long range", 40, 0.15, 0.8, 0.5, 1, 20, 0.6, 200, 60, 6},
                        Case{"shear of three disks in a narrow strip", 3, 0.3, 0.75, 0.9, 3.2, 0, 0.05, 300, 2, 6}}) {
    SCOPED_TRACE(c.name);
    RandomDisks r;
    r.count = c.count, r.solid_fraction = c.solid_fraction, r.squeeze = c.squeeze, r.aspect = c.aspect;
    r.diameter_min = c.diameter_min, r.law = soft_law(), r.law.attraction_range = c.range;
    if (c.diameter_min < 0.2) r.step_fraction = 0.01;
    State<Disks> s = random_state(r);
    CellControl<2> control = c.pressure == 0 ? CellControl<2>{} : barostat(s, c.pressure, 3.0);
    control.shear_rate = c.shear_rate;
    Solver solver(s, control);
    std::size_t most = 0;
    for (std::int64_t k = 0; k < c.steps; ++k) {
      if (k % 7 == 0) {
        solver.snapshot(s);
        const std::set<PairName> expected = brute_force_links(s);
        most = std::max(most, expected.size());
        ASSERT_EQ(listed_links(s), std::multiset<PairName>(expected.begin(), expected.end())) << "step " << k;
      }
      solver.step();
    }
    EXPECT_GE(most, c.links);
    EXPECT_GT(solver.engine().lists().inner_rebuilds(), 3u);
  }
}

TEST(NeighbourLists, ACellSmallerThanAGrainIsRefused) {
  RandomDisks r;
  r.count = 1, r.solid_fraction = 0.5, r.squeeze = 0.5, r.law = soft_law();
  EXPECT_THROW(Solver(random_state(r), CellControl<2>{}), RunError);
  // ... and also when it becomes so in the run.
  r.count = 2, r.squeeze = 1, r.solid_fraction = 0.3;
  const State<Disks> s = random_state(r);
  Solver solver(s, barostat(s, 3e3, 5.0));
  EXPECT_THROW(solver.run(20000), RunError);
}

// Springs stay with their pair through rebuilds, re-sorting and wrapping: a moving, turning packing against the
// reference, which does none of these, spring by spring.
TEST(NeighbourLists, CarryTheSpringsOfEveryPair) {
  RandomDisks r;
  r.law = soft_law(), r.law.friction = 5, r.law.rolling_friction = 1;  // springs that stretch and rarely yield
  r.speed = 0.5, r.seed = 21;
  State<Disks> s = random_state(r);
  for (Vec2& v : s.packing.bodies.velocity) v += Vec2{{12, -8}};  // several cells in the run
  const CellControl<2> control = barostat(s, 30, 2.0);
  DiskReference reference(s, control);
  Solver solver(s, control);
  for (int k = 0; k < 600; ++k) solver.step(), reference.step();
  EXPECT_GT(solver.engine().lists().outer_rebuilds(), 3u);
  solver.snapshot(s);

  // By ids; the image follows from the nearest one, as wrapped and unwrapped coordinates count images differently.
  auto ids = [](std::int64_t a, std::int64_t b) { return std::pair(std::min(a, b), std::max(a, b)); };
  std::map<std::pair<std::int64_t, std::int64_t>, DiskReference::Spring> expected;
  for (const auto& [key, spring] : reference.springs()) {
    const std::int64_t i = reference.disks()[static_cast<std::size_t>(key[0])].id;
    const std::int64_t j = reference.disks()[static_cast<std::size_t>(key[1])].id;
    if (spring.tangential == 0 && spring.moment == 0) continue;
    ASSERT_TRUE(
        expected.emplace(ids(i, j), DiskReference::Spring{spring.tangential, i < j ? spring.moment : -spring.moment})
            .second);
  }
  ASSERT_GT(expected.size(), 12u);
  std::size_t stressed = 0;
  for (const Link<2>& l : s.packing.links) {
    if (l.tangential_force == 0 && l.moment == 0) continue;
    const std::int64_t i = s.packing.bodies.id[static_cast<std::size_t>(l.i)];
    const std::int64_t j = s.packing.bodies.id[static_cast<std::size_t>(l.j)];
    ASSERT_TRUE(expected.contains(ids(i, j)));
    const DiskReference::Spring e = expected[ids(i, j)];
    EXPECT_NEAR(l.tangential_force, e.tangential, 1e-7);
    EXPECT_NEAR(i < j ? l.moment : -l.moment, e.moment, 1e-8);
    ++stressed;
  }
  EXPECT_EQ(stressed, expected.size());
}

// A foreign packing whose links point the other way and count images from coordinates outside the cell starts with the
// same springs.
TEST(NeighbourLists, TakeSpringsOfForeignLinks) {
  RandomDisks r;
  r.law = soft_law();
  State<Disks> s = random_state(r);
  {
    Solver solver(s, {});
    solver.run(60);
    solver.snapshot(s);
  }
  State<Disks> turned = s;
  turned.memory = {};
  s.memory = {};
  const Vec2 cell = s.packing.cell->length;
  for (std::size_t k = 0; k < turned.packing.bodies.size(); k += 3)
    turned.packing.bodies.position[k] += Vec2{{2 * cell[0], -3 * cell[1]}};
  for (Link<2>& l : turned.packing.links) {
    const bool moved_i = l.i % 3 == 0, moved_j = l.j % 3 == 0;
    l.shift[0] += 2 * (moved_i - moved_j), l.shift[1] += -3 * (moved_i - moved_j);
    std::swap(l.i, l.j);
    l.shift = {-l.shift[0], -l.shift[1]};
    l.moment = -l.moment;
  }
  Solver a(s, {}), b(turned, {});
  a.run(100), b.run(100);
  a.snapshot(s), b.snapshot(turned);
  std::map<std::int64_t, Vec2> at;
  for (std::size_t k = 0; k < s.packing.bodies.size(); ++k) at[s.packing.bodies.id[k]] = s.packing.bodies.velocity[k];
  for (std::size_t k = 0; k < s.packing.bodies.size(); ++k)
    EXPECT_LT(norm(turned.packing.bodies.velocity[k] - at[turned.packing.bodies.id[k]]), 1e-8);
}

}  // namespace
}  // namespace isostat
