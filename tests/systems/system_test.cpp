// What holds for every system: the same bits for any number of threads, after any restart, watched or not; files that
// give back what they were given; no force or momentum out of nothing; nothing that depends on the direction one looks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "tests/support/temporary_folder.hpp"
#include "tests/systems/fixtures.hpp"

namespace isostat::systems {
namespace {

// Nothing around the bodies moves.
template <class System>
void stand_still(State<System>& s) {
  if constexpr (requires { s.packing.walls; })
    for (auto& wall : s.packing.walls) wall.velocity = {};
}

template <class System>
class EverySystem : public ::testing::Test {};
TYPED_TEST_SUITE(EverySystem, Systems);

TYPED_TEST(EverySystem, HasTheSameBitsForAnyNumberOfThreads) {
  for (const auto& v : Fixture<TypeParam>::large(9000)) {
    SCOPED_TRACE(v.name);
    ASSERT_GT(Fixture<TypeParam>::chunks(v.state), 1);
    std::vector<std::string> images;
    for (const int threads : {1, 2, 3}) {
      SolverOptions options;
      options.threads = threads;
      images.push_back(bytes(marched(v.state, v.control, 60, options)));
    }
    EXPECT_EQ(images[1], images[0]);
    EXPECT_EQ(images[2], images[0]);
    EXPECT_NE(bytes(v.state), images[0]);
  }
}

// Cut anywhere, the run through a state file gives the bits of the straight run, lists in mid-life included.
TYPED_TEST(EverySystem, RestartsAsIfItHadRunStraight) {
  const TemporaryFolder folder;
  const std::string path = folder / "state.h5";
  SolverOptions watched;
  watched.energies = Fixture<TypeParam>::kLedger;
  for (const auto& v : Fixture<TypeParam>::variants(40)) {
    SCOPED_TRACE(v.name);
    Solver<TypeParam> straight(v.state, v.control, watched);
    straight.run(150);
    EXPECT_GE(straight.engine().lists().inner_rebuilds(), Fixture<TypeParam>::least_rebuilds(v.state));
    State<TypeParam> end = v.state;
    straight.snapshot(end);
    EXPECT_TRUE(Fixture<TypeParam>::is_lively(v, end));
    for (const std::int64_t cut : {1, 37, 149}) {
      write_state(marched(v.state, v.control, cut, watched), path);
      const State<TypeParam> resumed = read_state<TypeParam>(path);
      EXPECT_EQ(bytes(marched(resumed, v.control, 150 - cut, watched)), bytes(end)) << "cut at step " << cut;
    }
  }
}

// An edge goes as fast as the cap and no faster, whatever its length; a cap that is never reached changes no bit.
TYPED_TEST(EverySystem, CapsTheSpeedOfTheEdgesOfItsCell) {
  int capped = 0;
  for (const auto& v : Fixture<TypeParam>::variants(40)) {
    if (!largest_stress(v.control.stress)) continue;
    SCOPED_TRACE(v.name);
    const State<TypeParam> free = marched(v.state, v.control, 120);
    const auto speed = [](const State<TypeParam>& s, int a) {
      return std::abs(s.cell_motion.strain_rate[a]) * s.cell_motion.reference_length[a];
    };
    double fastest = 0;
    for (int a = 0; a < TypeParam::dimension; ++a) fastest = std::max(fastest, speed(free, a));
    auto control = v.control;
    control.max_edge_speed = 1e3 * fastest;
    EXPECT_EQ(bytes(marched(v.state, control, 120)), bytes(free));
    control.max_edge_speed = 0.3 * fastest;
    State<TypeParam> s = v.state;
    Solver<TypeParam> solver(s, control);
    double reached = 0;
    for (int k = 0; k < 120; ++k) {
      const auto before = s.packing.cell->length;
      solver.step();
      solver.snapshot(s);
      for (int a = 0; a < TypeParam::dimension; ++a) {
        const double moved = std::abs(s.packing.cell->length[a] - before[a]);
        EXPECT_LE(moved, (1 + 1e-9) * control.max_edge_speed * s.time_step);
        reached = std::max(reached, moved / (control.max_edge_speed * s.time_step));
      }
    }
    EXPECT_NEAR(reached, 1, 1e-9);
    ++capped;
  }
  EXPECT_GT(capped, 0);
}

// The ledger is kept by a dearer kernel; the physics does not notice. Snapshots only read.
TYPED_TEST(EverySystem, IsNotChangedByWatching) {
  for (const auto& v : Fixture<TypeParam>::variants(40)) {
    SCOPED_TRACE(v.name);
    const State<TypeParam> plain = marched(v.state, v.control, 120);
    SolverOptions watched;
    watched.energies = Fixture<TypeParam>::kLedger;
    Solver<TypeParam> solver(v.state, v.control, watched);
    State<TypeParam> seen = v.state;
    for (int k = 0; k < 120; ++k) {
      solver.step();
      solver.snapshot(seen);
    }
    EXPECT_EQ(physical_hash(seen), physical_hash(plain));
    seen.ledger = plain.ledger;
    EXPECT_EQ(bytes(seen), bytes(plain));
  }
}

TYPED_TEST(EverySystem, ComesBackFromItsFile) {
  for (const auto& v : Fixture<TypeParam>::variants(40)) {
    SCOPED_TRACE(v.name);
    const State<TypeParam> s = marched(v.state, v.control, 20);
    const StateFile file = decode_state(encode_state(s), "memory");
    ASSERT_TRUE(std::holds_alternative<State<TypeParam>>(file.state));
    EXPECT_EQ(encode_state(file.state), encode_state(s));
    EXPECT_EQ(file.hash, physical_hash(s));
  }
}

// The forces on the bodies are those of the links (viscous ones apart), each with its opposite on the other body.
TYPED_TEST(EverySystem, LoadsItsBodiesByItsLinks) {
  for (auto v : Fixture<TypeParam>::variants(40)) {
    SCOPED_TRACE(v.name);
    State<TypeParam> s = marched(v.state, v.control, 50);
    std::fill(s.packing.bodies.velocity.begin(), s.packing.bodies.velocity.end(), Vec<TypeParam::dimension>{});
    std::fill(s.packing.bodies.spin.begin(), s.packing.bodies.spin.end(), Spin<TypeParam::dimension>{});
    stand_still(s);
    s.memory = {}, s.cell_motion.strain_rate = {};
    s.progress.started = false;              // the container rests
    Solver<TypeParam> solver(s, v.control);  // evaluates the forces of the state as it stands
    solver.snapshot(s);
    const auto loads = Fixture<TypeParam>::loads(s);
    const double scale = Fixture<TypeParam>::largest_force(s);
    ASSERT_GT(scale, 1);
    Vec<TypeParam::dimension> sum{};
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const std::vector<double> felt = parts(s.memory.force[k], s.memory.torque[k]), linked = parts(loads[k]);
      for (std::size_t n = 0; n < felt.size(); ++n) EXPECT_NEAR(felt[n], linked[n], 1e-13 * scale);
      sum += s.memory.force[k];
    }
    if (Fixture<TypeParam>::closed(s)) {
      EXPECT_LT(norm(sum), 1e-12 * scale);
    }
  }
}

TYPED_TEST(EverySystem, KeepsItsMomentum) {
  const auto momentum = [](const State<TypeParam>& s) {
    Vec<TypeParam::dimension> p{};
    Spin<TypeParam::dimension> about_origin{};
    double size = 0;
    const auto& b = s.packing.bodies;
    for (std::size_t k = 0; k < b.size(); ++k) {
      p += b.mass[k] * b.velocity[k];
      about_origin += turning(b, k);
      size += b.mass[k] * norm(b.velocity[k]);
    }
    return std::tuple(p, about_origin, size);
  };
  for (const auto& v : Fixture<TypeParam>::variants(40)) {
    if (v.control.moves() || !Fixture<TypeParam>::closed(v.state)) continue;  // velocities relative to the flow; walls
    SCOPED_TRACE(v.name);
    const auto [before, turning_before, size] = momentum(v.state);
    const auto [after, turning_after, unused] = momentum(marched(v.state, v.control, 300));
    EXPECT_LT(norm(after - before), 1e-12 * size);
    if (!v.state.packing.cell) {
      EXPECT_LT(size_of(turning_after - turning_before), Fixture<TypeParam>::angular_tolerance(v.state) * size);
    }
  }
}

TYPED_TEST(EverySystem, LooksTheSameFromEveryDirection) {
  constexpr double kAngle = 0.7;
  for (const auto& v : Fixture<TypeParam>::variants(40)) {
    if (v.state.packing.cell || !Fixture<TypeParam>::closed(v.state)) continue;
    SCOPED_TRACE(v.name);
    const State<TypeParam> turned = marched(Fixture<TypeParam>::turned(v.state, kAngle), v.control, 60);
    const State<TypeParam> straight = Fixture<TypeParam>::turned(marched(v.state, v.control, 60), kAngle);
    std::map<std::int64_t, Vec<TypeParam::dimension>> place;
    for (std::size_t k = 0; k < straight.packing.bodies.size(); ++k)
      place[straight.packing.bodies.id[k]] = straight.packing.bodies.position[k];
    for (std::size_t k = 0; k < turned.packing.bodies.size(); ++k)
      EXPECT_LT(norm(turned.packing.bodies.position[k] - place.at(turned.packing.bodies.id[k])), 1e-11);
  }
}

}  // namespace
}  // namespace isostat::systems
