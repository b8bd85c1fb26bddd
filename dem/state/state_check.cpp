#include "dem/state/state_check.hpp"

#include <algorithm>
#include <cmath>

namespace isostat {
using namespace state_check;
namespace {

using Broken = std::optional<StateFault>;

template <int D>
Broken check_links(const Packing<D>& packing) {
  for (std::size_t k = 0; k < packing.links.size(); ++k) {
    const Link<D>& l = packing.links[k];
    const std::string which = "link " + std::to_string(k);
    if (!names_two_bodies(l, packing.bodies.size())) return StateFault{"links/i", which + " does not join two grains"};
    if (!packing.cell && l.shift != ImageShift<D>{})
      return StateFault{"links/shift", which + " crosses a cell that is not there"};
    if (l.kind > LinkKind::beam) return StateFault{"links/kind", which + " has an unknown kind"};
    if (l.kind == LinkKind::beam && (l.beam < 0 || static_cast<std::size_t>(l.beam) >= packing.beams.size()))
      return StateFault{"links/beam", which + " names a beam that is not there"};
    if (!finite(l.gap) || !finite(l.normal_force) || !finite(l.tangential_force) || !finite(l.moment))
      return StateFault{"links", which + " has a gap, force or moment that is not a finite number"};
  }
  return std::nullopt;
}

// They stand last and are held.
template <int D>
Broken feet_fault(const Packing<D>& packing) {
  const std::size_t n = packing.bodies.size();
  if (packing.feet.empty()) return std::nullopt;
  if (packing.feet.size() > n || packing.part.size() != n)
    return StateFault{"feet", "are more than the bodies of walls"};
  for (std::size_t k = packing.grains(); k < n; ++k)
    if (is_free(packing.part, k)) return StateFault{"feet", "one is no part of a wall"};
  for (const Foot& foot : packing.feet)
    if (foot.wall < 0 || !finite(foot.turning)) return StateFault{"feet", "a wall or turning that cannot be"};
  return std::nullopt;
}

}  // namespace

template <int D>
std::optional<StateFault> bodies_fault(const Bodies<D>& b, const std::string& group, std::size_t points) {
  const std::size_t n = b.size();
  for (const std::size_t size :
       {b.position.size(), b.velocity.size(), b.spin.size(), b.radius.size(), b.mass.size(), b.inertia.size()})
    if (size != n) return StateFault{group, "arrays of different lengths"};
  std::vector<std::int64_t> ids = b.id;
  std::sort(ids.begin(), ids.end());
  if (const auto twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end())
    return StateFault{group + "/id", std::to_string(*twice) + " occurs twice"};
  if (auto f = check_values(b.position, group + "/position")) return f;
  if (auto f = check_values(b.velocity, group + "/velocity")) return f;
  if (auto f = check_values(b.spin, group + "/spin")) return f;
  if (auto f = check_values(b.radius, group + "/radius", true, points)) return f;
  if (auto f = check_values(b.mass, group + "/mass", true, points)) return f;
  if (auto f = check_values(b.inertia, group + "/inertia", true, points)) return f;
  return std::nullopt;
}

template <int D>
std::optional<StateFault> cell_fault(const std::optional<PeriodicCell<D>>& cell, const std::string& group) {
  if (!cell) return std::nullopt;
  for (int k = 0; k < D; ++k)
    if (!(cell->length[k] > 0) || !std::isfinite(cell->length[k]))
      return StateFault{group + "/box/edges", "an edge is not positive and finite"};
  if (!std::isfinite(cell->tilt)) return StateFault{group + "/box/tilt", "is not a finite number"};
  return std::nullopt;
}

template <int D>
std::optional<StateFault> packing_fault(const Packing<D>& packing) {
  const std::string group = "particles/grains";
  if (auto f = feet_fault(packing)) return f;
  if (auto f = bodies_fault(packing.bodies, group, packing.feet.size())) return f;
  if (auto f = cell_fault(packing.cell, group)) return f;
  if (!packing.part.empty() && packing.part.size() != packing.bodies.size())
    return StateFault{group + "/part", "neither one element a grain nor none"};
  for (const GrainPart part : packing.part)
    if (part > GrainPart::lid) return StateFault{group + "/part", "a part that is neither free, wall nor lid"};
  return check_links(packing);
}
template std::optional<StateFault> bodies_fault(const Bodies<2>&, const std::string&, std::size_t);
template std::optional<StateFault> cell_fault(const std::optional<PeriodicCell<2>>&, const std::string&);
template std::optional<StateFault> packing_fault(const Packing<2>&);
template std::optional<StateFault> packing_fault(const Packing<3>&);

}  // namespace isostat
