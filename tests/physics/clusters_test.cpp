// Canonical clusters: a pair, a triangle, the double triangle, a chain, a ring, lattices of known stress, and the
// objectivity of the contact history.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/disks/certificate.hpp"
#include "dem/disks/lab/cluster.hpp"
#include "dem/disks/lab/few_bodies.hpp"
#include "dem/disks/lab/pair.hpp"
#include "dem/state/balance.hpp"
#include "tests/support/disk_states.hpp"

namespace isostat {
namespace {

using lab::Disk;
constexpr double kPi = std::numbers::pi;

LawScene cohesive() {
  LawScene law;  // kappa 1e5, zeta .8, mu .5, F0 1, D0 1e-3
  law.rolling = false;
  return law;
}
double static_overlap(const LawScene& law) { return law.attraction / law.normal_stiffness; }  // h0

double largest_static_force(const State<Disks>& s) {
  return evaluate_certificate(s.packing, s.law, {}, EquilibriumScene{}).max_force;
}

// --- pair ---------------------------------------------------------------------------------------------------------

TEST(Pair, RestitutionAveragedOverThePhaseConvergesAtSecondOrder) {
  for (const double damping : {0.8, 0.3}) {
    LawScene law = cohesive();
    law.damping = damping;
    double last = 0, last_spread = 0;
    for (const double c : {0.12, 0.06, 0.03}) {
      const lab::Restitution r = lab::restitution(law, c, 0.1, 32);
      EXPECT_DOUBLE_EQ(r.exact, std::exp(-kPi * damping / std::sqrt(1 - damping * damping)));
      const double error = std::abs(r.mean - r.exact);
      EXPECT_LT(error, 0.6 * c * c) << "step " << c;
      EXPECT_LT(r.spread, 0.2 * c) << "one collision is of first order in the step";
      if (last > 0) {
        EXPECT_LT(error, last / 2.5);
        EXPECT_LT(r.spread, last_spread / 1.7);
      }
      last = error, last_spread = r.spread;
    }
  }
}

// Two unit masses in contact at h = 0 part for good from a receding speed of sqrt(2) V*: m_r v^2/2 = F0 D0/2.
TEST(Pair, PartsFromTheSpeedThatPaysForTheAttraction) {
  const LawScene law = cohesive();
  const lab::PullOff p = lab::pull_off(law, 0.06);
  EXPECT_NEAR(p.exact, std::sqrt(2 * law.attraction * law.attraction_range), 1e-15);
  EXPECT_NEAR(p.speed, p.exact, 2e-4 * p.exact);
  EXPECT_NEAR(p.largest_tension, law.attraction, 1e-3);
}

TEST(Pair, SticksAtTheStaticOverlap) {
  const LawScene law = cohesive();
  State<Disks> s = lab::few_bodies(law, {{0, 0, 0.5, 0.02, 0, 0}, {1 + 0.5e-3, 0, 0.5, 0, 0, 0}}, 0.06);
  Solver solver(s, {});
  solver.run(40000);
  solver.snapshot(s);
  ASSERT_EQ(s.packing.links.size(), 1u);
  EXPECT_NEAR(s.packing.links[0].gap, -static_overlap(law), 1e-3 * static_overlap(law));
  EXPECT_NEAR(s.packing.bodies.velocity[0][0], 0.01, 1e-9);
}

// Sliding throughout: the tangential impulse is mu times the normal one, m_r (1 + e) v_n, as the viscous force has no
// net impulse between touch and loss of contact. Slow, so that the disks do not turn about each other meanwhile.
TEST(Pair, ObliqueImpactThatSlidesThroughoutKeepsToCoulomb) {
  const double normal = 0.002, tangential = 0.01;
  const lab::ObliqueImpact o = lab::oblique_impact(cohesive(), 0.03, normal, tangential, 16);
  const double impulse = tangential - o.sliding_exact;
  EXPECT_NEAR(impulse, 0.5 * 0.5 * (1 + std::exp(-kPi * 0.8 / 0.6)) * normal, 1e-12);
  EXPECT_NEAR(tangential - o.tangential_velocity, impulse, 5e-3 * impulse);
}

TEST(Pair, LoadCyclesDissipateTheAreaOfTheirLoops) {
  LawScene law = cohesive();
  const double overlap = 3 * static_overlap(law), slip = law.friction * overlap;
  const lab::LoadCycle c = lab::tangential_cycle(law, overlap, 4 * slip, 4000);
  EXPECT_NEAR(c.dissipated, c.exact, 2e-3 * c.exact);
  for (const lab::LawPoint& p : c.points) EXPECT_NEAR(p.force, p.exact, 1e-9);
  law.rolling = true;
  const double roll = 0.01 * law.friction * overlap / 1e-4;
  const lab::LoadCycle m = lab::rolling_cycle(law, overlap, 4 * roll, 4000);
  EXPECT_NEAR(m.dissipated, m.exact, 2e-3 * m.exact);
}

// --- clusters -----------------------------------------------------------------------------------------------------

// Every contact at -h0: no force anywhere, for any tree or ring of disks.
TEST(Cluster, TriangleChainAndRingRestAtTheStaticOverlap) {
  const LawScene law = cohesive();
  const double d = 1 - static_overlap(law);
  std::vector<std::vector<Disk>> clusters = {{{0, 0}, {d, 0}, {d / 2, d * std::sqrt(0.75)}}, {}, {}};
  for (int k = 0; k < 6; ++k) clusters[1].push_back({k * d * std::cos(0.3), k * d * std::sin(0.3)});
  for (int k = 0; k < 6; ++k) clusters[2].push_back({d * std::cos(k * kPi / 3), d * std::sin(k * kPi / 3)});
  const std::size_t contacts[] = {3, 5, 6};
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    State<Disks> s = lab::few_bodies(law, clusters[c], 0.06);
    Solver solver(s, {});
    solver.run(5000);
    solver.snapshot(s);
    EXPECT_EQ(s.packing.links.size(), contacts[c]);
    EXPECT_LT(largest_static_force(s), 1e-8);
    for (const Link<2>& l : s.packing.links) EXPECT_NEAR(l.gap, -static_overlap(law), 1e-8 * d);
  }
}

// A ring of n disks in rigid rotation: 2 |N| sin(pi/n) = m Omega^2 rho, rho = d / (2 sin(pi/n)); no friction force, as
// every contact rolls with the ring.
TEST(Cluster, ASpinningRingBearsItsHoopTension) {
  const LawScene law = cohesive();
  const int n = 6;
  const double omega = 0.3, h = -static_overlap(law) + omega * omega / law.normal_stiffness;  // sin(pi/6) = 1/2, d = 1
  const double d = 1 + h, tension = omega * omega * d;
  std::vector<Disk> disks;
  for (int k = 0; k < n; ++k) {
    const double x = d * std::cos(k * kPi / 3), y = d * std::sin(k * kPi / 3);
    disks.push_back({x, y, 0.5, -omega * y, omega * x, omega});
  }
  State<Disks> s = lab::few_bodies(law, disks, 0.06);
  Solver solver(s, {});
  solver.run(std::llround(2 * kPi / omega / s.time_step));  // one turn
  solver.snapshot(s);
  ASSERT_EQ(s.packing.links.size(), 6u);
  for (const Link<2>& l : s.packing.links) {
    EXPECT_NEAR(l.normal_force, -tension, 1e-3 * tension);
    EXPECT_NEAR(l.tangential_force, 0, 1e-3 * tension);
  }
  for (double w : s.packing.bodies.spin) EXPECT_NEAR(w, omega, 1e-5);
}

TEST(DoubleTriangle, HasTheForcesOfItsSelfStress) {
  lab::ClusterSetup setup = lab::default_cluster_setup();
  setup.step_fraction = 0.03;
  const lab::ClusterResult r = lab::double_triangle(setup);
  ASSERT_TRUE(r.at_rest);
  EXPECT_NEAR(r.outer_normal, -0.1078, 5e-4);
  EXPECT_NEAR(r.common_normal, 0.431, 2e-3);
  EXPECT_NEAR(r.outer_tangential, 0.187, 1e-3);
  // -4 : 1 : sqrt(3) for tangent disks; overlaps of 1e-5 leave that to 1e-3
  EXPECT_NEAR(r.common_normal / r.outer_normal, -4, 4e-3);
  EXPECT_NEAR(std::abs(r.outer_tangential / r.outer_normal), std::sqrt(3), 2e-3);
  setup.law.normal_stiffness = 1e4;
  EXPECT_NEAR(lab::double_triangle(setup).outer_normal, -0.099, 1e-3);
  setup = lab::default_cluster_setup();
  setup.step_fraction = 0.03, setup.law.friction = 0.15;
  EXPECT_NEAR(lab::double_triangle(setup).outer_normal, -0.042, 2e-3);
}

// --- objectivity --------------------------------------------------------------------------------------------------

// The loaded cluster carried round: forces follow the frame. What remains is the centrifugal load, of order Omega^2.
TEST(Objectivity, ALoadedClusterKeepsItsForcesWhenItTurnsAndTravels) {
  lab::ClusterSetup setup = lab::default_cluster_setup();
  setup.step_fraction = 0.06;
  const lab::ClusterResult r = lab::double_triangle(setup);
  State<Disks> s = r.state;
  s.memory = {};
  Vec2 centre{};
  for (const Vec2& x : s.packing.bodies.position) centre += 0.25 * x;
  const double omega = 0.02;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 arm = s.packing.bodies.position[k] - centre;
    s.packing.bodies.velocity[k] = {{3 - omega * arm[1], -2 + omega * arm[0]}};
    s.packing.bodies.spin[k] = omega;
  }
  Solver solver(s, {});
  solver.run(std::llround(1.5 / omega / s.time_step));  // 1.5 radians, and several cells
  solver.snapshot(s);
  for (const Link<2>& before : r.state.packing.links) {
    const Bodies<2>& b = r.state.packing.bodies;
    const Link<2>* after =
        lab::find_link(s, b.id[static_cast<std::size_t>(before.i)], b.id[static_cast<std::size_t>(before.j)]);
    ASSERT_NE(after, nullptr);
    EXPECT_NEAR(after->normal_force, before.normal_force, 3 * omega * omega);
    EXPECT_NEAR(after->tangential_force, before.tangential_force, 3 * omega * omega);
  }
}

