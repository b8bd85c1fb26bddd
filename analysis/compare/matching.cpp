#include "analysis/compare/matching.hpp"

#include <cmath>
#include <unordered_map>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

template <int D>
bool is_grain(const Packing<D>& packing, std::size_t body) {
  return body < packing.grains() && is_free(packing.part, body);
}

template <int D>
Vec<D> displacement(const Packing<D>& before, const Packing<D>& after, std::size_t i, std::size_t j) {
  const Vec<D>& from = before.bodies.position[i];
  const Vec<D>& to = after.bodies.position[j];
  if (!before.cell || !after.cell) return to - from;
  const PeriodicCell<D> now = followed(*before.cell, *after.cell);
  Vec<D> moved = now.fractions(to) - before.cell->fractions(from);
  for (int k = 0; k < D; ++k) moved[k] -= std::round(moved[k]);
  return now.point(moved);
}

}  // namespace

template <int D>
PeriodicCell<D> followed(const PeriodicCell<D>& before, PeriodicCell<D> after) {
  after.tilt += std::round(before.tilt / before.length[0] - after.tilt / after.length[0]) * after.length[0];
  return after;
}

template <int D>
Matching match_grains(const Packing<D>& before, const Packing<D>& after) {
  std::unordered_map<std::int64_t, std::size_t> place;
  for (std::size_t i = 0; i < before.bodies.size(); ++i)
    if (is_grain(before, i)) place.emplace(before.bodies.id[i], i);
  Matching m;
  m.of_before.assign(before.bodies.size(), -1);
  m.of_after.assign(after.bodies.size(), -1);
  for (std::size_t j = 0; j < after.bodies.size(); ++j) {
    const auto found = is_grain(after, j) ? place.find(after.bodies.id[j]) : place.end();
    if (found == place.end()) continue;
    m.of_before[found->second] = m.of_after[j] = static_cast<std::int32_t>(m.size());
    m.before.push_back(found->second);
    m.after.push_back(j);
  }
  return m;
}

template <int D>
std::vector<Vec<D>> nonaffine_displacements(const Packing<D>& before, const Packing<D>& after, const Matching& grains) {
  std::vector<Vec<D>> u(grains.size());
  Vec<D> mean{};
  for (std::size_t g = 0; g < grains.size(); ++g) {
    u[g] = displacement(before, after, grains.before[g], grains.after[g]);
    mean += u[g];
  }
  for (Vec<D>& one : u) one -= mean / static_cast<double>(grains.size());
  return u;
}

template PeriodicCell<2> followed(const PeriodicCell<2>&, PeriodicCell<2>);
template PeriodicCell<3> followed(const PeriodicCell<3>&, PeriodicCell<3>);
template Matching match_grains(const Packing<2>&, const Packing<2>&);
template Matching match_grains(const Packing<3>&, const Packing<3>&);
template std::vector<Vec2> nonaffine_displacements(const Packing<2>&, const Packing<2>&, const Matching&);
template std::vector<Vec3> nonaffine_displacements(const Packing<3>&, const Packing<3>&, const Matching&);

}  // namespace isostat
