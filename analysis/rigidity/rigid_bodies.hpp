// Exact contraction of grains into rigid bodies, before any linear algebra:
//
//   a link with N, T and M rows (a contact with rolling resistance, a beam) glues its two grains;
//   a contact with N and T rows pins them at the contact point (no relative velocity there). Two bodies that share two
//   distinct pins are one rigid body, and so are three bodies pinned pairwise at points that are not on a line.
//
// Each rule is a theorem about null G, with or without strain dofs, as long as the pins concern the same images; image
// shifts are carried along. Distinct and non-collinear are decided in a prime field: residues that differ prove it.
// (Residues that agree by bad luck only leave work to the elimination that follows.)
#pragma once
#include <cstdint>
#include <vector>

#include "analysis/input.hpp"
#include "dem/state/packing.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

template <int D>
struct RigidBodiesOf {
  static constexpr std::int32_t held = -1;  // the number of all bodies with a grain that is held: without dofs
  std::vector<std::int32_t> body_of;        // grain -> body, bodies numbered 0.. by their first grain
  std::vector<ImageShift<D>> placement;     // grain -> image a_i: x_i = r_i + a_i L lies in the frame of its body
  std::int32_t count = 0;

  bool same(const Link<D>& link) const { return body_of[idx(link.i)] == body_of[idx(link.j)]; }
  // Image of the body of j that a link i -> j (shift s) is about, seen from the body of i.
  ImageShift<D> image(std::int32_t i, std::int32_t j, ImageShift<D> shift) const {
    const auto &a = placement[idx(i)], &b = placement[idx(j)];
    for (std::size_t k = 0; k < D; ++k) shift[k] += a[k] - b[k];
    return shift;
  }
  ImageShift<D> image(const Link<D>& link) const { return image(link.i, link.j, link.shift); }
};
using RigidBodies = RigidBodiesOf<2>;

// Frictionless networks have no pins: without beams every grain stays its own body. Overlaps neither glue nor pin.
RigidBodies contract_rigid_bodies(const LinkNetwork& network, NetworkLaw law);

}  // namespace isostat
