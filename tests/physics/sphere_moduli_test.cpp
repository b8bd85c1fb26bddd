// Elastic moduli of spheres against the cell that the solver moves: a real packing, strained a little both ways by a
// rate along each edge and by shear, and relaxed.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/stiffness/sphere_stiffness.hpp"
#include "dem/run/stages.hpp"
#include "dem/spheres/engine.hpp"
#include "dem/spheres/sample.hpp"
#include "dem/state/balance_3d.hpp"

namespace isostat {
namespace {

// Relaxes in a fixed cell under a drag, from the positions and springs of the state.
State<Spheres> relaxed(State<Spheres> s, int steps) {
  s.memory = {};
  for (Vec3& v : s.packing.bodies.velocity) v = {};
  for (Vec3& w : s.packing.bodies.spin) w = {};
  s.cell_motion = {};
  s.cell_motion.reference_length = s.packing.cell->length;
  Solver solver(s, CellControl<3>{}, {});
  solver.set_drag(2.0);
  solver.run(steps);
  solver.snapshot(s);
  return s;
}

// Sheared on the way, so that the cell leans, then at rest under its stresses. Stiff: the geometric term, of the order
// of the pressure over the stiffness, is then none. Friction enough that nothing slips.
State<Spheres> real_packing() {
  Scene scene = default_scene(SceneSystem::spheres);
  SphereLawScene& law = scene.sphere_law;
  scene.sphere_grains.count = 60;
  scene.sphere_grains.solid_fraction = 0.55, scene.sphere_grains.diameter_min = 0.8;
  law.normal = NormalForce::linear, law.normal_stiffness = 1e5, law.tangential_stiffness = 7e4;
  law.friction = 5, law.damping = 0.5, law.attraction = 0;
  scene.finish.method = Finish::drag, scene.finish.drag = 2;
  StageScene pressed, sheared;
  pressed.pressure = 1.0;
  sheared.pressure = 1.0, sheared.shear_rate = 0.3, sheared.until = Until::strain, sheared.strain = 0.2;
  StageScene at_rest = pressed;
  at_rest.stress_12 = -0.2;
  scene.stages = {pressed, sheared, at_rest};
  State<Spheres> s = initial_spheres(scene, 3);
  if (!run_stages(s, {}, {}).all_met()) throw std::runtime_error("no equilibrium: " + s.progress.unmet);
  return relaxed(s, 200000);
}

TEST(ModuliOfSpheres, AreThoseOfTheCellThatTheSolverMoves) {
  const State<Spheres> s = real_packing();
  EXPECT_GT(std::abs(s.packing.cell->tilt), 0.1);
  double residual = 0;
  for (const Vec3& f : s.memory.force) residual = std::max(residual, norm(f));
  ASSERT_LT(residual, 1e-9);
  for (const Link<3>& l : s.packing.links) ASSERT_EQ(l.kind, LinkKind::closed);
  const SphereModuli moduli = elastic_moduli(s.packing, NetworkLaw::friction, by_link(s.packing, s.law));
  constexpr double kStrain = 1e-7;
  constexpr int kSteps = 20;
  const auto voigt = [](const StressTensor3& t) {
    const auto mean = [&](std::size_t a, std::size_t b) {
      return 0.5 * (t[a][static_cast<int>(b)] + t[b][static_cast<int>(a)]);
    };
    return std::array<double, 6>{t[0][0], t[1][1], t[2][2], mean(1, 2), mean(0, 2), mean(0, 1)};
  };
  const auto moved = [&](std::size_t component, double strain) {
    State<Spheres> to = s;
    to.memory = {};
    to.cell_motion = {};
    to.cell_motion.reference_length = to.packing.cell->length;
    CellControl<3> control;
    const double rate = strain / (kSteps * to.time_step);
    if (component < 3)
      control.strain_rate[static_cast<int>(component)] = rate;
    else
      control.shear_rate = -rate;  // compressive sense
    Solver solver(to, control);
    solver.set_drag(2.0);
    solver.run(kSteps);
    solver.snapshot(to);
    const State<Spheres> still = relaxed(to, 200000);
    EXPECT_EQ(still.packing.links.size(), s.packing.links.size());
    return voigt(measured_stress(still.packing));
  };
  const StressTensor3 before = measured_stress(s.packing);
  for (const std::size_t b : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{5}}) {
    const auto up = moved(b, kStrain), down = moved(b, -kStrain);
    // By -d(tilt)/L2 = e the axes turn by e/2 about z, anticlockwise, and take the stress along: W S - S W.
    std::array<double, 6> turn{};
    if (b == 5) {
      StressTensor3 change{};
      for (int c = 0; c < 3; ++c) change[0][c] -= 0.5 * before[1][c], change[1][c] += 0.5 * before[0][c];
      for (std::size_t a = 0; a < 3; ++a) {
        const double along_1 = before[a][0], along_2 = before[a][1];
        change[a][0] -= 0.5 * along_2, change[a][1] += 0.5 * along_1;
      }
      turn = voigt(change);
    }
    for (std::size_t a = 0; a < 6; ++a)
      EXPECT_NEAR(moduli[a][b], (up[a] - down[a]) / (2 * kStrain) - turn[a], 1e-3 * std::abs(moduli[0][0])) << a << b;
  }
  EXPECT_GT(moduli[5][5], 0.05 * moduli[0][0]);
}

}  // namespace
}  // namespace isostat
