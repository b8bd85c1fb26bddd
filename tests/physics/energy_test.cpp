// Invariants: momentum to rounding, angular momentum of an isolated cluster, the energy ledger.
#include "dem/disks/energy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dem/disks/engine.hpp"
#include "dem/disks/lab/few_bodies.hpp"
#include "tests/support/disk_states.hpp"

namespace isostat {
namespace {

using oracle::random_state;
using oracle::RandomDisks;

CellControl<2> barostat(const State<Disks>& s, double pressure, double cap) {
  CellControl<2> c;
  c.stress = isotropic<2>(pressure), c.max_strain_rate = cap, c.inertia = 0.3 * oracle::total_mass(s);
  return c;
}

TEST(Momentum, IsConservedToRounding) {
  for (bool free_cell : {false, true}) {
    RandomDisks r;
    r.law = oracle::soft_law(), r.speed = 2;
    State<Disks> s = random_state(r);
    auto momentum = [&] {
      Vec2 p{};
      for (std::size_t k = 0; k < s.packing.bodies.size(); ++k)
        p += s.packing.bodies.mass[k] * s.packing.bodies.velocity[k];
      return p;
    };
    Solver solver(s, free_cell ? barostat(s, 50, 2) : CellControl<2>{});
    solver.snapshot(s);
    const Vec2 before = momentum();
    solver.run(2000);
    solver.snapshot(s);
    EXPECT_LT(norm(momentum() - before), 1e-12 * r.speed * oracle::total_mass(s));
  }
}

// With the proportional lever arms the tangential forces of a pair carry no net moment: l_i + l_j = |r_ij|.
TEST(AngularMomentum, OfAnIsolatedClusterIsConservedToRounding) {
  LawScene law = oracle::soft_law();
  State<Disks> s = lab::few_bodies(law,
                                   {{0, 0, 0.5, 0.3, 0, 4},
                                    {0.95, 0.1, 0.4, -0.5, 0.8, -3},
                                    {0.4, 0.9, 0.45, 0, -1.5, 1},
                                    {1.2, 1.0, 0.3, -2, -1, 7}},
                                   0.06);
  auto angular = [&] {
    double l = 0;
    const Bodies<2>& b = s.packing.bodies;
    for (std::size_t k = 0; k < b.size(); ++k)
      l += b.mass[k] * (b.position[k][0] * b.velocity[k][1] - b.position[k][1] * b.velocity[k][0]) +
           b.inertia[k] * b.spin[k];
    return l;
  };
  Solver solver(s, {});
  solver.snapshot(s);
  const double before = angular();
  std::size_t touched = 0;
  for (int k = 0; k < 100; ++k) {
    solver.run(10);
    solver.snapshot(s);
    touched = std::max(touched, s.packing.links.size());
    ASSERT_NEAR(angular(), before, 1e-11 * (std::abs(before) + 100));
  }
  EXPECT_GE(touched, 3u);
}

// Largest error of Energies::total() over the run, in units of the initial energy; the rms over a few samples.
struct Gas {
  const char* name;
  double damping = 0.8, pressure = 0;
  bool rate_coupling = false;
  double drag = 0;
  double shear_rate = 0;
};
double ledger_error(const Gas& gas, double step_fraction) {
  constexpr int kSamples = 3, kLooks = 20;
  double sum = 0;
  for (int sample = 1; sample <= kSamples; ++sample) {
    RandomDisks r;
    r.count = 60, r.solid_fraction = 0.45, r.squeeze = 1;
    r.speed = 0.3, r.spin = 0.5, r.seed = static_cast<std::uint64_t>(sample);
    r.law = LawScene{};  // kappa 1e5, cohesion, friction, rolling resistance
    r.law.damping = gas.damping;
    r.step_fraction = step_fraction;
    State<Disks> s = random_state(r);
    CellControl<2> control;
    if (gas.pressure > 0) control = barostat(s, gas.pressure, 0.05);
    control.rate_coupling = gas.rate_coupling, control.shear_rate = gas.shear_rate;
    SolverOptions options;
    options.energies = true;
    Solver solver(s, control, options);
    solver.set_drag(gas.drag);
    solver.snapshot(s);
    const double initial = energies(s).total();
    const auto steps = std::llround(3.0 / s.time_step / kLooks);
    double worst = 0;
    for (int k = 0; k < kLooks; ++k) {
      solver.run(steps);
      solver.snapshot(s);
      worst = std::max(worst, std::abs(energies(s).total() / initial - 1));
    }
    const Energies e = energies(s);
    EXPECT_GT(e.ledger.viscous + e.ledger.sliding, 0.5 * initial) << "most of the energy went through the ledger";
    EXPECT_GT(e.ledger.rolling, 0.01 * initial);
    EXPECT_TRUE((gas.pressure == 0 && gas.shear_rate == 0) || e.ledger.cell_work > 0.1 * initial);
    EXPECT_TRUE(gas.drag == 0 || e.ledger.drag > 0.1 * initial);
    sum += worst * worst;
  }
  return std::sqrt(sum / kSamples);
}

TEST(EnergyLedger, ClosesBelowOneInTenThousandAndFasterThanTheSquareOfTheStep) {
  for (const Gas& gas : {Gas{"agitated gas in a fixed cell"}, Gas{"compression", 0.8, 0.5},
                         Gas{"compression with rate coupling and drag", 0.8, 0.5, true, 0.3},
                         Gas{"shear at constant volume", 0.8, 0, false, 0, 0.3},
                         Gas{"shear under pressure with rate coupling and drag", 0.8, 0.5, true, 0.3, -0.3}}) {
    SCOPED_TRACE(gas.name);
    const double coarse = ledger_error(gas, 0.12), standard = ledger_error(gas, 0.06), fine = ledger_error(gas, 0.03);
    RecordProperty("error_at_.12_.06_.03",
                   std::to_string(coarse) + " " + std::to_string(standard) + " " + std::to_string(fine));
    EXPECT_LT(standard, 1e-4);
    EXPECT_LT(fine, standard / 3.5) << coarse << " " << standard << " " << fine;
    EXPECT_LT(standard, coarse / 3.5) << coarse << " " << standard << " " << fine;
  }
}

}  // namespace
}  // namespace isostat