// A pair turned rigidly by hand, phi a step, through the kernel: the tangential spring sees sin(phi) - phi of spurious
// slip a step, which over a turn is of second order in phi.
TEST(Objectivity, TheSpuriousSlipOfARigidTurnIsOfSecondOrder) {
  DiskLaw law = resolve(cohesive());
  law.damping = 0, law.attraction = law.attraction_range = 0, law.friction = 100;
  const double overlap = 1e-3, d = 1 - overlap, arm_i = 0.7 * d, arm_j = 0.3 * d;  // radii .7 and .3
  auto change = [&](int steps) {
    State<Disks> s = lab::few_bodies(LawScene{}, {{0, 0, 0.7}, {d, 0, 0.3}}, 0.06);
    const double phi = 2 * kPi / steps, load = 5;
    AlignedVector<double> rows(4 * kernel::kRowWidth, 0.0), loads(4 * kernel::kLoadWidth, 0.0);
    rows[3 * kernel::kRowWidth] = 1e6;
    AlignedVector<kernel::RowOffset> i(kPairBatch, 2 * kernel::kRowWidth), j(kPairBatch, 3 * kernel::kRowWidth);
    AlignedVector<std::uint8_t> shift(kPairBatch, 4);
    AlignedVector<double> damping(kPairBatch, 0.0), sum(kPairBatch, 1.0), tangential(kPairBatch, 0.0),
        moment(kPairBatch, 0.0);
    i[0] = 0, j[0] = kernel::kRowWidth, tangential[0] = load;
    PairForceInput in;
    in.rows = rows.data(), in.loads = loads.data(), in.law = law, in.time_step = 1, in.begin = 0, in.end = kPairBatch;
    in.pairs = {i.data(), j.data(), shift.data(), damping.data(), sum.data(), tangential.data(), moment.data()};
    const PairForceKernel kernel = select_kernel(law, Tally::nothing, best_isa());
    for (int k = 1; k <= steps; ++k) {
      const double now = k * phi, then = now - phi;
      const double radius[] = {0.7, 0.3}, arm[] = {-arm_i, arm_j};
      for (int b = 0; b < 2; ++b) {
        double* row = &rows[static_cast<std::size_t>(b) * kernel::kRowWidth];
        row[0] = arm[b] * std::cos(now), row[1] = arm[b] * std::sin(now);
        row[2] = row[0] - arm[b] * std::cos(then), row[3] = row[1] - arm[b] * std::sin(then);
        row[4] = radius[b] * phi, row[5] = phi;
      }
      kernel(in);
    }
    return tangential[0] - load;
  };
  const double coarse = change(100), middle = change(200), fine = change(400);
  // K_T d (phi - sin phi) a step: K_T d phi^2 pi / 3 over the turn
  EXPECT_NEAR(fine / (law.tangential_stiffness * d * std::pow(2 * kPi / 400, 2) * kPi / 3), 1, 1e-3);
  EXPECT_NEAR(coarse / middle, 4, 0.01);
  EXPECT_NEAR(middle / fine, 4, 0.01);
}

