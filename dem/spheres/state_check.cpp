#include "dem/spheres/state_check.hpp"

namespace isostat {

using namespace state_check;
namespace {

using Broken = std::optional<StateFault>;

Broken walls_fault(const SpherePacking& p) {
  for (const SphereWall& w : p.walls) {
    if (w.shape > WallShape::ball) return StateFault{"walls/shape", "neither a plane, a shell nor a ball"};
    if (!finite(w.point) || !finite(w.normal) || !finite(w.velocity) || !finite(w.radius) || w.group < -1)
      return StateFault{"walls", "a number that is not finite, or a group that cannot be"};
    if (w.shape == WallShape::plane && !(std::abs(norm(w.normal) - 1) < 1e-9))
      return StateFault{"walls/normal", "of a plane is no unit vector"};
    if (w.shape != WallShape::plane && !(w.radius > 0))
      return StateFault{"walls/radius", "of a shell or ball is not positive"};
  }
  return std::nullopt;
}

Broken kinds_fault(const SpherePacking& p) {
  if (!p.kind.empty() && p.kind.size() != p.bodies.size())
    return StateFault{"particles/grains/kind", "neither one element a grain nor none"};
  for (const SphereKind kind : p.kind)
    if (kind >= SphereKind::shell)
      return StateFault{"particles/grains/kind", "neither a grain, one of the second material, nor a soft-particle"};
  return std::nullopt;
}

// A sphere and a wall that are there.
template <class Record>
bool joins(const Record& r, const SpherePacking& p) {
  return r.body >= 0 && static_cast<std::size_t>(r.body) < p.bodies.size() && r.wall >= 0 &&
         static_cast<std::size_t>(r.wall) < p.walls.size();
}

}  // namespace

Broken memory_fault(const SphereMemory& m, const SpherePacking& packing) {
  if (!packing.beams.empty()) return StateFault{"links", "beams are of the plane"};
  if (!packing.part.empty() || !packing.feet.empty())
    return StateFault{"particles/grains/part", "spheres make no walls"};
  const std::size_t n = packing.bodies.size();
  if (!packing.group.empty() && packing.group.size() != n)
    return StateFault{"particles/grains/group", "neither one element a grain nor none"};
  if (auto f = kinds_fault(packing)) return f;
  if (auto f = walls_fault(packing)) return f;
  for (const WallLink& l : packing.wall_links)
    if (!joins(l, packing) || l.kind > LinkKind::both_yielded || !finite(l.gap) || !finite(l.normal_force) ||
        !finite(l.tangential_force))
      return StateFault{"wall_links", "one that joins no grain to a wall, or has a number that is not finite"};
  for (const std::size_t size : {m.half_velocity.size(), m.half_spin.size(), m.force.size(), m.torque.size(),
                                 m.lists.outer_position.size(), m.lists.inner_position.size()})
    if (size != n && size != 0) return StateFault{"solver", "an array has neither one element a grain nor none"};
  if (auto f = check_values(m.half_velocity, "solver/half_velocity")) return f;
  if (auto f = check_values(m.half_spin, "solver/half_spin")) return f;
  if (auto f = check_values(m.force, "solver/force")) return f;
  if (auto f = check_values(m.torque, "solver/torque")) return f;
  for (const auto& p : m.pairs)
    if (!names_two_bodies(p, n) || !finite(p.history.tangential_force) || !finite(p.history.moment))
      return StateFault{"solver/pairs", "a pair does not join two grains or has a force that is not a finite number"};
  for (const WallSpring& s : m.wall_springs)
    if (!joins(s, packing) || !finite(s.tangential_force))
      return StateFault{"solver/walls", "one that joins no grain to a wall, or has a force that is not finite"};
  return lists_fault(m.lists);
}

Broken law_fault(const SphereLaw& law) {
  const auto& [normal, grain, wall, second, soft_solid, soft_soft, curvature, kn, kt, zeta, zeta_t, mu, mu_w, mu_r, kr,
               f0, d0] = law;
  if (normal > NormalForce::linear) return StateFault{"law/normal", "neither hertz nor linear"};
  for (const double x :
       {grain.modulus, wall.modulus, second.modulus, curvature, kn, kt, zeta, zeta_t, mu, mu_w, mu_r, kr, f0, d0})
    if (!finite(x) || x < 0) return StateFault{"law", "a parameter that is negative or not a finite number"};
  for (const double nu : {grain.poisson, wall.poisson, second.poisson})
    if (!(nu > -1 && nu <= 0.5)) return StateFault{"law/poisson", "is not above -1 and at most 0.5"};
  for (const SoftParticleLaw& soft : {soft_solid, soft_soft}) {
    for (const double x : {soft.force, soft.tangential, soft.friction})
      if (!finite(x) || x < 0) return StateFault{"law", "a soft-particle's number that is negative or not finite"};
    if (!(soft.exponent >= 1 && soft.tangential_exponent > 0) || !finite(soft.exponent + soft.tangential_exponent) ||
        !finite(soft.offset) || soft.offset > 0)
      return StateFault{"law", "a soft-particle's force that does not begin at zero and grow"};
  }
  return std::nullopt;
}

}  // namespace isostat
