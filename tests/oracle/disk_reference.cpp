#include "tests/oracle/disk_reference.hpp"

#include "dem/disks/motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace isostat::oracle {
namespace {

// Elastic-perfectly-plastic spring (Eqs. 8, 10 with the displacement clamped). `lost`: the work done on the slip, the
// mean force over the step times the part of the displacement that the spring did not take.
double yield(double stiffness, double limit, double force, double displacement, double& lost) {
  const double trial = force - stiffness * displacement;
  const double after = trial > limit ? limit : trial < -limit ? -limit : trial;
  if (stiffness > 0) {
    const double slip = (after - trial) / stiffness;
    lost = -0.5 * (force + after) * slip;
  }
  return after;
}

}  // namespace

PairResponse pair_response(const DiskLaw& law, const PairMoment& c) {
  PairResponse out;
  const double distance = std::hypot(c.x, c.y), nx = c.x / distance, ny = c.y / distance;
  const double tx = -ny, ty = nx;
  const double h = distance - c.radius_i - c.radius_j;
  const double lever_i = distance * c.radius_i / (c.radius_i + c.radius_j);
  const double lever_j = distance * c.radius_j / (c.radius_i + c.radius_j);
  out.gap = h;

  // A contact that forms or ends within a step exists for a part of it (dem/disks/kernel/crossing.hpp).
  const double moved = (nx * c.u + ny * c.v) * c.time_step;
  const double reduced = c.mass_i * c.mass_j / (c.mass_i + c.mass_j);
  const double damping = law.damping * 2 * std::sqrt(law.normal_stiffness * reduced);
  double kink = 1, jump = 1, lived = c.time_step;
  if (std::abs(moved) > std::abs(h)) {
    const double part = std::abs(h / moved);
    if (h < 0 && moved < 0) {  // has formed; the viscous force will slow the next step down
      jump = 0.5 + part;
      const double after = std::max(0.0, 1 - damping * c.time_step / reduced * jump);
      kink = (part + after) / (1 + after);
      lived *= part;
    } else if (h < 0) {  // will end
      jump = 0.5 + part;
      kink = 0.5 * (1 + part);
    } else if (moved > 0) {  // has ended
      lived *= 1 - part;
    }
  }
  double normal = 0;
  const double repulsion = h < 0 ? -law.normal_stiffness * h : 0;
  if (h < 0) {
    out.viscous_force = -jump * damping * (nx * c.p + ny * c.q);
    normal = kink * repulsion - law.attraction + out.viscous_force;
  } else if (law.attraction > 0 && h < law.attraction_range) {
    normal = -law.attraction * (1 - h / law.attraction_range);
  }

  const double slip_rate = tx * c.u + ty * c.v - lever_i * c.spin_i - lever_j * c.spin_j;
  if (law.friction > 0)
    out.tangential =
        yield(law.tangential_stiffness, law.friction * repulsion, c.tangential, slip_rate * lived, out.sliding);
  if (law.rolling_friction > 0)
    out.moment = yield(law.rolling_stiffness, law.rolling_friction * repulsion, c.moment, (c.spin_j - c.spin_i) * lived,
                       out.rolling);

  const double tangential = kink * out.tangential, moment = kink * out.moment;
  out.fx = normal * nx + tangential * tx;
  out.fy = normal * ny + tangential * ty;
  out.moment_i = -tangential * lever_i - moment;
  out.moment_j = -tangential * lever_j + moment;
  return out;
}

