#include "dem/triangles/lab/collide.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "dem/run_error.hpp"
#include "dem/solver/clocks.hpp"
#include "dem/triangles/energy.hpp"
#include "dem/triangles/engine.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/sample.hpp"
#include "geometry/base/index.hpp"

namespace isostat::lab {
namespace {

constexpr int kMostHalvings = 8;
constexpr double kSafety = 0.5;  // [largest stable step]
constexpr double kLongest = 50;  // [s/V] until which they must have parted

Scene scene_of(const CollisionSetup& setup, double step) {
  Scene scene = default_scene(SceneSystem::triangles, 1);
  scene.triangle_grains.arrangement = Arrangement::collision;
  scene.triangle_grains.size_min = scene.triangle_grains.size_max = setup.side;
  scene.triangle_grains.speed = setup.speed, scene.triangle_grains.offset = setup.offset;
  scene.triangle_law.contact = setup.law, scene.triangle_law.damping = setup.damping;
  scene.step.integrator = setup.integrator, scene.step.fraction = step;
  return scene;
}

// A grain as one body.
struct Whole {
  double mass = 0, inertia = 0, angular_momentum = 0;
  Vec2 centre{}, momentum{};
  double spin() const { return angular_momentum / inertia; }
  double translation() const { return 0.5 * dot(momentum, momentum) / mass; }
  double rotation() const { return 0.5 * angular_momentum * spin(); }
};

Whole whole(const TrianglePacking& p, std::size_t grain) {
  Whole w;
  const Bodies<2>& b = p.bodies;
  const std::size_t begin = idx(p.grains.begin[grain]), end = idx(p.grains.begin[grain + 1]);
  for (std::size_t k = begin; k < end; ++k) {
    w.mass += b.mass[k];
    w.centre += b.mass[k] * b.position[k], w.momentum += b.mass[k] * b.velocity[k];
  }
  w.centre = (1 / w.mass) * w.centre;
  for (std::size_t k = begin; k < end; ++k) {
    const Vec2 d = b.position[k] - w.centre, v = b.velocity[k] - (1 / w.mass) * w.momentum;
    w.inertia += b.inertia[k] + b.mass[k] * dot(d, d);
    w.angular_momentum += b.inertia[k] * b.spin[k] + b.mass[k] * (d[0] * v[1] - d[1] * v[0]);
  }
  return w;
}

double mean_spin(const TrianglePacking& p) { return 0.5 * (whole(p, 0).spin() + whole(p, 1).spin()); }

// The circles about them are apart and recede.
bool parted(const TrianglePacking& p) {
  const Whole a = whole(p, 0), b = whole(p, 1);
  const Vec2 r = b.centre - a.centre, v = (1 / b.mass) * b.momentum - (1 / a.mass) * a.momentum;
  return norm(r) > p.grains.radius[0] + p.grains.radius[1] && dot(r, v) > 0;
}

// One collision, looked at every `stride` steps, so that any step sees the same instants.
Collision collide(const CollisionSetup& setup, double step, int stride) {
  State<TriangleGrains> state = place_triangles(scene_of(setup, step), 1);
  const double start = whole(state.packing, 0).translation();
  Collision c;
  c.step = step;
  Solver<TriangleGrains> solver(state, {});
  const double longest = kLongest * setup.side / setup.speed, unit = setup.side / setup.speed;
  const double before = cpu_seconds(1);
  bool touched = false, first_over = false;
  for (;;) {
    solver.run(stride);
    const bool near = solver.engine().candidates().pairs() > 0;
    if (near && first_over) continue;  // nothing to learn before they leave each other's neighbourhood
    solver.snapshot(state);
    const bool touching = !state.packing.overlaps.empty();
    if (touched && !touching && !first_over) first_over = true, c.spin_first = mean_spin(state.packing) * unit;
    touched = touched || touching;
    if (touched && !touching && parted(state.packing)) break;
    if (solver.time() > longest)
      throw RunError(solver.steps(), -1, "the squares have not parted", "another --speed or --offset");
  }
  c.cpu_seconds = cpu_seconds(1) - before;
  c.steps = solver.steps();
  const Whole a = whole(state.packing, 0), b = whole(state.packing, 1);
  c.translation = (a.translation() + b.translation()) / start;
  c.rotation = (a.rotation() + b.rotation()) / start;
  c.spin_final = mean_spin(state.packing) * unit;
  const TriangleEnergies e = energies(state);
  c.stored = (e.kinetic + e.beams) / start - c.translation - c.rotation;
  return c;
}

double change(const Collision& a, const Collision& b) {
  return std::max({std::abs(a.translation - b.translation), std::abs(a.rotation - b.rotation),
                   std::abs(a.spin_first - b.spin_first), std::abs(a.spin_final - b.spin_final)});
}

}  // namespace

double largest_fraction(const CollisionSetup& setup) {
  const Scene scene = scene_of(setup, 1);
  const GrainTemplate grain = grain_template(grain_shape("square", setup.side), material_of(scene));
  return largest_step(grain, scene.triangle_law.modulus, setup.integrator) *
         step_frequency(grain, scene.triangle_law.modulus);
}

Collision collide_squares(const CollisionSetup& setup) {
  const double coarsest = std::min(kCoarsest, kSafety * largest_fraction(setup));
  if (setup.step)
    return collide(setup, *setup.step, std::max(1, static_cast<int>(std::lround(coarsest / *setup.step))));
  Collision last = collide(setup, coarsest, 1);
  bool still = false;
  for (int k = 1; k <= kMostHalvings; ++k) {
    Collision next = collide(setup, std::ldexp(coarsest, -k), 1 << k);
    next.change = change(next, last);
    next.cpu_seconds += last.cpu_seconds;
    if (next.change < kConverged && still) return next;
    still = next.change < kConverged;
    last = next;
  }
  throw RunError(last.steps, -1,
                 "the result still changes by " + std::to_string(last.change) + " when the step is halved",
                 "a --step, or another --speed: at the border of one and two contacts it is sensitive");
}

}  // namespace isostat::lab
