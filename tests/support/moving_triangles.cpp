#include "tests/support/moving_triangles.hpp"

#include "dem/solver/random.hpp"
#include "dem/triangles/sample.hpp"
#include "geometry/base/index.hpp"

namespace isostat::oracle {
namespace {

template <class Visit>
void over_free(const State<TriangleGrains>& s, Visit&& visit) {
  const Grains& g = s.packing.grains;
  for (std::size_t n = 0; n < g.size(); ++n)
    for (auto k = idx(g.begin[n]); g.part[n] == GrainPart::free && k < idx(g.begin[n + 1]); ++k) visit(k);
}

}  // namespace

State<TriangleGrains> moving_triangles(const MovingTriangles& m) {
  Scene scene = default_scene(SceneSystem::triangles, 1);
  scene.triangle_grains.count = m.count;
  scene.triangle_grains.shape = m.shapes;
  scene.triangle_grains.solid_fraction = m.solid_fraction;
  scene.triangle_law = m.law;
  const double step = m.integrator == Integrator::gear ? 0.1 : 0.3;
  scene.step.integrator = m.integrator, scene.step.fraction = m.step_fraction > 0 ? m.step_fraction : step;
  scene.gravity = m.gravity;
  scene.container = m.container;
  scene.stages[0].container = m.motion;
  State<TriangleGrains> s = place_triangles(scene, m.seed);
  s.progress.started = true;  // the stage that moves the container
  Random random(m.seed + 1000);
  const auto draw = [&](double scale) {
    const double x = scale * random.normal();
    return Vec2{{x, scale * random.normal()}};
  };
  Bodies<2>& b = s.packing.bodies;
  const Grains& g = s.packing.grains;
  for (std::size_t n = 0; n < g.size(); ++n) {
    if (g.part[n] != GrainPart::free) continue;
    Vec2 centre{};
    const auto begin = idx(g.begin[n]), end = idx(g.begin[n + 1]);
    for (std::size_t k = begin; k < end; ++k) centre += (1 / static_cast<double>(end - begin)) * b.position[k];
    const Vec2 velocity = draw(m.speed);
    const double spin = m.spin * random.normal();
    for (std::size_t k = begin; k < end; ++k) {
      const Vec2 r = b.position[k] - centre;
      b.velocity[k] = velocity + Vec2{{-spin * r[1], spin * r[0]}} + draw(0.1 * m.speed);
      b.spin[k] = spin + 0.1 * m.spin * random.normal();
    }
  }
  return s;
}

double total_mass(const State<TriangleGrains>& s) {
  double sum = 0;
  over_free(s, [&](std::size_t k) { sum += s.packing.bodies.mass[k]; });
  return sum;
}

Vec2 momentum(const State<TriangleGrains>& s) {
  Vec2 sum{};
  over_free(s, [&](std::size_t k) { sum += s.packing.bodies.mass[k] * s.packing.bodies.velocity[k]; });
  return sum;
}

double angular_momentum(const State<TriangleGrains>& s) {
  const Bodies<2>& b = s.packing.bodies;
  double sum = 0;
  over_free(s, [&](std::size_t k) {
    const Vec2 &r = b.position[k], &v = b.velocity[k];
    sum += b.mass[k] * (r[0] * v[1] - r[1] * v[0]) + b.inertia[k] * b.spin[k];
  });
  return sum;
}

}  // namespace isostat::oracle
