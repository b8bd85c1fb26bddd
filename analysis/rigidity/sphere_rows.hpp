// Geometry of spheres in a prime field, the exact image of the doubles or random values on the same topology, and the
// rows of their links: the twins of field_geometry.hpp and body_network.hpp.
//
// Unknowns of a body: the velocity field V + W x x of its frame at the origin, in absolute velocities, so that its
// image by S moves with V - e S L.
#pragma once
#include <vector>

#include "analysis/rigidity/link_rows_3d.hpp"
#include "analysis/rigidity/prime_field.hpp"
#include "analysis/rigidity/rigid_bodies.hpp"
#include "analysis/rigidity/rows.hpp"

namespace isostat {

inline constexpr int kSphereDofs = 6;
template <class F>
using SphereBlock = RowBlock<F, kSphereDofs>;
template <class F>
using SphereRowList = Rows<F, kSphereDofs>;

template <class F>
Real3<F> sum_3d(const Real3<F>& a, const Real3<F>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class F>
Real3<F> difference_3d(const Real3<F>& a, const Real3<F>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class F>
struct SphereGeometry {
  std::vector<Real3<F>> position;
  std::vector<F> radius;
  Real3<F> cell{};  // L1, L2, L3; zero when isolated
  F tilt{};         // of the second edge along the first

  Real3<F> offset(const ImageShift<3>& s) const {
    Real3<F> o{};
    for (std::size_t k = 0; k < 3; ++k)
      if (s[k] != 0) o[k] = F::from_integer(s[k]) * cell[k];
    if (s[1] != 0) o[0] = o[0] + F::from_integer(s[1]) * tilt;
    return o;
  }
  Real3<F> placed(std::size_t grain, const ImageShift<3>& s) const {
    return s == ImageShift<3>{} ? position[grain] : sum_3d<F>(position[grain], offset(s));
  }
  Real3<F> branch(const Link<3>& link) const {
    return difference_3d<F>(placed(idx(link.j), link.shift), position[idx(link.i)]);
  }
};

template <class F>
SphereGeometry<F> exact_geometry(const SphereNetwork& network);
template <class F>
SphereGeometry<F> random_geometry(const SphereNetwork& network,
                                  std::uint64_t seed);  // generic: rank at least the actual

// What a row asks of the bodies of its two grains, whose centres lie at x_i and x_j: moments about the origin.
template <class F>
struct PairBlocks {
  std::array<F, kSphereDofs> i{}, j{};
};
template <class F>
PairBlocks<F> pair_blocks(const LinkLoad3<F>& load, const Real3<F>& x_i, const Real3<F>& x_j, bool spins) {
  PairBlocks<F> b;
  for (std::size_t k = 0; k < 3; ++k) b.i[k] = -load.force[k], b.j[k] = load.force[k];
  if (!spins) return b;
  const Real3<F> turn_i = cross_3d<F>(x_i, load.force), turn_j = cross_3d<F>(x_j, load.force);
  for (std::size_t k = 0; k < 3; ++k)
    b.i[3 + k] = load.moment_i[k] - turn_i[k], b.j[3 + k] = load.moment_j[k] + turn_j[k];
  return b;
}

// Rows between the rigid bodies, in the order of G, as body_rows() of the plane has them.
template <class F>
SphereRowList<F> body_rows(const SphereNetwork& network, NetworkLaw law, bool cell_free, const RigidBodiesOf<3>& bodies,
                           const SphereGeometry<F>& geometry);

}  // namespace isostat
