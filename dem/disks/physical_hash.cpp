#include "dem/disks/physical_hash.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "dem/state/digest.hpp"

namespace isostat {
namespace {

// A link seen from its smaller id; seen from the other end n and t turn round, so N and T keep their sign and M, the
// moment on the far body, changes it.
struct CanonicalLink {
  std::int64_t a, b;
  ImageShift<2> shift;
  LinkKind kind;
  double gap, normal_force, tangential_force, moment;
  auto key() const { return std::tie(a, b, shift, kind, gap, normal_force, tangential_force, moment); }
  bool operator<(const CanonicalLink& other) const { return key() < other.key(); }
};

CanonicalLink canonical(const Link<2>& l, const std::vector<std::int64_t>& id) {
  const std::int64_t i = id[static_cast<std::size_t>(l.i)], j = id[static_cast<std::size_t>(l.j)];
  const ImageShift<2> back{-l.shift[0], -l.shift[1]};
  if (std::tie(i, back) <= std::tie(j, l.shift))
    return {i, j, l.shift, l.kind, l.gap, l.normal_force, l.tangential_force, l.moment};
  return {j, i, back, l.kind, l.gap, l.normal_force, l.tangential_force, -l.moment};
}

}  // namespace

std::string physical_hash(const State<Disks>& state) {
  Digest digest;
  digest.add(state.time);
  const auto& [kn, kt, zeta, mu, mu_r, kr, f0, d0] = state.law;
  for (const double x : {kn, kt, zeta, mu, mu_r, kr, f0, d0}) digest.add(x);
  digest.add(std::int64_t{state.packing.cell.has_value()});
  if (state.packing.cell) digest.add(state.packing.cell->length);
  digest.add(state.cell_motion.reference_length);
  digest.add(state.cell_motion.strain_rate);
  const double tilt = state.packing.cell ? state.packing.cell->tilt : 0;
  if (tilt != 0 || state.cell_motion.shear_strain_rate != 0) {
    digest.add(std::string_view("tilt"));
    digest.add(tilt), digest.add(state.cell_motion.shear_strain_rate);
  }

  const Bodies<2>& b = state.packing.bodies;
  std::vector<std::size_t> order(b.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) { return b.id[p] < b.id[q]; });
  digest.add(static_cast<std::int64_t>(b.size()));
  for (const std::size_t k : order) {
    digest.add(b.id[k]);
    digest.add(b.position[k]);
    digest.add(b.velocity[k]);
    for (const double x : {b.spin[k], b.radius[k], b.mass[k], b.inertia[k]}) digest.add(x);
  }

  std::vector<CanonicalLink> links;
  links.reserve(state.packing.links.size());
  for (const Link<2>& l : state.packing.links) links.push_back(canonical(l, b.id));
  std::sort(links.begin(), links.end());
  digest.add(static_cast<std::int64_t>(links.size()));
  for (const CanonicalLink& l : links) {
    digest.add(l.a), digest.add(l.b);
    for (const int s : l.shift) digest.add(std::int64_t{s});
    digest.add(static_cast<std::int64_t>(l.kind));
    for (const double x : {l.gap, l.normal_force, l.tangential_force, l.moment}) digest.add(x);
  }
  if (!state.packing.part.empty())
    for (const std::size_t k : order) digest.add(static_cast<std::int64_t>(state.packing.part[k]));
  for (const Foot& foot : state.packing.feet) {  // in the order of their ids
    digest.add(std::int64_t{foot.wall}), digest.add(foot.turning);
  }
  add_surroundings(digest, state.scene.gravity, state.surroundings);
  return digest.hex();
}

}  // namespace isostat
