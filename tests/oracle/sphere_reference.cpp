#include "tests/oracle/sphere_reference.hpp"

#include <cmath>

namespace isostat::oracle {
namespace {

Vec3 turned(const Vec3& v, const Vec3& rotation) {
  const double angle = norm(rotation);
  if (angle == 0) return v;
  const Vec3 axis = (1 / angle) * rotation;
  return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + ((1 - std::cos(angle)) * dot(axis, v)) * axis;
}

Vec3 capped(const Vec3& v, double limit) {
  const double size = norm(v);
  return size > limit ? (limit / size) * v : v;
}

}  // namespace

SpherePairResponse pair_response(const SphereLaw& law, const SpherePairMoment& p) {
  SpherePairResponse out;
  const double distance = norm(p.r), sum = p.radius_i + p.radius_j, gap = distance - sum;
  const Vec3 n = (1 / distance) * p.r;
  const double li = distance * p.radius_i / sum, lj = distance * p.radius_j / sum;
  out.gap = gap;
  const bool contact = gap < 0;

  const double e = 1 / (2 * (1 - law.grain.poisson * law.grain.poisson) / law.grain.modulus);
  const double g = 1 / (2 * (2 - law.grain.poisson) / (law.grain.modulus / (2 * (1 + law.grain.poisson))));
  const double rr = p.radius_i * p.radius_j / sum, mr = p.mass_i * p.mass_j / (p.mass_i + p.mass_j);
  const bool hertz = law.normal == NormalForce::hertz;
  double elastic = 0, kn = 0, kt = 0;
  const auto tangential_stiffness = [&](double overlap) {
    return hertz ? 8 * g * std::sqrt(rr * overlap) : law.tangential_stiffness;
  };
  if (contact) {
    elastic = hertz ? 4.0 / 3 * e * std::sqrt(rr) * std::pow(-gap, 1.5) : law.normal_stiffness * -gap;
    kn = hertz ? 2 * e * std::sqrt(rr * -gap) : law.normal_stiffness;
    kt = tangential_stiffness(-gap);
  }
  double attraction = 0;
  if (law.attraction > 0)
    attraction = contact ? law.attraction : law.attraction * std::max(0.0, 1 - gap / law.attraction_range);
  const double eta = 2 * law.damping * std::sqrt(mr * kn);
  out.force = (elastic - attraction - eta * dot(n, p.velocity)) * n;

  // The step's displacement of the branch vector, and the turn of the normal.
  const double dt = p.time_step;
  const Vec3 dr = dt * p.half_velocity;
  const Vec3 old = p.r - dr;
  const Vec3 n_old = (1 / norm(old)) * old;
  const double twist = dt * dot(n, p.radius_i * p.half_spin_i + p.radius_j * p.half_spin_j) / sum;

  if (law.friction > 0 && contact) {
    Vec3 t = p.tangential - (dot(p.tangential, n) / (1 + dot(n, n_old))) * (n + n_old);
    t = turned(t, twist * n);
    const double overlap_before = sum - norm(old);
    if (hertz && overlap_before > -gap) t = (kt / tangential_stiffness(overlap_before)) * t;
    // With the lever arms of the branch vector b.
    const auto contact_velocity = [&](const Vec3& v, const Vec3& wi, const Vec3& wj, const Vec3& b) {
      const Vec3 c = v - (1 / sum) * cross(p.radius_i * wi + p.radius_j * wj, b);
      return c - dot(c, n) * n;
    };
    const double limit = law.friction * elastic;
    t = capped(t - (kt * dt) * contact_velocity(p.half_velocity, p.half_spin_i, p.half_spin_j, p.r - 0.5 * dr), limit);
    out.tangential = t;
    const Vec3 dashpot = (law.tangential_damping * eta) * contact_velocity(p.velocity, p.spin_i, p.spin_j, p.r);
    const Vec3 total = capped(t - dashpot, limit);
    out.force += total;
    out.moment_i -= li * cross(n, total), out.moment_j -= lj * cross(n, total);
  }
  if (law.rolling_friction > 0 && contact) {
    const Vec3 axis = cross(n_old, n);  // of length sin(angle)
    const double sine = norm(axis);
    Vec3 m = sine > 0 ? turned(p.moment, (std::atan2(sine, dot(n_old, n)) / sine) * axis) : p.moment;
    m = turned(m, twist * n);
    m = capped(m - (law.rolling_stiffness * dt) * (p.half_spin_j - p.half_spin_i), law.rolling_friction * elastic);
    out.moment = m;
    out.moment_i -= m, out.moment_j += m;
  }
  return out;
}

}  // namespace isostat::oracle
