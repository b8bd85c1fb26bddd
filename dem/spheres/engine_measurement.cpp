// What measurements ask of the engine between steps, and how they interfere.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dem/solver/neighbours_impl.hpp"
#include "dem/spheres/engine.hpp"
#include "dem/spheres/walls.hpp"

namespace isostat {
namespace {

// Rotation by an angle about a unit vector (Rodrigues).
class Rotation {
 public:
  Rotation(const Vec3& axis, double angle) : axis_(axis), cosine_(std::cos(angle)), sine_(std::sin(angle)) {}
  Vec3 operator()(const Vec3& v) const {
    return cosine_ * v + sine_ * cross(axis_, v) + ((1 - cosine_) * dot(axis_, v)) * axis_;
  }
  void turn(double* triple) const { put_triple(triple, (*this)(triple_at(triple))); }

 private:
  Vec3 axis_;
  double cosine_, sine_;
};

}  // namespace

Vec3 SphereEngine::force_at_rest(std::size_t place, std::int32_t i, std::int32_t j, std::uint8_t shift) const {
  const Vec3 r = branch(i, j, shift, cell_);
  const SphereBody a = bodies_.body(static_cast<std::size_t>(i)), b = bodies_.body(static_cast<std::size_t>(j));
  const Facing at = facing(r, a, b);
  if (!unlike_ && !(at.gap < 0) && !(law_.attraction > 0)) return {};
  const Vec3 normal = at_rest(law_, pair_stiffness(law_, a, b), at.gap).force * at.n;
  return at.gap < 0 ? normal + lists_.columns().history(place).tangential_force : normal;
}

Vec3 SphereEngine::wall_force_at_rest(const NearWall& near) const {
  const auto k = static_cast<std::size_t>(near.body);
  const SphereWall& wall = walls_[static_cast<std::size_t>(near.wall)];
  const WallFrame frame = wall_frame(wall, bodies_.position(k));
  const double gap = frame.distance - bodies_.radius(k);
  if (!(gap < 0)) return {};
  return repulsion(law_, wall_stiffness(law_, bodies_.body(k), wall), gap) * frame.n + near.tangential_force;
}

Vec3 SphereEngine::force_on_wall(std::size_t wall) const {
  Vec3 sum{};
  for (const NearWall& near : bodies_.near_walls)
    if (static_cast<std::size_t>(near.wall) == wall) sum -= wall_force_at_rest(near);
  return sum;
}

Vec3 SphereEngine::force_between(std::int32_t from, std::int32_t on) const {
  Vec3 sum{};
  lists_.for_each([&](std::size_t k, std::int32_t i, std::int32_t j, std::uint8_t shift) {
    const std::int32_t a = bodies_.group[static_cast<std::size_t>(i)], b = bodies_.group[static_cast<std::size_t>(j)];
    if (a == from && b == on) sum += force_at_rest(k, i, j, shift);
    if (a == on && b == from) sum -= force_at_rest(k, i, j, shift);
  });
  return sum;
}

double SphereEngine::squared_contact_forces() const {
  double sum = 0;
  lists_.for_each([&](std::size_t k, std::int32_t i, std::int32_t j, std::uint8_t shift) {
    const Vec3 f = force_at_rest(k, i, j, shift);
    sum += dot(f, f);
  });
  for (const NearWall& near : bodies_.near_walls) {
    const Vec3 f = wall_force_at_rest(near);
    sum += dot(f, f);
  }
  return sum;
}

void SphereEngine::boost(std::int32_t group, const Vec3& velocity) {
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    if (bodies_.group[k] == group) bodies_.set_half_velocity(k, bodies_.half_velocity(k) + velocity);
  for (SphereWall& w : walls_)
    if (w.group == group) w.velocity += velocity;
}

void SphereEngine::set_wall_velocity(std::size_t wall, const Vec3& velocity) { walls_[wall].velocity = velocity; }

void SphereEngine::stop() {
  for (std::size_t k = 0; k < bodies_.size(); ++k) bodies_.set_half_velocity(k, {}), bodies_.set_half_spin(k, {});
  for (SphereWall& w : walls_) w.velocity = {};
}

// stretched(spring on the body of the group, normal towards it, contact point, k_T) -> the spring.
template <class Stretched>
void SphereEngine::stretch_springs_out_of(std::int32_t group, Stretched&& stretched) {
  SpherePairs& pairs = lists_.columns();
  lists_.for_each([&](std::size_t k, std::int32_t i, std::int32_t j, std::uint8_t shift) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const bool i_turns = bodies_.group[a] == group, j_turns = bodies_.group[b] == group;
    if (i_turns == j_turns || !(law_.friction > 0)) return;
    const Vec3 r = branch(i, j, shift, cell_);
    const SphereBody body_i = bodies_.body(a), body_j = bodies_.body(b);
    const Facing at = facing(r, body_i, body_j);
    if (!(at.gap < 0)) return;
    const Vec3 contact = bodies_.position(a) + (body_i.radius / (body_i.radius + body_j.radius)) * r;
    const double stiffness = tangential_stiffness(law_, pair_stiffness(law_, body_i, body_j), at.gap);
    SphereHistory h = pairs.history(k);
    const double side = j_turns ? 1 : -1;  // springs are those on j
    h.tangential_force = side * stretched(side * h.tangential_force, at.n, contact, stiffness);
    pairs.remember(k, h);
  });
  for (NearWall& near : bodies_.near_walls) {
    const auto k = static_cast<std::size_t>(near.body);
    const SphereWall& wall = walls_[static_cast<std::size_t>(near.wall)];
    if (bodies_.group[k] != group || wall.group == group || !(law_.wall_friction > 0)) continue;
    const WallFrame frame = wall_frame(wall, bodies_.position(k));
    const double gap = frame.distance - bodies_.radius(k);
    if (!(gap < 0)) continue;
    near.tangential_force = stretched(near.tangential_force, frame.n, bodies_.position(k) - frame.distance * frame.n,
                                      tangential_stiffness(law_, wall_stiffness(law_, bodies_.body(k), wall), gap));
  }
}

