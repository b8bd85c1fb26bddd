// Geometry of a packing as elements of a prime field: the exact image of the doubles, or random values that keep the
// topology (which link joins which bodies through which image, which edges bound an overlap) and forget the positions.
#pragma once
#include <array>
#include <vector>

#include "analysis/link_network.hpp"
#include "analysis/rigidity/prime_field.hpp"
#include "dem/state/packing.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

template <class F>
using FieldVec = std::array<F, 2>;

template <class F>
struct FieldGeometry {
  std::vector<FieldVec<F>> position;
  std::vector<F> radius;
  FieldVec<F> cell{};                              // L1, L2; zero when isolated
  F tilt{};                                        // of the second edge along the first
  std::vector<std::array<FieldVec<F>, 3>> corner;  // of triangles; `position` is then their centroids

  FieldVec<F> offset(const ImageShift<2>& s) const {
    return {F::from_integer(s[0]) * cell[0] + F::from_integer(s[1]) * tilt, F::from_integer(s[1]) * cell[1]};
  }
  FieldVec<F> placed(std::size_t grain, const ImageShift<2>& s) const {
    if (s[0] == 0 && s[1] == 0) return position[grain];
    const auto o = offset(s);
    return {position[grain][0] + o[0], position[grain][1] + o[1]};
  }
  std::array<FieldVec<F>, 3> placed_corners(std::size_t body, const ImageShift<2>& s) const {
    std::array<FieldVec<F>, 3> at = corner[body];
    if (s[0] == 0 && s[1] == 0) return at;
    const auto o = offset(s);
    for (auto& c : at) c = {c[0] + o[0], c[1] + o[1]};
    return at;
  }
  void set_centroids() {
    const F third = F(3).inverse();
    for (std::size_t k = 0; k < corner.size(); ++k)
      for (std::size_t d = 0; d < 2; ++d)
        position[k][d] = third * (corner[k][0][d] + corner[k][1][d] + corner[k][2][d]);
  }
  FieldVec<F> branch(const Link<2>& link) const {
    const auto a = position[idx(link.i)], b = placed(idx(link.j), link.shift);
    return {b[0] - a[0], b[1] - a[1]};
  }
  // The radii that divide a link, up to a common factor: a beam's are equal (dem/state/link_ends.hpp).
  std::array<F, 2> radii(const Link<2>& link) const {
    if (link.kind == LinkKind::beam) return {F(1), F(1)};
    return {radius[idx(link.i)], radius[idx(link.j)]};
  }
};

template <class F>
FieldGeometry<F> exact_geometry(const LinkNetwork& network) {
  const Packing<2>& packing = network.packing;
  FieldGeometry<F> g;
  g.position.reserve(packing.bodies.size());
  g.radius.reserve(packing.bodies.size());
  for (const Vec2& r : packing.bodies.position) g.position.push_back({F::from_double(r[0]), F::from_double(r[1])});
  for (double r : packing.bodies.radius) g.radius.push_back(F::from_double(r));
  if (packing.cell) g.cell = {F::from_double(packing.cell->length[0]), F::from_double(packing.cell->length[1])};
  if (packing.cell) g.tilt = F::from_double(packing.cell->tilt);
  for (const Triangle& t : network.corners) {
    auto& at = g.corner.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) at[c] = {F::from_double(t.corner[c][0]), F::from_double(t.corner[c][1])};
  }
  g.set_centroids();
  return g;
}

// A generic packing of the same topology: its rank is at least that of any special geometry, the actual one included.
template <class F>
FieldGeometry<F> random_geometry(const LinkNetwork& network, std::uint64_t seed) {
  const Packing<2>& packing = network.packing;
  FieldGeometry<F> g;
  std::uint64_t draw = 0;
  for (std::size_t i = 0; i < packing.bodies.size(); ++i) {
    g.position.push_back({F::random(seed, draw), F::random(seed, draw + 1)});
    g.radius.push_back(F::random(seed, draw + 2));
    draw += 3;
  }
  if (packing.cell) g.cell = {F::random(seed, draw), F::random(seed, draw + 1)};
  draw += 2;
  for (std::size_t k = 0; k < network.corners.size(); ++k) {
    auto& at = g.corner.emplace_back();
    for (auto& c : at) c = {F::random(seed, draw), F::random(seed, draw + 1)}, draw += 2;
  }
  if (packing.cell && packing.cell->tilt != 0) g.tilt = F::random(seed, draw);
  g.set_centroids();
  return g;
}

}  // namespace isostat