// --- lattices -----------------------------------------------------------------------------------------------------

// Equal disks at distance d on a triangular lattice: sigma_11 = sigma_22 = sqrt(3) N / d (three contacts a disk, area
// sqrt(3)/2 d^2); on a square lattice sigma = N / d.
TEST(Lattice, HasItsKnownStress) {
  for (bool cohesion : {false, true})
    for (bool triangular : {true, false}) {
      LawScene law = cohesive();
      if (!cohesion) law.attraction = 0;
      const double overlap = 4e-5, d = 1 - overlap;
      const double normal = law.normal_stiffness * overlap - (cohesion ? law.attraction : 0);
      State<Disks> s;
      s.scene.law = law, s.law = resolve(law);
      const int n = 6;
      const double row_height = triangular ? d * std::sqrt(0.75) : d;
      Bodies<2>& b = s.packing.bodies;
      b.resize(static_cast<std::size_t>(n) * n);
      for (int k = 0; k < n * n; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const int row = k / n;
        b.id[at] = k, b.radius[at] = 0.5;
        b.position[at] = {{d * (k % n + (triangular ? 0.5 * (row % 2) : 0)) + 3.3, row * row_height - 2.2}};
      }
      set_disk_inertia(b);
      s.packing.cell = PeriodicCell<2>{{{n * d, n * row_height}}};
      s.cell_motion.reference_length = s.packing.cell->length;
      s.time_step = 1e-4;
      CellControl<2> control;
      const double stress = (triangular ? std::sqrt(3) : 1) * normal / d;
      control.stress = isotropic<2>(stress);
      Solver solver(s, control);
      solver.run(200);
      solver.snapshot(s);
      EXPECT_EQ(s.packing.links.size(), static_cast<std::size_t>(n * n * (triangular ? 3 : 2)));
      for (int a = 0; a < 2; ++a) EXPECT_NEAR(s.cell_motion.stress[a], stress, 1e-7 * std::abs(stress));
      const StressTensor measured = measured_stress(s.packing);
      EXPECT_NEAR(measured.xx, stress, 1e-7 * std::abs(stress));
      EXPECT_NEAR(measured.yy, stress, 1e-7 * std::abs(stress));
      EXPECT_NEAR(measured.xy, 0, 1e-7 * std::abs(stress));
      EXPECT_LT(largest_static_force(s), 1e-6 * std::abs(normal)) << "equilibrium stays";
    }
}

}  // namespace
}  // namespace isostat