void SphereEngine::rotate(std::int32_t group, const Vec3& axis, double angle, const Vec3& centre) {
  using spheres::LoadSlot;
  using spheres::Slot;
  if (cell_) throw std::logic_error("SphereEngine::rotate: a group in a periodic cell");
  const Rotation rotation(axis, angle);
  const auto about_centre = [&](const Vec3& r) { return centre + rotation(r - centre); };
  const auto in_group = [&](std::int32_t k) { return bodies_.group[static_cast<std::size_t>(k)] == group; };
  // Springs that join the group to what is at rest are stretched by the slip of their contact point.
  const auto stretched = [&](const Vec3& spring, const Vec3& n, const Vec3& contact, double stiffness) {
    const Vec3 slip = about_centre(contact) - contact;
    return spring - stiffness * (slip - dot(slip, n) * n);
  };
  stretch_springs_out_of(group, stretched);
  double furthest = 0;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (bodies_.group[k] != group) continue;
    const Vec3 r = bodies_.position(k), to = about_centre(r);
    furthest = std::max(furthest, norm(to - r));
    bodies_.place(k, to);
    bodies_.set_half_velocity(k, rotation(bodies_.half_velocity(k)));
    bodies_.set_half_spin(k, rotation(bodies_.half_spin(k)));
    rotation.turn(bodies_.row(k) + Slot::velocity), rotation.turn(bodies_.row(k) + Slot::surface);
    rotation.turn(bodies_.load(k) + LoadSlot::force), rotation.turn(bodies_.load(k) + LoadSlot::moment_per_radius);
    rotation.turn(bodies_.moment(k));
  }
  SpherePairs& pairs = lists_.columns();
  lists_.for_each([&](std::size_t k, std::int32_t i, std::int32_t j, std::uint8_t) {
    if (!in_group(i) || !in_group(j)) return;
    const SphereHistory h = pairs.history(k);
    pairs.remember(k, {rotation(h.tangential_force), rotation(h.moment)});
  });
  for (NearWall& near : bodies_.near_walls)
    if (walls_[static_cast<std::size_t>(near.wall)].group == group)
      near.tangential_force = rotation(near.tangential_force);
  for (SphereWall& w : walls_) {
    if (w.group != group) continue;
    const Vec3 to = about_centre(w.point);
    furthest = std::max(furthest, norm(to - w.point));
    w.point = to, w.normal = rotation(w.normal), w.velocity = rotation(w.velocity);
  }
  update_lists(cell_, 2.02 * furthest);
}

SphereEngine::Relaxation SphereEngine::relaxation() const {
  Relaxation sum;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const SphereConstants& c = bodies_.constants[k];
    const Vec3 v = bodies_.half_velocity(k), f = bodies_.force(k);
    sum.power += dot(f, v), sum.speed_squared += c.mass * dot(v, v);
    sum.pull_squared += c.inverse_mass * dot(f, f), sum.force_squared += dot(f, f);
    if (!rotates_) continue;
    const Vec3 w = bodies_.half_spin(k), m = bodies_.torque(k);
    sum.power += dot(m, w), sum.speed_squared += bodies_.inertia[k] * dot(w, w);
    sum.pull_squared += c.inverse_inertia * dot(m, m);
  }
  return sum;
}

void SphereEngine::steer(double keep, double push) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const SphereConstants& c = bodies_.constants[k];
    bodies_.set_half_velocity(k, keep * bodies_.half_velocity(k) + (push * c.inverse_mass) * bodies_.force(k));
    if (rotates_)
      bodies_.set_half_spin(k, keep * bodies_.half_spin(k) + (push * c.inverse_inertia) * bodies_.torque(k));
  }
}

}  // namespace isostat
