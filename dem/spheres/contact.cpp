// Which law two bodies of any kind have between them.
#include "dem/spheres/at_rest.hpp"

namespace isostat {
namespace {

const SphereMaterial& material_of(const SphereLaw& law, SphereKind kind) {
  switch (kind) {
    case SphereKind::second:
      return law.second;
    case SphereKind::shell:
      return law.wall;
    case SphereKind::grain:
    case SphereKind::soft:
      break;
  }
  return law.grain;
}

// What a soft-particle of radius R_s keeps of its force at a plane where it meets a grain of radius R.
double share_of_plane(const SphereLaw& law, double soft, double grain) {
  return law.soft_curvature > 0 ? std::pow(grain / (grain + soft), law.soft_curvature) : 1.0;
}

ContactStiffness soft_stiffness(const SoftParticleLaw& soft, const SphereLaw& law, double radius, double share) {
  ContactStiffness c;
  c.friction = law.friction > 0 ? soft.friction : 0.0;
  c.soft = soft_contact(soft, law.grain.modulus, radius, share);
  return c;
}

}  // namespace

ContactStiffness pair_stiffness(const SphereLaw& law, const SphereBody& i, const SphereBody& j) {
  if (i.kind == SphereKind::grain && j.kind == SphereKind::grain) return pair_stiffness(law, i.radius, j.radius);
  const SphereBody &a = i.kind < j.kind ? i : j, &b = i.kind < j.kind ? j : i;
  if (b.kind == SphereKind::shell)  // no curvature to Hertz's law, as of a wall (PHYSICS: R12 = r)
    return wall_stiffness(law, a);
  if (b.kind != SphereKind::soft)
    return hertz_stiffness(material_of(law, a.kind), material_of(law, b.kind),
                           a.radius * b.radius / (a.radius + b.radius), law.friction);
  if (a.kind == SphereKind::soft)
    return soft_stiffness(law.soft_soft, law, 2 * a.radius * b.radius / (a.radius + b.radius), 1);
  return soft_stiffness(law.soft_solid, law, b.radius, share_of_plane(law, b.radius, a.radius));
}

ContactStiffness wall_stiffness(const SphereLaw& law, const SphereBody& body, const SphereWall& wall) {
  if (law.normal == NormalForce::linear) return {law.normal_stiffness, law.tangential_stiffness, law.wall_friction, {}};
  const bool curved = wall.shape == WallShape::ball;  // a shell's curvature is left out (PHYSICS: R12 = r)
  if (body.kind == SphereKind::soft)
    return soft_stiffness(law.soft_solid, law, body.radius, curved ? share_of_plane(law, body.radius, wall.radius) : 1);
  const double reduced = curved ? body.radius * wall.radius / (body.radius + wall.radius) : body.radius;
  return hertz_stiffness(material_of(law, body.kind), law.wall, reduced, law.wall_friction);
}

}  // namespace isostat
