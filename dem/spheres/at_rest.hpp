// The spheres' law at rest (dem/spheres/sphere_law.hpp has the formulas), written once: certificate, snapshots,
// stiffness, static solves and lab ask here. The kernels evaluate the same law for batches of pairs in motion
// (dem/spheres/kernel); tests hold the two together.
#pragma once
#include <algorithm>
#include <cmath>

#include "dem/spheres/soft_contact.hpp"
#include "dem/spheres/spheres.hpp"
#include "dem/state/yield.hpp"

namespace isostat {

// What the law is of one pair, or of a sphere at a wall. With the overlap d = -h > 0:
//   Hertz   N_e = normal d^(3/2), k_T = tangential d^(1/2)      normal = 4/3 E* sqrt(R*), tangential = 8 G* sqrt(R*)
//   linear  N_e = normal d,       k_T = tangential
//   soft    dem/spheres/soft_contact.hpp
struct ContactStiffness {
  double normal = 0, tangential = 0;  // [F0/a^(3/2)] or [F0/a]
  double friction = 0;                // mu [-]
  SoftContact soft;
  bool is_soft() const { return soft.radius > 0; }
};

// A body as the law sees it.
struct SphereBody {
  double radius = 0;  // [a] negative: a shell
  SphereKind kind = SphereKind::grain;
};

inline SphereBody body_of(const SpherePacking& packing, std::int32_t k) {
  const auto at = static_cast<std::size_t>(k);
  return {packing.bodies.radius[at], packing.kind.empty() ? SphereKind::grain : packing.kind[at]};
}

// Where two bodies face each other, r from i to j. To a shell the distance counts as negative (kernel/pair_force_impl).
struct Facing {
  Vec3 n{};
  double distance = 0, gap = 0;  // [a]
};
inline Facing facing(const Vec3& r, const SphereBody& i, const SphereBody& j) {
  const double sum = i.radius + j.radius, distance = std::copysign(norm(r), sum);
  return {r / distance, distance, distance - sum};
}

// 1/E* = (1 - nu_i^2)/E_i + (1 - nu_j^2)/E_j; 1/G* = (2 - nu_i)/G_i + (2 - nu_j)/G_j, G = E/(2 (1 + nu)) [F0/a^2].
inline double reduced_modulus(const SphereMaterial& a, const SphereMaterial& b) {
  return 1 / ((1 - a.poisson * a.poisson) / a.modulus + (1 - b.poisson * b.poisson) / b.modulus);
}
inline double reduced_shear_modulus(const SphereMaterial& a, const SphereMaterial& b) {
  const auto shear = [](const SphereMaterial& m) { return 0.5 * m.modulus / (1 + m.poisson); };
  return 1 / ((2 - a.poisson) / shear(a) + (2 - b.poisson) / shear(b));
}

inline ContactStiffness hertz_stiffness(const SphereMaterial& a, const SphereMaterial& b, double reduced_radius,
                                        double friction) {
  const double root = std::sqrt(reduced_radius);
  return {4.0 / 3 * reduced_modulus(a, b) * root, 8 * reduced_shear_modulus(a, b) * root, friction, {}};
}
// Of two grains of the first material.
inline ContactStiffness pair_stiffness(const SphereLaw& law, double radius_i, double radius_j) {
  if (law.normal == NormalForce::linear) return {law.normal_stiffness, law.tangential_stiffness, law.friction, {}};
  return hertz_stiffness(law.grain, law.grain, radius_i * radius_j / (radius_i + radius_j), law.friction);
}
// Of any two bodies (dem/spheres/contact.cpp); at a wall, a plane unless it is said.
ContactStiffness pair_stiffness(const SphereLaw& law, const SphereBody& i, const SphereBody& j);
ContactStiffness wall_stiffness(const SphereLaw& law, const SphereBody& body, const SphereWall& wall = {});
inline ContactStiffness wall_stiffness(const SphereLaw& law, double radius) {
  return wall_stiffness(law, SphereBody{radius, SphereKind::grain});
}

// Whether there is a contact: of a soft-particle beyond its threshold alone, below which nothing is transmitted.
inline bool touches(const ContactStiffness& c, double gap) { return -gap > c.soft.threshold * c.soft.radius; }

// N_e, what the Coulomb and rolling limits act on [F0]; its tangent stiffness k_N and that of the spring, k_T [F0/a].
inline double repulsion(const SphereLaw& law, const ContactStiffness& c, double gap) {
  const double overlap = std::max(-gap, 0.0);
  if (c.is_soft()) return soft_force(c.soft, overlap).force;
  return c.normal * overlap * (law.normal == NormalForce::hertz ? std::sqrt(overlap) : 1.0);
}
inline double normal_stiffness(const SphereLaw& law, const ContactStiffness& c, double gap) {
  if (!(gap < 0)) return 0;
  if (c.is_soft()) return soft_force(c.soft, -gap).stiffness;
  return law.normal == NormalForce::hertz ? 1.5 * c.normal * std::sqrt(-gap) : c.normal;
}
inline double tangential_stiffness(const SphereLaw& law, const ContactStiffness& c, double gap) {
  if (!(gap < 0)) return 0;
  if (c.is_soft()) return soft_tangential_stiffness(c.soft, -gap);
  return law.normal == NormalForce::hertz ? c.tangential * std::sqrt(-gap) : c.tangential;
}

// By the gap: of a contact N = N_e - F0, of a distant link within reach N = -F0 (1 - h/D0); nothing beyond D0.
inline AtRest at_rest(const SphereLaw& law, const ContactStiffness& c, double gap) {
  if (gap < 0) {
    const double force = repulsion(law, c, gap);
    const double elastic =
        c.is_soft() ? soft_energy(c.soft, -gap) : (law.normal == NormalForce::hertz ? 0.4 : 0.5) * force * -gap;
    return {force - law.attraction, normal_stiffness(law, c, gap), elastic,
            -(law.attraction * (0.5 * law.attraction_range - gap))};
  }
  if (!(law.attraction > 0) || gap > law.attraction_range) return {};
  const double range = law.attraction_range, reach = range - gap;
  return {-law.attraction * (1 - gap / range), -law.attraction / range, 0,
          -(0.5 * law.attraction * reach * reach / range)};
}

inline Limits limits(const SphereLaw& law, const ContactStiffness& c, double gap) {
  const double elastic = repulsion(law, c, gap);
  return {c.friction * elastic, law.rolling_friction * elastic};
}
inline YieldMargin yield_margin(const SphereLaw& law, const ContactStiffness& c, double gap,
                                const Vec3& tangential_force, const Vec3& moment) {
  const Limits most = limits(law, c, gap);
  return {yield_margin(c.friction, most.tangential, norm(tangential_force)),
          yield_margin(law.rolling_friction, most.rolling, norm(moment))};
}
inline LinkKind kind_of(const SphereLaw& law, const ContactStiffness& c, double gap, const Vec3& tangential_force,
                        const Vec3& moment) {
  return link_kind(gap, yield_margin(law, c, gap, tangential_force, moment));
}
inline LinkKind wall_kind_of(const SphereLaw& law, const ContactStiffness& c, double gap,
                             const Vec3& tangential_force) {
  const double limit = c.friction * repulsion(law, c, gap);
  return link_kind(gap, {yield_margin(c.friction, limit, norm(tangential_force)), 1.0});
}

inline SpringEnergy spring_energy(const SphereLaw& law, const ContactStiffness& c, double gap,
                                  const Vec3& tangential_force, const Vec3& moment) {
  return {stored_energy(norm(tangential_force), tangential_stiffness(law, c, gap)),
          stored_energy(norm(moment), law.rolling_stiffness)};
}

}  // namespace isostat
