#include "tests/oracle/sphere_solver.hpp"

#include <cmath>
#include <stdexcept>

#include "tests/oracle/sphere_reference.hpp"

namespace isostat::oracle {

SphereSolver::SphereSolver(const State<Spheres>& s, const CellControl<3>& control)
    : law_(s.law),
      control_(control),
      dt_(s.time_step),
      length_(s.packing.cell.value().length),
      reference_(s.cell_motion.reference_length),
      rate_(s.cell_motion.strain_rate),
      tilt_(s.packing.cell->tilt),
      shear_rate_(s.cell_motion.shear_strain_rate) {
  const Bodies<3>& b = s.packing.bodies;
  for (std::size_t k = 0; k < b.size(); ++k)
    spheres_.push_back({b.id[k], b.position[k], b.velocity[k], b.spin[k], b.velocity[k], b.spin[k], Vec3{}, Vec3{},
                        b.radius[k], b.mass[k], b.inertia[k]});
  for (const Link<3>& l : s.packing.links) {
    if (l.kind == LinkKind::distant) continue;
    const int way = l.i < l.j ? 1 : -1;
    const std::array<int, 5> key{std::min(l.i, l.j), std::max(l.i, l.j), way * l.shift[0], way * l.shift[1],
                                 way * l.shift[2]};
    springs_[key] = {way * l.tangential_force, way * l.moment};
  }
  forces(0);
  for (SphereMoment& a : spheres_) {
    a.half_velocity -= (0.5 * dt_ / a.mass) * a.force;
    a.half_spin -= (0.5 * dt_ / a.inertia) * a.torque;
  }
}

const SphereMoment& SphereSolver::sphere(std::int64_t id) const {
  for (const SphereMoment& a : spheres_)
    if (a.id == id) return a;
  throw std::out_of_range("no sphere of that id");
}

double SphereSolver::total_spring() const {
  double sum = 0;
  for (const auto& [key, spring] : springs_) sum += norm(spring.tangential);
  return sum;
}

// What the caps leave of a rate that a stress drives.
double SphereSolver::limited(double rate, double reference) const {
  if (control_.max_strain_rate > 0)
    rate = std::min(control_.max_strain_rate, std::max(-control_.max_strain_rate, rate));
  if (std::abs(rate) * reference > control_.max_edge_speed)
    rate = std::copysign(control_.max_edge_speed / reference, rate);
  return rate;
}

void SphereSolver::step() {
  const Vec3 before = length_;
  const double tilt_before = tilt_, shear_before = shear_rate_;
  Vec3 half = before;
  Vec3 keep{{1 - drag_ * dt_, 1 - drag_ * dt_, 1 - drag_ * dt_}};
  for (int a = 0; control_.moves() && a < 3; ++a) {
    const double old = rate_[a];
    const auto& imposed = control_.stress[static_cast<std::size_t>(a)];
    rate_[a] = imposed ? limited(old + dt_ * (*imposed - stress_[a]) / control_.inertia, reference_[a])
                       : control_.strain_rate[a];
    half[a] = before[a] - 0.5 * dt_ * rate_[a] * reference_[a];
    length_[a] = before[a] - dt_ * rate_[a] * reference_[a];
    flow_half_[a] = -rate_[a] * reference_[a] / half[a];
    flow_now_[a] = -(rate_[a] + 0.5 * (rate_[a] - old)) * reference_[a] / length_[a];
    if (control_.rate_coupling) keep[a] -= dt_ * flow_half_[a];
  }
  tilt_ *= length_[0] / before[0];
  double coupling = 0;
  if (control_.stress.shear || control_.shear_rate != 0) {
    shear_rate_ =
        control_.stress.shear
            ? limited(shear_before + dt_ * (*control_.stress.shear - shear_stress_) / control_.inertia, reference_[1])
            : -control_.shear_rate * before[1] / reference_[1];
    tilt_ -= dt_ * shear_rate_ * reference_[1];
    // d(v_x)/dy of the flow that takes the edges of the old cell to those of the new one, at the cell midway.
    shear_half_ = ((tilt_ - tilt_before) / dt_ - flow_half_[0] * 0.5 * (tilt_ + tilt_before)) / half[1];
    shear_now_ = -(shear_rate_ + 0.5 * (shear_rate_ - shear_before)) * reference_[1] / length_[1];
    if (control_.rate_coupling) coupling = dt_ * shear_half_;
  }
  const PeriodicCell<3> old_cell{before, tilt_before}, middle{half, 0.5 * (tilt_ + tilt_before)},
      new_cell{length_, tilt_};
  const bool turns = law_.friction > 0 || law_.rolling_friction > 0;
  for (SphereMoment& a : spheres_) {
    const Vec3 pull = (1 / a.mass) * a.force, turn = (1 / a.inertia) * a.torque;
    const Vec3 pushed = a.half_velocity + dt_ * pull;
    for (int k = 0; k < 3; ++k) a.half_velocity[k] = pushed[k] * keep[k];
    a.half_velocity[0] -= coupling * pushed[1];
    if (turns) a.half_spin = (1 - drag_ * dt_) * (a.half_spin + dt_ * turn);
    a.velocity = a.half_velocity + 0.5 * dt_ * pull;
    if (turns) a.spin = a.half_spin + 0.5 * dt_ * turn;
    // The position in units of the cell moves by the peculiar velocity.
    a.r = new_cell.point(old_cell.fractions(a.r) + dt_ * middle.fractions(a.half_velocity));
  }
  forces(dt_);
}

void SphereSolver::forces(double dt) {
  Vec3 sum{};
  double shear = 0;
  for (SphereMoment& a : spheres_) {
    a.force = a.torque = {};
    for (int k = 0; k < 3; ++k) sum[k] += a.mass * a.velocity[k] * a.velocity[k];
    shear += a.mass * a.velocity[0] * a.velocity[1];
  }
  const auto flowing = [](const Vec3& along, double lean, const Vec3& r) {
    return Vec3{{along[0] * r[0] + lean * r[1], along[1] * r[1], along[2] * r[2]}};
  };
  const double range = law_.attraction > 0 ? law_.attraction_range : 0.0;
  std::map<std::array<int, 5>, Spring> stretched;
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    for (std::size_t j = i + 1; j < spheres_.size(); ++j) {
      SphereMoment &a = spheres_[i], &b = spheres_[j];
      const Vec3 apart = b.r - a.r;
      const auto nearest = [&](double x, int k) { return -static_cast<int>(std::lround(x / length_[k])); };
      const int z = nearest(apart[2], 2), y = nearest(apart[1], 1);
      for (int s3 = z - 1; s3 <= z + 1; ++s3)
        for (int s2 = y - 1; s2 <= y + 1; ++s2) {
          const int x = nearest(apart[0] + s2 * tilt_, 0);
          for (int s1 = x - 1; s1 <= x + 1; ++s1) {
            SpherePairMoment p;
            p.r = apart + Vec3{{s1 * length_[0] + s2 * tilt_, s2 * length_[1], s3 * length_[2]}};
            const double gap = norm(p.r) - a.radius - b.radius;
            if (gap >= range) continue;
            const std::array<int, 5> key{static_cast<int>(i), static_cast<int>(j), s1, s2, s3};
            p.radius_i = a.radius, p.radius_j = b.radius, p.mass_i = a.mass, p.mass_j = b.mass;
            p.half_velocity = b.half_velocity - a.half_velocity + flowing(flow_half_, shear_half_, p.r);
            p.velocity = b.velocity - a.velocity + flowing(flow_now_, shear_now_, p.r);
            p.half_spin_i = a.half_spin, p.half_spin_j = b.half_spin, p.spin_i = a.spin, p.spin_j = b.spin;
            p.time_step = dt;
            if (const auto at = springs_.find(key); at != springs_.end())
              p.tangential = at->second.tangential, p.moment = at->second.moment;
            const SpherePairResponse response = pair_response(law_, p);
            if (gap < 0) stretched[key] = {response.tangential, response.moment};
            a.force -= response.force, b.force += response.force;
            a.torque += response.moment_i, b.torque += response.moment_j;
            for (int k = 0; k < 3; ++k) sum[k] += response.force[k] * p.r[k];
            shear += response.force[0] * p.r[1];
          }
        }
    }
  springs_ = std::move(stretched);
  const double volume = length_[0] * length_[1] * length_[2];
  stress_ = (1 / volume) * sum, shear_stress_ = shear / volume;
}

}  // namespace isostat::oracle
