#include "dem/spheres/lab/soft_particle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "dem/run_error.hpp"
#include "dem/sample/insertion.hpp"
#include "dem/sample/insertion_report.hpp"
#include "dem/spheres/at_rest.hpp"
#include "dem/spheres/engine.hpp"
#include "dem/spheres/lab/fire.hpp"
#include "dem/spheres/sample.hpp"

namespace isostat {
namespace {

constexpr Vec3 kAxis{{0, 1, 0}}, kSlip{{-1, 0, 0}};  // of a rotation: slip = axis x approach
constexpr double kHeavy = 1e24;  // times the mass of a solid sphere that stands in for a soft one: no force moves it

class Experiment {
 public:
  Experiment(const SoftParticleTest& test, std::uint64_t seed)
      : test_(test),
        radius_(test.insertion.shell_radius),
        state_(made(seed)),
        solver_(std::in_place, state_, CellControl<3>{}) {}

  SoftMeasurement run() {
    double delta = 0;
    for (const double next : test_.delta) {
      approach((next - delta) * radius_);
      relax();
      delta = next;
      result_.normal.push_back({delta, normal_force(), fire_residual(*solver_), largest_overlap()});
      if (test_.alpha.empty()) continue;
      const State<Spheres> pressed = snapshot();
      rotated(delta, 0);
      for (const double alpha : test_.alpha) {
        turn(alpha * std::numbers::pi / 180);
        relax();
        rotated(delta, alpha);
        solver_.emplace(pressed, CellControl<3>{});
      }
    }
    return result_;
  }

 private:
  State<Spheres> made(std::uint64_t seed) {
    State<Spheres> s;
    s.law = test_.law;
    s.scene.system = SceneSystem::spheres;
    SpherePacking& p = s.packing;
    result_.seed = seed;
    if (test_.partner == SoftPartner::none) {
      p.bodies.resize(1);
      p.bodies.radius[0] = radius_;
      p.group = {kFirstSoft};
    } else {
      const InsertedGrains<3> grains = insert_grains<3>(test_.insertion, seed);
      const InsertionReport report = insertion_report(grains, test_.insertion);
      result_.grains = report.grains;
      result_.solid_fraction = report.solid_fraction;
      result_.exponent = report.exponent.value;
      result_.softs = static_cast<std::size_t>(std::count(grains.soft.begin(), grains.soft.end(), 1));
      add_soft_particle(p, grains, {}, kFirstSoft);
    }
    if (test_.partner == SoftPartner::soft)
      add_soft_particle(p, insert_grains<3>(test_.insertion, seed + kSecondStream), (2 * radius_) * kSoftApproach,
                        kSecondSoft);
    else if (test_.partner == SoftPartner::cage)
      for (int face = 0; face < kFaces; ++face) p.walls.push_back(cage_wall(face));
    else
      p.walls.push_back(partner_wall());
    set_sphere_inertia(p, {test_.density, test_.density, test_.soft_density});
    for (std::size_t k = 0; k < p.bodies.size(); ++k)
      if (p.group[k] == kFirstSoft)
        result_.density += p.bodies.mass[k] / (4.0 / 3 * std::numbers::pi * radius_ * radius_ * radius_);
    if (test_.partner == SoftPartner::none) p.bodies.mass[0] *= kHeavy, p.bodies.inertia[0] *= kHeavy;
    const double smallest = test_.partner == SoftPartner::none ? radius_ : test_.insertion.radius_min;
    s.time_step = test_.relaxation.step * time_step_unit(test_.law, test_.density, smallest);
    return s;
  }

  SphereWall partner_wall() const {
    SphereWall wall = soft_partner_wall(radius_);
    if (test_.partner != SoftPartner::ball) return wall;
    wall.shape = WallShape::ball, wall.radius = test_.partner_radius;
    wall.point += test_.partner_radius * kSoftApproach;
    return wall;
  }

  static constexpr int kFaces = 6;
  SphereWall cage_wall(int face) const {
    SphereWall wall;
    wall.normal[face / 2] = face % 2 == 0 ? 1 : -1;
    wall.point = -radius_ * wall.normal;
    return wall;
  }

  // The first particle, shell and grains, by a distance, at the speed of the protocol.
  void approach(double distance) {
    const double dt = state_.time_step;
    const auto steps = static_cast<std::int64_t>(std::ceil(distance / (test_.relaxation.speed * dt)));
    const Vec3 velocity = (distance / (static_cast<double>(steps) * dt)) * kSoftApproach;
    if (test_.partner == SoftPartner::cage) return close_cage(norm(velocity), steps);
    solver_->engine().boost(kFirstSoft, velocity);
    solver_->run(steps);
    solver_->engine().boost(kFirstSoft, -1.0 * velocity);
  }

