// From the engine into a state. Static forces, by the law at rest: what a step adds for viscosity is no part of them.
#include "dem/spheres/engine.hpp"
#include "dem/spheres/walls.hpp"

namespace isostat {

void SphereEngine::snapshot(State<Spheres>& s) const {
  s.law = law_;
  snapshot_bodies(s);
  lists_.remember(s.memory.lists, s.memory.pairs);
  snapshot_links(s);
  snapshot_walls(s);
}

void SphereEngine::snapshot_bodies(State<Spheres>& s) const {
  const std::size_t n = bodies_.size();
  const double half = 0.5 * dt_;
  Bodies<3>& b = s.packing.bodies;
  b.resize(n);
  SphereMemory& m = s.memory;
  m.half_velocity.resize(n), m.half_spin.resize(n), m.force.resize(n), m.torque.resize(n);
  s.packing.group.clear();
  if (has_groups_) s.packing.group = bodies_.group;
  s.packing.kind.clear();
  if (unlike_) s.packing.kind = bodies_.kind;
  for (std::size_t k = 0; k < n; ++k) {
    const SphereConstants& c = bodies_.constants[k];
    b.id[k] = bodies_.id[k];
    b.position[k] = bodies_.position(k);
    m.half_velocity[k] = bodies_.half_velocity(k), m.half_spin[k] = bodies_.half_spin(k);
    m.force[k] = bodies_.force(k), m.torque[k] = bodies_.torque(k);
    b.velocity[k] = m.half_velocity[k] + half * c.inverse_mass * m.force[k];
    b.spin[k] = m.half_spin[k] + half * c.inverse_inertia * m.torque[k];
    b.radius[k] = c.radius, b.mass[k] = c.mass, b.inertia[k] = bodies_.inertia[k];
  }
}

void SphereEngine::snapshot_links(State<Spheres>& s) const {
  s.packing.links.clear();
  lists_.for_each([&](std::size_t k, std::int32_t i, std::int32_t j, std::uint8_t shift) {
    const SphereBody a = bodies_.body(static_cast<std::size_t>(i)), b = bodies_.body(static_cast<std::size_t>(j));
    const double gap = facing(branch(i, j, shift, s.packing.cell), a, b).gap;
    if (!(gap < 0) && !(law_.attraction > 0 && gap < law_.attraction_range)) return;
    const ContactStiffness c = pair_stiffness(law_, a, b);
    const bool contact = touches(c, gap);
    if (gap < 0 && !contact) return;
    const SphereHistory springs = contact ? lists_.columns().history(k) : SphereHistory{};
    Link<3> link;
    link.i = i, link.j = j, link.shift = image_shift<3>(shift), link.gap = gap;
    link.normal_force = at_rest(law_, c, gap).force;
    link.tangential_force = springs.tangential_force, link.moment = springs.moment;
    link.kind = kind_of(law_, c, gap, link.tangential_force, link.moment);
    s.packing.links.push_back(link);
  });
}

void SphereEngine::snapshot_walls(State<Spheres>& s) const {
  s.packing.walls = walls_;
  s.packing.wall_links.clear();
  s.memory.wall_springs.clear();
  for (const NearWall& near : bodies_.near_walls) {
    const auto k = static_cast<std::size_t>(near.body);
    const WallFrame frame = wall_frame(walls_[static_cast<std::size_t>(near.wall)], bodies_.position(k));
    const double gap = frame.distance - bodies_.radius(k);
    if (near.tangential_force != Vec3{}) s.memory.wall_springs.push_back({near.body, near.wall, near.tangential_force});
    const ContactStiffness c = wall_stiffness(law_, bodies_.body(k), walls_[static_cast<std::size_t>(near.wall)]);
    if (!touches(c, gap)) continue;
    s.packing.wall_links.push_back({near.body, near.wall, wall_kind_of(law_, c, gap, near.tangential_force), gap,
                                    repulsion(law_, c, gap), near.tangential_force});
  }
}

}  // namespace isostat