DiskReference::DiskReference(const State<Disks>& s, const CellControl<2>& control)
    : law_(s.law), control_(control), dt_(s.time_step), ledger_(s.ledger) {
  for (int a = 0; a < 2; ++a) {
    const auto k = static_cast<std::size_t>(a);
    length_[k] = s.packing.cell->length[a];
    reference_[k] = s.cell_motion.reference_length[a];
    rate_[k] = s.cell_motion.strain_rate[a];
  }
  tilt_ = s.packing.cell->tilt, shear_rate_ = s.cell_motion.shear_strain_rate;
  const Bodies<2>& b = s.packing.bodies;
  disks_.resize(b.size());
  for (std::size_t k = 0; k < b.size(); ++k) {
    DiskMoment& d = disks_[k];
    d.id = b.id[k];
    d.x = b.position[k][0], d.y = b.position[k][1];
    d.u = d.p = b.velocity[k][0], d.v = d.q = b.velocity[k][1], d.w = b.spin[k];
    d.radius = b.radius[k], d.mass = b.mass[k], d.inertia = b.inertia[k];
  }
  for (const Link<2>& l : s.packing.links) {
    const bool turn = l.i > l.j;
    const std::array<int, 4> key = {turn ? l.j : l.i, turn ? l.i : l.j, turn ? -l.shift[0] : l.shift[0],
                                    turn ? -l.shift[1] : l.shift[1]};
    springs_[key] = {l.tangential_force, turn ? -l.moment : l.moment};
  }
  forces(0);
  for (DiskMoment& d : disks_) {
    d.u -= 0.5 * dt_ * d.fx / d.mass;
    d.v -= 0.5 * dt_ * d.fy / d.mass;
    d.w -= 0.5 * dt_ * d.torque / d.inertia;
  }
}

const DiskMoment& DiskReference::disk(std::int64_t id) const {
  for (const DiskMoment& d : disks_)
    if (d.id == id) return d;
  throw std::out_of_range("no disk of that id");
}

void DiskReference::step() {
  std::array<double, 2> keep = {1 - drag_ * dt_, 1 - drag_ * dt_}, before = length_, half = length_;
  const double tilt_before = tilt_, old_shear = shear_rate_;
  if (control_.moves())
    for (std::size_t a = 0; a < 2; ++a) {
      const double old = rate_[a];
      if (control_.stress[a]) {
        rate_[a] = old + dt_ * (*control_.stress[a] - stress_[a]) / control_.inertia;
        rate_[a] = limited(rate_[a], reference_[a]);
      } else {
        rate_[a] = control_.strain_rate[static_cast<int>(a)];
      }
      const double rate_now = rate_[a] + 0.5 * (rate_[a] - old);  // extrapolated to the full step
      half[a] = before[a] - 0.5 * dt_ * rate_[a] * reference_[a];
      length_[a] = before[a] - dt_ * rate_[a] * reference_[a];
      flow_half_[a] = -rate_[a] * reference_[a] / half[a];
      flow_now_[a] = -rate_now * reference_[a] / length_[a];
      if (control_.rate_coupling) keep[a] -= dt_ * flow_half_[a];
    }
  tilt_ *= length_[0] / before[0];
  double coupling = 0;
  if (control_.stress.shear || control_.shear_rate != 0) {
    shear_rate_ =
        control_.stress.shear
            ? limited(old_shear + dt_ * (*control_.stress.shear - shear_stress_) / control_.inertia, reference_[1])
            : -control_.shear_rate * before[1] / reference_[1];
    const double speed = -shear_rate_ * reference_[1];  // of the upper edge along x
    tilt_ += dt_ * speed;
    // (v_x)/dy of the flow that takes the edges of the old cell to those of the new one, at the cell midway.
    shear_half_ = ((tilt_ - tilt_before) / dt_ - flow_half_[0] * 0.5 * (tilt_ + tilt_before)) / half[1];
    shear_now_ = -(shear_rate_ + 0.5 * (shear_rate_ - old_shear)) * reference_[1] / length_[1];
    if (control_.rate_coupling) coupling = dt_ * shear_half_;
  }
  const double half_tilt = 0.5 * (tilt_ + tilt_before);
  double lightest = INFINITY;
  for (const DiskMoment& d : disks_) lightest = std::min(lightest, d.mass);
  const double ahead = dt_ * velocity_prediction(law_, lightest, dt_);
  const bool turns = law_.friction > 0 || law_.rolling_friction > 0;
  for (DiskMoment& d : disks_) {
    const double ax = d.fx / d.mass, ay = d.fy / d.mass, b = d.torque / d.inertia;
    const double v_before = d.v + dt_ * ay;
    d.u = (d.u + dt_ * ax) * keep[0] - coupling * v_before, d.v = v_before * keep[1];
    if (turns) d.w = (d.w + dt_ * b) * (1 - drag_ * dt_);
    d.p = d.u + ahead * ax, d.q = d.v + ahead * ay;
    // The position in units of the cell moves by the peculiar velocity.
    const double along_2 = d.y / before[1] + dt_ * d.v / half[1];
    const double along_1 =
        (d.x - tilt_before * (d.y / before[1])) / before[0] + dt_ * (d.u - half_tilt * (d.v / half[1])) / half[0];
    d.x = length_[0] * along_1 + tilt_ * along_2;
    d.y = length_[1] * along_2;
  }
  forces(dt_);
}

