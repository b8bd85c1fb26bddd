#include "dem/spheres/lab/fire.hpp"

#include <cmath>

namespace isostat {
namespace {

// Of the paper: mixing at the start and its decay, and after how many steps downhill it decays.
constexpr double kMixing = 0.1, kDecay = 0.99;
constexpr int kDownhill = 5;
constexpr int kLookEvery = 20;  // steps between two residuals

double residual_of(const SphereEngine& engine) {
  const double contacts = engine.squared_contact_forces();
  return contacts > 0 ? std::sqrt(engine.relaxation().force_squared / (2 * contacts)) : 0.0;
}

}  // namespace

double fire_residual(const Solver<Spheres>& solver) { return residual_of(solver.engine()); }

int relax_by_fire(Solver<Spheres>& solver, const SphereLaw& law, double residual, int most_steps) {
  SphereLaw undamped = law;
  undamped.damping = undamped.tangential_damping = 0;
  solver.set_law(undamped);
  SphereEngine& engine = solver.engine();
  double mixing = kMixing;
  int steps = 0;
  for (int downhill = 0; steps < most_steps; ++steps) {
    solver.step();
    const SphereEngine::Relaxation r = engine.relaxation();
    if (r.power > 0) {
      engine.steer(1 - mixing, r.pull_squared > 0 ? mixing * std::sqrt(r.speed_squared / r.pull_squared) : 0.0);
      if (++downhill > kDownhill) mixing *= kDecay;
    } else {
      engine.steer(0, 0);
      downhill = 0, mixing = kMixing;
    }
    if (steps % kLookEvery == kLookEvery - 1 && residual_of(engine) < residual) break;
  }
  engine.stop();
  solver.set_law(law);
  return steps;
}

}  // namespace isostat
