#include "dem/spheres/physical_hash.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "dem/state/digest.hpp"

namespace isostat {
namespace {

// A link seen from its smaller id; from the other end T and M, the force and moment on the far body, change their sign.
struct CanonicalLink {
  std::int64_t a, b;
  ImageShift<3> shift;
  LinkKind kind;
  double gap, normal_force;
  Vec3 tangential_force, moment;
  auto key() const { return std::tie(a, b, shift, kind, gap, normal_force, tangential_force.c, moment.c); }
  bool operator<(const CanonicalLink& other) const { return key() < other.key(); }
};

CanonicalLink canonical(const Link<3>& l, const std::vector<std::int64_t>& id) {
  const std::int64_t i = id[static_cast<std::size_t>(l.i)], j = id[static_cast<std::size_t>(l.j)];
  const ImageShift<3> back{-l.shift[0], -l.shift[1], -l.shift[2]};
  if (std::tie(i, back) <= std::tie(j, l.shift))
    return {i, j, l.shift, l.kind, l.gap, l.normal_force, l.tangential_force, l.moment};
  return {j, i, back, l.kind, l.gap, l.normal_force, -1.0 * l.tangential_force, -1.0 * l.moment};
}

void add_law(Digest& digest, const SphereLaw& law) {
  const auto& [normal, grain, wall, second, soft_solid, soft_soft, curvature, kn, kt, zeta, zeta_t, mu, mu_w, mu_r, kr,
               f0, d0] = law;
  digest.add(static_cast<std::int64_t>(normal));
  for (const double x :
       {grain.modulus, grain.poisson, wall.modulus, wall.poisson, kn, kt, zeta, zeta_t, mu, mu_w, mu_r, kr, f0, d0})
    digest.add(x);
  if (second == SphereMaterial{} && soft_solid == SoftParticleLaw{} && soft_soft == SoftParticleLaw{}) return;
  digest.add(second.modulus), digest.add(second.poisson), digest.add(curvature);
  for (const SoftParticleLaw& s : {soft_solid, soft_soft})
    for (const double x : {s.force, s.exponent, s.offset, s.tangential, s.tangential_exponent, s.friction})
      digest.add(x);
}

void add_links(Digest& digest, const SpherePacking& packing) {
  std::vector<CanonicalLink> links;
  for (const Link<3>& l : packing.links) links.push_back(canonical(l, packing.bodies.id));
  std::sort(links.begin(), links.end());
  digest.add(static_cast<std::int64_t>(links.size()));
  for (const CanonicalLink& l : links) {
    digest.add(l.a), digest.add(l.b);
    for (const int s : l.shift) digest.add(std::int64_t{s});
    digest.add(static_cast<std::int64_t>(l.kind));
    digest.add(l.gap), digest.add(l.normal_force);
    digest.add(l.tangential_force), digest.add(l.moment);
  }
}

void add_walls(Digest& digest, const SpherePacking& packing) {
  for (const SphereWall& w : packing.walls) {
    digest.add(static_cast<std::int64_t>(w.shape));
    digest.add(w.point), digest.add(w.normal), digest.add(w.radius), digest.add(w.velocity);
    digest.add(std::int64_t{w.group});
  }
  std::vector<WallLink> links = packing.wall_links;
  const auto key = [&](const WallLink& l) {
    return std::pair(packing.bodies.id[static_cast<std::size_t>(l.body)], l.wall);
  };
  std::sort(links.begin(), links.end(), [&](const WallLink& a, const WallLink& b) { return key(a) < key(b); });
  for (const WallLink& l : links) {
    digest.add(key(l).first), digest.add(std::int64_t{l.wall});
    digest.add(static_cast<std::int64_t>(l.kind));
    digest.add(l.gap), digest.add(l.normal_force), digest.add(l.tangential_force);
  }
}

}  // namespace

std::string physical_hash(const State<Spheres>& state) {
  Digest digest;
  digest.add(std::string_view(Spheres::name));
  digest.add(state.time);
  add_law(digest, state.law);
  digest.add(std::int64_t{state.packing.cell.has_value()});
  if (state.packing.cell) digest.add(state.packing.cell->length);
  digest.add(state.cell_motion.reference_length);
  digest.add(state.cell_motion.strain_rate);
  const double tilt = state.packing.cell ? state.packing.cell->tilt : 0;
  if (tilt != 0 || state.cell_motion.shear_strain_rate != 0) {
    digest.add(std::string_view("tilt"));
    digest.add(tilt), digest.add(state.cell_motion.shear_strain_rate);
  }

  const Bodies<3>& b = state.packing.bodies;
  std::vector<std::size_t> order(b.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) { return b.id[p] < b.id[q]; });
  digest.add(static_cast<std::int64_t>(b.size()));
  for (const std::size_t k : order) {
    digest.add(b.id[k]);
    digest.add(b.position[k]), digest.add(b.velocity[k]), digest.add(b.spin[k]);
    for (const double x : {b.radius[k], b.mass[k], b.inertia[k]}) digest.add(x);
    if (!state.packing.group.empty()) digest.add(std::int64_t{state.packing.group[k]});
    if (!state.packing.kind.empty()) digest.add(static_cast<std::int64_t>(state.packing.kind[k]));
  }
  add_links(digest, state.packing);
  add_walls(digest, state.packing);
  return digest.hex();
}

}  // namespace isostat
