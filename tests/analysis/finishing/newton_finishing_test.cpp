// Packings brought to rest by static solves: against the solver marched to the end, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "analysis/finishing/newton_finishing.hpp"
#include "dem/disks/certificate.hpp"
#include "dem/disks/energy.hpp"
#include "dem/disks/engine.hpp"
#include "dem/disks/physical_hash.hpp"
#include "dem/disks/sample.hpp"
#include "dem/files/state_file.hpp"
#include "dem/input_error.hpp"
#include "dem/run/stages.hpp"
#include "dem/state/balance.hpp"
#include "tests/support/disk_states.hpp"

namespace isostat {
namespace {

constexpr double kPressure = 0.5;

Scene scene_of(Finish method, bool rolling = true, double attraction = 1) {
  Scene scene;
  scene.grains.count = 60;
  scene.law.normal_stiffness = 1e4;
  scene.law.attraction = attraction, scene.law.rolling = rolling;
  scene.law.attraction_range = 1e-2;
  scene.finish.method = method;
  StageScene stage;
  stage.pressure = attraction > 0 ? kPressure : 1.0;
  stage.max_strain_rate = 0.2;
  scene.stages = {stage};
  return scene;
}

constexpr int kUnloadings = 20;

FinishingRequest<2> request_for(const State<Disks>& s, double stress) {
  return {{stress, stress}, s.scene.cell.inertia * oracle::total_mass(s)};
}

// One instruction set, hence the same packings on every machine.
SolverOptions same_everywhere() {
  SolverOptions options;
  options.isa = Isa::scalar;
  return options;
}

// A compression stopped while the packing still rings.
State<Disks> ringing(const Scene& scene, std::uint64_t seed, double time) {
  State<Disks> s = initial_disks(scene, seed);
  RunHooks<Disks> hooks;
  hooks.max_time = time;
  run_stages(s, same_everywhere(), hooks);
  return s;
}

// Marched on by the solver under a drag, to forces far below the tolerance: the slow, obvious way to rest.
State<Disks> marched_to_rest(State<Disks> s, double stress, double time) {
  CellControl<2> c;
  c.stress = isotropic<2>(stress), c.max_strain_rate = 0.2;
  c.inertia = s.scene.cell.inertia * oracle::total_mass(s);
  Solver solver(s, c, same_everywhere());
  solver.set_drag(1.0);
  solver.run(static_cast<std::int64_t>(time / s.time_step));
  solver.snapshot(s);
  return s;
}

using Name = std::tuple<std::int64_t, std::int64_t>;  // ids; no two images of a pair in these packings
std::map<Name, Link<2>> by_ids(const State<Disks>& s) {
  std::map<Name, Link<2>> links;
  for (const Link<2>& l : s.packing.links) {
    const auto i = s.packing.bodies.id[static_cast<std::size_t>(l.i)];
    const auto j = s.packing.bodies.id[static_cast<std::size_t>(l.j)];
    Link<2> turned = l;
    if (i > j) turned.moment = -l.moment;
    links[{std::min(i, j), std::max(i, j)}] = turned;
  }
  return links;
}

TEST(NewtonFinishing, EndsWhereTheSolverEnds) {
  for (const bool rolling : {true, false})
    for (const double attraction : {1.0, 0.0}) {
      SCOPED_TRACE(std::string(rolling ? "rolling" : "friction") + (attraction > 0 ? ", cohesion" : ""));
      const double stress = attraction > 0 ? kPressure : 1.0;
      const State<Disks> start = ringing(scene_of(Finish::none, rolling, attraction), 3, 60);
      ASSERT_GT(start.certificate.max_force, 1e-6);
      State<Disks> s = start;
      const FinishingReport report = NewtonFinishing().settle(s, request_for(s, stress));
      ASSERT_TRUE(report.settled) << report.reason;
      EXPECT_EQ(report.moving, 0);
      const Certificate c = evaluate_certificate(s);
      EXPECT_TRUE(c.equilibrated);
      EXPECT_EQ(c.kinetic_energy_per_grain, 0);
      // Rounding of coordinates: K_N eps L, with L about 10.
      EXPECT_LT(c.max_force, 2e-10);
      EXPECT_LT(c.max_moment, 2e-10);
      EXPECT_LT(c.pressure_error, 2e-10);
      EXPECT_TRUE(s.memory.half_velocity.empty());
      EXPECT_EQ(s.time, start.time);

      // What the links store is what they store marched to rest; the ledger would balance whatever was written into it.
      const State<Disks> marched = marched_to_rest(start, stress, 300);
      const Energies there = energies(s), twin = energies(marched);
      EXPECT_NEAR(there.elastic, twin.elastic, 1e-7 * twin.elastic);
      EXPECT_NEAR(there.elastic + there.adhesive, twin.elastic + twin.adhesive, 1e-7 * twin.elastic);

      // The same network of forces, both ways; without cohesion rattlers touch here and there, unloaded.
      const auto fast = by_ids(s), slow = by_ids(marched);
      double largest = 0;
      for (const auto& [name, link] : slow) largest = std::max(largest, std::abs(link.normal_force));
      const auto agree = [largest](const auto& one, const auto& other) {
        int loaded = 0;
        for (const auto& [name, link] : one) {
          if (std::abs(link.normal_force) < 0.02 * largest) continue;
          ++loaded;
          ASSERT_TRUE(other.contains(name));
          EXPECT_NEAR(other.at(name).normal_force, link.normal_force, 0.01 * largest);
          EXPECT_NEAR(other.at(name).tangential_force, link.tangential_force, 0.01 * largest);
        }
        EXPECT_GT(loaded, 40);
      };
      agree(fast, slow), agree(slow, fast);
      if (attraction > 0) {
        EXPECT_EQ(fast.size(), slow.size());
      }
      // The solver takes it for rest too: nothing happens in a few T0.
      const State<Disks> later = marched_to_rest(s, stress, 5);
      EXPECT_LT(evaluate_certificate(later.packing, s.law, isotropic<2>(stress), s.scene.equilibrium).max_force, 1e-9);
    }
}

// The load is taken back by two fifths, little by little so that nothing rings: contacts open, and the springs of the
// others know where they came from.
TEST(NewtonFinishing, ContactsOpenWhileItSettles) {
  State<Disks> fast = ringing(scene_of(Finish::none, false, 0.0), 3, 60);
  ASSERT_TRUE(NewtonFinishing().settle(fast, request_for(fast, 1.0)).settled);
  const auto before = by_ids(fast);
  State<Disks> slow = fast;
  for (int k = 1; k <= kUnloadings; ++k) {
    const double stress = 1 - 0.4 * k / kUnloadings;
    fast.imposed_stress = isotropic<2>(stress);
    const FinishingReport report = NewtonFinishing().settle(fast, request_for(fast, stress));
    ASSERT_TRUE(report.settled) << report.reason;
    EXPECT_LT(report.residual, 2e-10);
    slow = marched_to_rest(slow, stress, 20);
  }
  const auto after = by_ids(fast), reference = by_ids(slow);
  int opened = 0, missing = 0;
  for (const auto& [name, link] : before) opened += !after.contains(name);
  EXPECT_GT(opened, 0);
  double largest = 0, difference = 0;
  for (const auto& [name, link] : reference) {
    missing += !after.contains(name);
    largest = std::max(largest, link.normal_force);
    if (after.contains(name))
      difference = std::max(difference, std::abs(after.at(name).normal_force - link.normal_force));
  }
  EXPECT_EQ(missing, 0);
  EXPECT_LT(difference, 0.03 * largest);
}

TEST(NewtonFinishing, LeavesAStateItCannotSettleAsItIs) {
  // A fast gas: nothing takes its energy, and it goes so far in a step that explicit ones are as good.
  Scene scene = scene_of(Finish::none, false, 0);
  scene.stages[0].pressure = std::nullopt;
  scene.stages[0].until = Until::time, scene.stages[0].time = 1;
  State<Disks> start = initial_disks(scene, 3);
  for (std::size_t k = 0; k < start.packing.bodies.size(); ++k)
    start.packing.bodies.velocity[k] = {{8 * std::cos(static_cast<double>(k)), 8 * std::sin(static_cast<double>(k))}};
  start.law.damping = 0;
  run_stages(start, {}, {});
  State<Disks> s = start;
  const FinishingReport report = NewtonFinishing().settle(s, {{}, 1});
  EXPECT_FALSE(report.settled);
  EXPECT_FALSE(report.reason.empty());
  EXPECT_TRUE(encode_state(s) == encode_state(start));
}

// Grains apart in a cell under a stress below the tolerance: by the criteria an equilibrium, but nothing ever stops it.
TEST(NewtonFinishing, CallsAFloppyModeThatStillMovesNoEquilibrium) {
  State<Disks> s = initial_disks(scene_of(Finish::none), 3);
  ASSERT_TRUE(s.packing.links.empty());
  s.imposed_stress = isotropic<2>(5e-5);
  const FinishingReport report = NewtonFinishing().settle(s, request_for(s, 5e-5));
  EXPECT_FALSE(report.settled);
  EXPECT_TRUE(report.advanced);
  EXPECT_TRUE(report.stuck);
  EXPECT_GT(report.moving, 0);
  EXPECT_NEAR(report.residual, 5e-5, 1e-6);
  EXPECT_EQ(report.reason, "floppy or very soft modes still move " + std::to_string(report.moving) + " grains");
}

// Two grains fly towards each other: taken to where the attraction begins, with the momentum and energy they have.
TEST(NewtonFinishing, StopsJustBeforeACapture) {
  Scene scene = scene_of(Finish::none);
  scene.grains.count = 2;
  scene.stages[0].pressure = std::nullopt;
  State<Disks> s = initial_disks(scene, 1);
  Bodies<2>& b = s.packing.bodies;
  s.packing.cell->length = {{8, 8}};
  const double sum = b.radius[0] + b.radius[1], gap = 0.1, speed = 1e-3;
  b.position = {{{3, 4}}, {{3 + sum + gap, 4}}};
  b.velocity = {{{speed, 0}}, {{0, 0}}};
  const FinishingReport report = NewtonFinishing().settle(s, {});
  EXPECT_FALSE(report.settled);
  EXPECT_TRUE(report.capture);
  EXPECT_TRUE(report.advanced);
  EXPECT_LT(report.steps, 60);
  const double left = norm(b.position[1] - b.position[0]) - sum;
  EXPECT_GE(left, s.law.attraction_range);
  EXPECT_LT(left, s.law.attraction_range + 0.5 * speed * 1.01);  // half a T0 away at most
  EXPECT_NEAR(b.velocity[0][0], speed, 1e-9 * speed);
  EXPECT_NEAR(b.velocity[1][0], 0, 1e-9 * speed);
  // At once if there is nothing to skip: then the state stays as it is.
  const State<Disks> before = s;
  const FinishingReport again = NewtonFinishing().settle(s, {});
  EXPECT_TRUE(again.capture);
  EXPECT_TRUE(again.advanced || encode_state(s) == encode_state(before));
}

// The storage order is the solver's business: turned around, the same bits come out.
TEST(NewtonFinishing, DoesNotSeeTheStorageOrder) {
  State<Disks> a = ringing(scene_of(Finish::none), 4, 60);
  State<Disks> b = a;
  const auto n = static_cast<std::int32_t>(a.packing.bodies.size());
  const Bodies<2>& from = a.packing.bodies;
  Bodies<2>& to = b.packing.bodies;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const std::size_t o = from.size() - 1 - k;
    to.id[k] = from.id[o], to.position[k] = from.position[o], to.velocity[k] = from.velocity[o];
    to.spin[k] = from.spin[o], to.radius[k] = from.radius[o], to.mass[k] = from.mass[o],
    to.inertia[k] = from.inertia[o];
  }
  b.memory = {};
  for (Link<2>& l : b.packing.links) l.i = n - 1 - l.i, l.j = n - 1 - l.j;
  std::reverse(b.packing.links.begin(), b.packing.links.end());
  const FinishingRequest<2> request = request_for(a, kPressure);
  ASSERT_TRUE(NewtonFinishing().settle(a, request).settled);
  ASSERT_TRUE(NewtonFinishing().settle(b, request).settled);
  for (std::size_t k = 0; k < from.size(); ++k)
    EXPECT_TRUE(a.packing.bodies.position[k] == to.position[from.size() - 1 - k]) << k;
  EXPECT_EQ(a.packing.cell->length, b.packing.cell->length);
  const auto links_a = by_ids(a), links_b = by_ids(b);
  for (const auto& [name, link] : links_a) EXPECT_EQ(links_b.at(name).tangential_force, link.tangential_force);
}

TEST(NewtonFinishing, OneEdgeMayBeFixed) {
  const State<Disks> start = ringing(scene_of(Finish::none), 3, 60);
  State<Disks> s = start;
  FinishingRequest<2> q = request_for(s, kPressure);
  q.stress = {std::nullopt, kPressure};
  const FinishingReport report = NewtonFinishing().settle(s, q);
  ASSERT_TRUE(report.settled) << report.reason;
  EXPECT_EQ(s.packing.cell->length[0], start.packing.cell->length[0]);
  EXPECT_NE(s.packing.cell->length[1], start.packing.cell->length[1]);
  EXPECT_NEAR(measured_stress(s.packing).yy, kPressure, 1e-9);
}

TEST(NewtonFinishing, EndsAStageOfARun) {
  const Scene scene = scene_of(Finish::newton);
  State<Disks> s = initial_disks(scene, 5);
  NewtonFinishing finisher;
  const RunOutcome outcome = run_stages(s, {}, {}, &finisher);
  ASSERT_TRUE(outcome.all_met());
  EXPECT_EQ(s.certificate.finishing, "newton");
  EXPECT_TRUE(s.certificate.equilibrated);
  EXPECT_LT(s.certificate.max_force, 1e-9);
  EXPECT_LT(s.certificate.kinetic_energy_per_grain, 1e-20);
}

// The criteria hold at the first look at a stage that begins near rest, at forces just below the tolerance.
TEST(NewtonFinishing, EndsAStageThatBeginsWithinTheCriteria) {
  Scene scene = scene_of(Finish::drag);
  State<Disks> loose = initial_disks(scene, 5);
  ASSERT_TRUE(run_stages(loose, {}, {}).all_met());
  ASSERT_GT(loose.certificate.max_force, 1e-7);
  scene.finish.method = Finish::newton;
  State<Disks> s = loose;
  s.scene = scene, s.progress = {};
  NewtonFinishing finisher;
  const RunOutcome outcome = run_stages(s, {}, {}, &finisher);
  ASSERT_TRUE(outcome.all_met());
  EXPECT_EQ(outcome.steps, 0);
  EXPECT_LT(s.certificate.max_force, 1e-9);
}

TEST(NewtonFinishing, AStageThatEndsWithAFloppyModeInMotionSaysSo) {
  Scene scene = scene_of(Finish::newton);
  scene.stages[0].pressure = 5e-5;  // below the tolerance: grains apart meet the criteria
  State<Disks> s = initial_disks(scene, 3);
  ASSERT_TRUE(s.packing.links.empty());
  NewtonFinishing finisher;
  const RunOutcome outcome = run_stages(s, {}, {}, &finisher);
  ASSERT_TRUE(outcome.all_met());
  EXPECT_GT(outcome.stages[0].moving, 0);
  EXPECT_EQ(s.certificate.moving, outcome.stages[0].moving);
  EXPECT_EQ(evaluate_certificate(s).moving, outcome.stages[0].moving);
}

TEST(NewtonFinishing, ARunWithoutASolverIsRefused) {
  State<Disks> s = initial_disks(scene_of(Finish::newton), 5);
  EXPECT_THROW(run_stages(s, {}, {}), InputError);
}

// Refuses so many times before it does its work: the run must go on by itself meanwhile.
class Reluctant : public StaticSolver<Disks> {
 public:
  explicit Reluctant(int refusals) : left_(refusals) {}
  FinishingReport settle(State<Disks>& state, const FinishingRequest<2>& request) override {
    times.push_back(state.time);
    if (left_-- > 0) return {};
    return finisher_.settle(state, request);
  }
  std::vector<double> times;

