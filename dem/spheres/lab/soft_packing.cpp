#include "dem/spheres/lab/soft_packing.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>

#include "dem/run_error.hpp"
#include "dem/sample/insertion.hpp"
#include "dem/spheres/at_rest.hpp"
#include "dem/spheres/lab/fire.hpp"
#include "dem/spheres/lab/soft_particle.hpp"
#include "dem/spheres/sample.hpp"

namespace isostat {
namespace {

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double ball(double radius) { return 4.0 / 3 * std::numbers::pi * radius * radius * radius; }

// Seeds of the packings inside: of the k-th soft-particle.
std::uint64_t seed_within(std::uint64_t seed, std::size_t k) { return seed + (k + 1) * kSecondStream; }

class Compression {
 public:
  Compression(const SoftPackingTest& test, SoftResolution resolution, std::uint64_t seed)
      : test_(test), resolution_(resolution), state_(made(seed)) {}

  SoftPackingRun run() {
    const double begin = thread_seconds();
    for (const double next : test_.strain) {
      while (strain() < next - 1e-12) go_on_to(std::min(next, strain() + test_.increment));
      result_.points.push_back(measured(next));
    }
    result_.cpu_seconds = thread_seconds() - begin;
    return result_;
  }

 private:
  State<Spheres> made(std::uint64_t seed) {
    State<Spheres> s;
    s.law = test_.law;
    s.scene.system = SceneSystem::spheres;
    SpherePacking& p = s.packing;
    p.cell = PeriodicCell<3>{{{test_.packing.box[0], test_.packing.box[1], test_.packing.box[2]}}};
    s.cell_motion.reference_length = p.cell->length;
    const InsertedGrains<3> outer = insert_grains<3>(test_.packing, seed);
    double volume = 0;
    const auto add = [&](const Vec3& at, double radius, SphereKind kind, std::int32_t group, double of_mass) {
      Bodies<3>& b = p.bodies;
      const std::size_t k = b.size();
      b.resize(k + 1);
      b.id[k] = static_cast<std::int64_t>(k), b.position[k] = at, b.radius[k] = radius;
      b.mass[k] = of_mass, b.inertia[k] = 0.4 * of_mass * radius * radius;
      p.kind.push_back(kind), p.group.push_back(group);
    };
    for (std::size_t k = 0; k < outer.radius.size(); ++k) {
      if (outer.soft[k] == 1) continue;
      add(outer.position[k], outer.radius[k], SphereKind::grain, 0, test_.density * ball(outer.radius[k]));
      volume += ball(outer.radius[k]);
      ++result_.solids;
    }
    for (std::size_t k = 0; k < outer.radius.size(); ++k) {
      if (outer.soft[k] == 0) continue;
      const InsertedGrains<3> inner = insert_grains<3>(test_.inside, seed_within(seed, k));
      const auto group = static_cast<std::int32_t>(++result_.softs);
      double within = 0;
      for (const double r : inner.radius) within += ball(r);
      volume += within;
      if (resolution_ == SoftResolution::model)
        add(outer.position[k], outer.radius[k], SphereKind::soft, 0, test_.density * within);
      if (resolution_ == SoftResolution::shells)
        add(outer.position[k], -outer.radius[k], SphereKind::shell, group, test_.density * within);
      for (std::size_t g = 0; resolution_ != SoftResolution::model && g < inner.radius.size(); ++g)
        add(outer.position[k] + inner.position[g], inner.radius[g], SphereKind::grain, group,
            test_.density * ball(inner.radius[g]));
    }
    if (resolution_ == SoftResolution::free) p.kind.clear();
    result_.bodies = p.bodies.size();
    result_.solid_fraction = volume / p.cell->measure();
    double smallest = INFINITY;
    for (const double r : p.bodies.radius) smallest = std::min(smallest, std::abs(r));
    s.time_step = test_.step * time_step_unit(test_.law, test_.density, smallest);
    return s;
  }

  double strain() const { return 1 - state_.packing.cell->length[0] / state_.cell_motion.reference_length[0]; }

  // With smaller steps where it blows up.
  void go_on_to(double strain) {
    const State<Spheres> before = state_;
    for (int attempt = 0;; ++attempt) try {
        shrink_to(strain);
        residual_ = relax();
        return;
      } catch (const RunError&) {
        if (attempt == kFinerSteps) throw;
        const double finer = kFinerStep * state_.time_step;
        state_ = before;
        state_.time_step = finer;
        state_.memory = {};  // half steps of another length
      }
  }

  void shrink_to(double strain) {
    const double length = state_.cell_motion.reference_length[0], by = strain - this->strain();
    const auto steps = static_cast<std::int64_t>(std::ceil(by * length / (test_.speed * state_.time_step)));
    CellControl<3> control;
    const double rate = by / (static_cast<double>(steps) * state_.time_step);
    control.strain_rate = {{rate, rate, rate}};
    Solver<Spheres> solver(state_, control);
    solver.run(steps);
    solver.snapshot(state_);
    state_.cell_motion.strain_rate = {};
    result_.steps += steps;
  }

  double relax() {
    Solver<Spheres> solver(state_, {});
    solver.engine().stop();
    result_.steps += relax_by_fire(solver, test_.law, test_.residual, test_.most_iterations);
    solver.snapshot(state_);
    return fire_residual(solver);
  }

  SoftPackingPoint measured(double strain) const {
    SoftPackingPoint point{strain, 0, residual_, std::vector<double>(result_.solids, 0.0)};
    const SpherePacking& p = state_.packing;
    double trace = 0;
    for (const Link<3>& link : p.links) {
      const auto i = static_cast<std::size_t>(link.i), j = static_cast<std::size_t>(link.j);
      const SphereBody a = body_of(p, link.i), b = body_of(p, link.j);
      const double distance = link.gap + a.radius + b.radius, ratio = distance / (a.radius + b.radius);
      trace += link.normal_force * distance;
      const auto bear = [&](std::size_t k, double lever) {
        const auto id = static_cast<std::size_t>(p.bodies.id[k]);
        if (id < result_.solids) point.solid_load[id] += link.normal_force * lever / (3 * ball(p.bodies.radius[k]));
      };
      bear(i, ratio * a.radius), bear(j, ratio * b.radius);
    }
    point.pressure = trace / (3 * p.cell->measure());
    return point;
  }

  const SoftPackingTest& test_;
  SoftResolution resolution_;
  SoftPackingRun result_;
  State<Spheres> state_;
  double residual_ = 0;
};

}  // namespace

SoftPackingRun compress_soft_packing(const SoftPackingTest& test, SoftResolution resolution, std::uint64_t seed) {
  return Compression(test, resolution, seed).run();
}

}  // namespace isostat
