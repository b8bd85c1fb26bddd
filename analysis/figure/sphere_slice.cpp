#include "analysis/figure/sphere_slice.hpp"

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

// Which coordinate leads to the right, and which up: those of view_along().
std::array<int, 2> axes_in(const Slice& slice) {
  if (slice.axis == 0) return {1, 2};
  return slice.axis == 1 ? std::array{0, 2} : std::array{0, 1};
}

}  // namespace

SlicedSpheres cut(const SpherePacking& packing, const Slice& slice) {
  const Bodies<3>& b = packing.bodies;
  const auto [u, v] = axes_in(slice);
  SlicedSpheres out;
  const double tilt = packing.cell ? packing.cell->tilt : 0;
  if (tilt != 0 && slice.axis == 0) throw std::invalid_argument("cut: across the axis along which the cell leans");
  if (packing.cell)
    out.packing.cell =
        PeriodicCell<2>{{{packing.cell->length[u], packing.cell->length[v]}}, slice.axis == 2 ? tilt : 0};
  std::map<std::pair<std::int32_t, double>, std::int32_t> circle;  // by sphere and (whole) image along the axis
  Bodies<2>& disks = out.packing.bodies;
  const auto add = [&](std::size_t k, double image, double distance) {
    const std::size_t n = disks.size();
    circle[{static_cast<std::int32_t>(k), image}] = static_cast<std::int32_t>(n);
    disks.resize(n + 1);
    disks.id[n] = b.id[k], disks.mass[n] = b.mass[k], disks.inertia[n] = b.inertia[k];
    disks.position[n] = {{b.position[k][u], b.position[k][v]}};
    disks.velocity[n] = {{b.velocity[k][u], b.velocity[k][v]}};
    disks.radius[n] = std::sqrt((b.radius[k] - distance) * (b.radius[k] + distance));
    out.sphere.push_back(k);
  };
  for (std::size_t k = 0; k < b.size(); ++k) {
    const double place = b.position[k][slice.axis], radius = b.radius[k];
    if (!packing.cell) {
      if (std::abs(slice.at - place) < radius) add(k, 0, slice.at - place);
      continue;
    }
    const double edge = packing.cell->length[slice.axis];
    const double cells = std::floor(place / edge), inside = place - cells * edge;  // however far it has gone
    const double whole = std::floor(slice.at / edge), at = slice.at - whole * edge;
    for (double m = std::ceil((at - radius - inside) / edge); inside + m * edge < at + radius; ++m)
      if (const double d = at - (inside + m * edge); std::abs(d) < radius) {
        add(k, m - cells, d);
        if (slice.axis == 1) disks.position.back()[0] += (m - cells + whole) * tilt;  // images above lean over
      }
  }
  for (const Link<3>& l : packing.links)
    for (auto at = circle.lower_bound({l.i, -INFINITY}); at != circle.end() && at->first.first == l.i; ++at) {
      const auto other = circle.find({l.j, at->first.second + l.shift[idx(slice.axis)]});
      if (other == circle.end()) continue;
      Link<2> flat;
      flat.i = at->second, flat.j = other->second, flat.shift = {l.shift[idx(u)], l.shift[idx(v)]};
      flat.kind = l.kind, flat.gap = l.gap;
      flat.normal_force = l.normal_force, flat.tangential_force = norm(l.tangential_force);
      out.packing.links.push_back(flat);
    }
  return out;
}

}  // namespace isostat
