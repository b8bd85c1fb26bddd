// Packings without a cell: where physics needs none, a run is the one in a cell too large to matter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "analysis/finishing/newton_finishing.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "dem/disks/certificate.hpp"
#include "dem/disks/sample.hpp"
#include "dem/disks/scales.hpp"
#include "dem/run/stages.hpp"

namespace isostat {
namespace {

// A cohesive cluster of seven disks, not quite in place, and one disk that flies by itself.
State<Disks> cluster(bool in_a_cell, Finish method) {
  Scene scene;
  scene.law.normal_stiffness = 1e4;
  scene.step.fraction = 0.1;
  scene.finish.method = method;
  scene.finish.quiet_time = 1;
  scene.stages.resize(1);
  scene.stages[0].max_time = 2000;
  State<Disks> s;
  s.scene = scene;
  s.law = resolve(scene.law);
  Bodies<2>& b = s.packing.bodies;
  b.resize(8);
  for (std::size_t k = 0; k < 8; ++k) {
    const double angle = M_PI / 3 * static_cast<double>(k), apart = k == 6 ? 0 : 0.9995 + 1e-4 * std::sin(5.0 * angle);
    b.id[k] = static_cast<std::int64_t>(k);
    b.position[k] = {{50 + apart * std::cos(angle), 50 + apart * std::sin(angle)}};
    b.radius[k] = 0.5;
  }
  b.position[7] = {{57, 51}};
  set_disk_inertia(b);
  s.time_step = time_step(scene, s.law.normal_stiffness, s.packing);
  if (in_a_cell) {
    s.packing.cell = PeriodicCell<2>{{{100, 100}}};
    s.cell_motion.reference_length = s.packing.cell->length;
  }
  return s;
}

State<Disks> at_rest(bool in_a_cell, Finish method) {
  State<Disks> s = cluster(in_a_cell, method);
  NewtonFinishing finisher;
  const RunOutcome outcome = run_stages(s, {}, {}, &finisher);
  EXPECT_TRUE(outcome.all_met()) << outcome.stages[0].reason;
  return s;
}

std::vector<double> sorted_forces(const State<Disks>& s) {
  std::vector<double> n;
  for (const Link<2>& l : s.packing.links) n.push_back(l.normal_force);
  std::sort(n.begin(), n.end());
  return n;
}

class Isolated : public ::testing::TestWithParam<Finish> {};
class IsolatedBody : public ::testing::Test {};
INSTANTIATE_TEST_SUITE_P(ByEveryMethod, Isolated, ::testing::Values(Finish::none, Finish::drag, Finish::newton),
                         [](const auto& of) { return std::string(kFinishNames[static_cast<std::size_t>(of.param)]); });

TEST_P(Isolated, ACohesiveClusterComesToRestAsInALargeCell) {
  const State<Disks> alone = at_rest(false, GetParam()), inside = at_rest(true, GetParam());
  EXPECT_TRUE(alone.certificate.equilibrated);
  EXPECT_FALSE(alone.certificate.pressure_controlled);
  EXPECT_FALSE(alone.packing.cell.has_value());
  const std::vector<double> n = sorted_forces(alone), same = sorted_forces(inside);
  ASSERT_EQ(n.size(), 12u);
  ASSERT_EQ(same.size(), 12u);
  // Both end where the tolerance of the criteria lets them; static solves go to rounding.
  const double tolerance = GetParam() == Finish::newton ? 1e-8 : 1e-3;
  for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(n[k], same[k], tolerance);
  if (GetParam() == Finish::newton) {
    EXPECT_LT(alone.certificate.max_force, 1e-8);
  }
  const ExactRank rank = exact_rank(alone.packing, NetworkLaw::rolling, false);
  EXPECT_EQ(rank.trivial, 3);
  EXPECT_EQ(rank.mechanisms, 0);
}

// A box of the bodies is all that the lists have to go by; a body that flies far must not cost memory or order.
TEST_F(IsolatedBody, ABodyMayFlyFarAway) {
  State<Disks> s = cluster(false, Finish::none);
  s.packing.bodies.position[7] = {{5e8, -3e7}};
  s.packing.bodies.velocity[7] = {{3, 0}};
  s.scene.stages[0].until = Until::time, s.scene.stages[0].time = 5;
  ASSERT_TRUE(run_stages(s, {}, {}).all_met());
  const auto& b = s.packing.bodies;
  const auto far = static_cast<std::size_t>(std::find(b.id.begin(), b.id.end(), 7) - b.id.begin());
  const double rounding = 0.5 * std::numeric_limits<double>::epsilon() * 5e8;  // of each step's sum
  EXPECT_NEAR(b.position[far][0], 5e8 + 3 * s.time, rounding * static_cast<double>(s.step));
  EXPECT_EQ(s.packing.links.size(), 12u);
}

}  // namespace
}  // namespace isostat