  void close_cage(double speed, std::int64_t steps) {
    SphereEngine& engine = solver_->engine();
    const std::size_t first = engine.walls().size() - kFaces;
    for (std::size_t k = first; k < engine.walls().size(); ++k)
      engine.set_wall_velocity(k, speed * engine.walls()[k].normal);
    solver_->run(steps);
    for (std::size_t k = first; k < engine.walls().size(); ++k) engine.set_wall_velocity(k, {});
  }

  // The first particle rigidly about its centre, little by little.
  void turn(double angle) {
    const double dt = state_.time_step;
    const auto steps = static_cast<std::int64_t>(std::ceil(std::abs(angle) * radius_ / (test_.relaxation.speed * dt)));
    const Vec3 centre = solver_->engine().walls().front().point;
    for (std::int64_t k = 0; k < steps; ++k) {
      solver_->engine().rotate(kFirstSoft, kAxis, angle / static_cast<double>(steps), centre);
      solver_->step();
    }
  }

  void relax() {
    const Relaxation& r = test_.relaxation;
    if (r.fire) {
      solver_->engine().stop();
      relax_by_fire(*solver_, test_.law, r.residual, r.most_iterations);
      return;
    }
    const auto steps = std::llround(r.wait / state_.time_step);
    for (int k = 0; k < r.waits; ++k) {
      if (k > 0) solver_->engine().stop();
      solver_->run(steps);
    }
  }

  void rotated(double delta, double alpha) {
    const Vec3 force = force_on_partner();
    result_.tangential.push_back({delta, alpha, dot(force, kSoftApproach), dot(force, kSlip), dot(force, kAxis)});
  }

  double normal_force() const {
    if (test_.partner != SoftPartner::cage) return dot(force_on_partner(), kSoftApproach);
    const SphereEngine& e = solver_->engine();
    double sum = 0;
    for (std::size_t k = e.walls().size() - kFaces; k < e.walls().size(); ++k)
      sum -= dot(e.force_on_wall(k), e.walls()[k].normal);
    return sum / kFaces;
  }

  Vec3 force_on_partner() const {
    const SphereEngine& e = solver_->engine();
    return test_.partner == SoftPartner::soft ? e.force_between(kFirstSoft, kSecondSoft)
                                              : e.force_on_wall(e.walls().size() - 1);
  }

  State<Spheres> snapshot() const {
    State<Spheres> s = state_;
    solver_->snapshot(s);
    return s;
  }

  double largest_overlap() const {
    const State<Spheres> s = snapshot();
    double largest = 0;
    const std::vector<double>& radius = s.packing.bodies.radius;
    for (const Link<3>& l : s.packing.links)
      largest = std::max(
          largest, -l.gap / std::min(radius[static_cast<std::size_t>(l.i)], radius[static_cast<std::size_t>(l.j)]));
    for (const WallLink& l : s.packing.wall_links)
      largest = std::max(largest, -l.gap / radius[static_cast<std::size_t>(l.body)]);
    return largest;
  }

  const SoftParticleTest& test_;
  double radius_;  // R_s
  SoftMeasurement result_;
  State<Spheres> state_;
  std::optional<Solver<Spheres>> solver_;
};

}  // namespace

Relaxation relaxation_of(SoftProtocol protocol) {
  Relaxation r;
  if (protocol == SoftProtocol::quasistatic) r.speed = 0.003125, r.waits = 2, r.wait = 0.02, r.step = 3;
  if (protocol == SoftProtocol::fire) r.fire = true;
  return r;
}

SoftParticleTest soft_particle_defaults(SoftPartner partner, SoftProtocol protocol) {
  SoftParticleTest t;
  t.partner = partner;
  t.relaxation = relaxation_of(protocol);
  t.insertion.shell_radius = 0.016;
  t.insertion.radius_max = 0.5 * t.insertion.shell_radius;
  t.insertion.radius_min = 0.1 * t.insertion.radius_max;
  SphereLawScene law;
  law.modulus = 5e5, law.poisson = 0.3, law.friction = 0.3, law.damping = 0.3, law.tangential_damping = 0.5;
  t.law = resolve(law);
  return t;
}

double time_step_unit(const SphereLaw& law, double density, double radius) {
  const double mass = density * 4 / 3 * std::numbers::pi * radius * radius * radius;
  const double k = normal_stiffness(law, pair_stiffness(law, radius, radius), -0.3 * radius);
  return 0.35 / std::sqrt(4 * k / mass);
}

SoftMeasurement measure_soft_particle(const SoftParticleTest& test, std::uint64_t seed) {
  SoftParticleTest finer = test;
  for (int attempt = 0;; ++attempt) try {
      SoftMeasurement m = Experiment(finer, seed).run();
      m.step = finer.relaxation.step;
      return m;
    } catch (const RunError&) {
      if (attempt == kFinerSteps) throw;
      finer.relaxation.step *= kFinerStep;
    }
}

}  // namespace isostat