// What the caps leave of a rate that a stress drives.
double DiskReference::limited(double rate, double reference) const {
  if (control_.max_strain_rate > 0)
    rate = std::min(control_.max_strain_rate, std::max(-control_.max_strain_rate, rate));
  if (std::abs(rate) * reference > control_.max_edge_speed)
    rate = std::copysign(control_.max_edge_speed / reference, rate);
  return rate;
}

void DiskReference::forces(double dt) {
  double virial_x = 0, virial_y = 0, kinetic_x = 0, kinetic_y = 0, virial_xy = 0, kinetic_xy = 0;
  for (DiskMoment& d : disks_) {
    d.fx = d.fy = d.torque = 0;
    kinetic_x += d.mass * d.p * d.p, kinetic_y += d.mass * d.q * d.q, kinetic_xy += d.mass * d.p * d.q;
  }
  interactions_ = 0;
  const int n = static_cast<int>(disks_.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      DiskMoment &a = disks_[static_cast<std::size_t>(i)], &b = disks_[static_cast<std::size_t>(j)];
      // Disks are not wrapped: the images to look at are those around the nearest one.
      const int near_y = -static_cast<int>(std::lround((b.y - a.y) / length_[1]));
      for (int s2 = near_y - 1; s2 <= near_y + 1; ++s2) {
        const int near_x = -static_cast<int>(std::lround((b.x - a.x + s2 * tilt_) / length_[0]));
        for (int s1 = near_x - 1; s1 <= near_x + 1; ++s1) {
          PairMoment c;
          c.x = b.x - a.x + s1 * length_[0] + s2 * tilt_, c.y = b.y - a.y + s2 * length_[1];
          if (std::hypot(c.x, c.y) > a.radius + b.radius + law_.attraction_range) {
            springs_.erase({i, j, s1, s2});
            continue;
          }
          ++interactions_;
          c.radius_i = a.radius, c.radius_j = b.radius, c.mass_i = a.mass, c.mass_j = b.mass;
          c.u = b.u - a.u + flow_half_[0] * c.x + shear_half_ * c.y, c.v = b.v - a.v + flow_half_[1] * c.y;
          c.p = b.p - a.p + flow_now_[0] * c.x + shear_now_ * c.y, c.q = b.q - a.q + flow_now_[1] * c.y;
          c.spin_i = a.w, c.spin_j = b.w;
          c.time_step = dt;
          Spring& spring = springs_[{i, j, s1, s2}];
          c.tangential = spring.tangential, c.moment = spring.moment;
          const PairResponse r = pair_response(law_, c);
          spring = {r.tangential, r.moment};
          a.fx -= r.fx, a.fy -= r.fy, a.torque += r.moment_i;
          b.fx += r.fx, b.fy += r.fy, b.torque += r.moment_j;
          virial_x += r.fx * c.x, virial_y += r.fy * c.y, virial_xy += r.fx * c.y;
          ledger_.sliding += r.sliding, ledger_.rolling += r.rolling;
        }
      }
    }
  shear_stress_ = (kinetic_xy + virial_xy) / (length_[0] * length_[1]);
  stress(virial_x, virial_y, kinetic_x, kinetic_y);
}

// Eq. 3, each pair once.
void DiskReference::stress(double virial_x, double virial_y, double kinetic_x, double kinetic_y) {
  const double area = length_[0] * length_[1];
  stress_ = {(kinetic_x + virial_x) / area, (kinetic_y + virial_y) / area};
}

}  // namespace isostat::oracle