 private:
  NewtonFinishing finisher_;
  int left_;
};

// Interrupted every few looks, through the state file; tries that fail included.
TEST(NewtonFinishing, AnInterruptedRunGoesOnAsIfItHadNotBeen) {
  Scene scene = scene_of(Finish::newton);
  scene.equilibrium.force = 1e-9, scene.equilibrium.pressure = 1e-9;  // out of reach for the bare run
  scene.finish.quiet_time = 2;
  State<Disks> straight = initial_disks(scene, 6);
  Reluctant finisher(3);
  ASSERT_TRUE(run_stages(straight, {}, {}, &finisher).all_met());
  ASSERT_EQ(finisher.times.size(), 4u);
  for (std::size_t k = 0; k + 2 < finisher.times.size(); ++k)
    EXPECT_GE(finisher.times[k + 2] - finisher.times[k + 1], finisher.times[k + 1] - finisher.times[k]);

  State<Disks> s = initial_disks(scene, 6);
  Reluctant resumed(3);
  int interruptions = 0;
  for (bool done = false; !done && interruptions < 1000;) {
    int polls = 0;
    RunHooks<Disks> hooks;
    hooks.interrupted = [&] { return ++polls > 3; };  // never long enough for a whole solve
    done = !run_stages(s, {}, hooks, &resumed).interrupted;
    if (!done) s = std::get<State<Disks>>(decode_state(encode_state(s), "memory").state), ++interruptions;
  }
  EXPECT_GT(interruptions, 5);
  EXPECT_GT(resumed.times.size(), finisher.times.size()) << "no solve was interrupted";
  resumed.times.erase(std::unique(resumed.times.begin(), resumed.times.end()), resumed.times.end());
  EXPECT_EQ(resumed.times, finisher.times);
  EXPECT_EQ(physical_hash(s), physical_hash(straight));
}

// A checkpoint is due at every implicit step: from any of those that were written, also within a solve, the run goes on
// to the same bits. A kill costs one step.
TEST(NewtonFinishing, GoesOnFromACheckpointWithinASolve) {
  Scene scene = scene_of(Finish::newton);
  State<Disks> straight = initial_disks(scene, 6);
  NewtonFinishing finisher;
  std::vector<std::string> kept;
  RunHooks<Disks> hooks;
  hooks.checkpoint_seconds = 1e-9;
  hooks.checkpoint = [&](const State<Disks>& s) {
    if (!s.memory.solve.numbers.empty()) kept.push_back(encode_state(s));
  };
  ASSERT_TRUE(run_stages(straight, {}, hooks, &finisher).all_met());
  EXPECT_TRUE(straight.memory.solve.numbers.empty());
  EXPECT_GT(straight.progress.solves, 0);
  ASSERT_GE(kept.size(), 3u) << "implicit steps of the scene's solves";
  for (std::size_t k = 0; k < kept.size(); ++k) {
    State<Disks> s = std::get<State<Disks>>(decode_state(kept[k], "memory").state);
    ASSERT_TRUE(run_stages(s, {}, {}, &finisher).all_met());
    EXPECT_EQ(physical_hash(s), physical_hash(straight)) << "checkpoint " << k << " of " << kept.size();
  }
}

}  // namespace
}  // namespace isostat
