// The energy ledger of grains of triangles in a container: weight, dampers, friction, drag and walls that move.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem/triangles/energy.hpp"
#include "dem/triangles/engine.hpp"
#include "tests/support/moving_triangles.hpp"

namespace isostat {
namespace {

struct Bed {
  const char* name;
  ContainerShape shape = ContainerShape::box;
  ContainerWalls walls = ContainerWalls::smooth;
  Integrator integrator = Integrator::verlet;
  double damping = 9, friction = 0, amplitude = 0, rotation = 0, drag = 0;
};

// Largest error of the total in units of the largest kinetic energy.
double ledger_error(const Bed& bed, double step_fraction) {
  oracle::MovingTriangles m;
  m.count = 16, m.gravity = 981, m.step_fraction = step_fraction, m.integrator = bed.integrator;
  m.law.damping = bed.damping, m.law.friction = bed.friction;
  m.container.shape = bed.shape, m.container.walls = bed.walls;
  m.container.width = 1.2, m.container.height = 2, m.container.radius = 0.8;
  m.motion.vibration_amplitude = bed.amplitude, m.motion.vibration_frequency = 30, m.motion.rotation = bed.rotation;
  State<TriangleGrains> s = moving_triangles(m);
  SolverOptions options;
  options.energies = true;
  Solver<TriangleGrains> solver(s, {}, options);
  solver.set_drag(bed.drag);
  solver.snapshot(s);
  const double initial = energies(s).total();
  double worst = 0, kinetic = 0;
  for (int k = 0; k < 20; ++k) {
    solver.run(std::llround(2e-3 / s.time_step));
    solver.snapshot(s);
    const TriangleEnergies e = energies(s);
    worst = std::max(worst, std::abs(e.total() - initial)), kinetic = std::max(kinetic, e.kinetic);
  }
  const EnergyLedger& l = energies(s).ledger;
  EXPECT_EQ(l.viscous > 0, bed.damping > 0);
  EXPECT_EQ(l.sliding > 0, bed.friction > 0);
  EXPECT_EQ(l.drag > 0, bed.drag > 0);
  EXPECT_EQ(l.wall_work != 0, bed.amplitude > 0 || bed.rotation > 0);
  return worst / kinetic;
}

TEST(EnergyLedgerOfTriangles, ClosesToTheErrorOfTheSteps) {
  for (const Integrator integrator : {Integrator::verlet, Integrator::gear})
    for (Bed bed : {Bed{.name = "bed without dampers", .damping = 0}, Bed{.name = "bed"},
                    Bed{.name = "friction", .friction = 0.3}, Bed{.name = "shaken", .amplitude = 0.05},
                    Bed{.name = "shaken, walls of grains", .walls = ContainerWalls::grains, .amplitude = 0.05},
                    Bed{.name = "drum", .shape = ContainerShape::drum, .friction = 0.3, .rotation = 5},
                    Bed{.name = "drag", .drag = 20}}) {
      bed.integrator = integrator;
      SCOPED_TRACE(std::string(bed.name) + (integrator == Integrator::gear ? ", Gear" : ", Verlet"));
      const double standard = ledger_error(bed, 0.2), fine = ledger_error(bed, 0.1);
      RecordProperty("error_at_.2_.1", std::to_string(standard) + " " + std::to_string(fine));
      // Springs of friction are stretched by the velocity at the end of a step: of first order.
      EXPECT_LT(standard, bed.friction > 0 ? 5e-2 : 5e-3);
      EXPECT_LT(fine, bed.friction > 0 ? 0.7 * standard : 1e-3);
    }
}

}  // namespace
}  // namespace isostat
