// Where a link acts: the branch vector between the centres of its bodies and the two radii that divide it. The only
// place that knows image shifts of links and beams; frames, rows, stresses and files all begin here.
#pragma once
#include <cstddef>
#include <type_traits>

#include "dem/state/link.hpp"
#include "dem/state/link_3d.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

template <int D>
struct LinkEnds {
  Vec<D> branch;              // r_ij = r_j + shift L - r_i [a]
  double radius_i, radius_j;  // [a] R_i, R_j; of a beam half its rest length
};

// The order of the sum, (r_j - r_i) + offset, is part of the bits of certificate, G and files; the step loop and the
// static solves keep theirs, (r_j + offset) - r_i.
template <int D>
Vec<D> branch(const Packing<D>& packing, std::size_t i, std::size_t j,
              const std::type_identity_t<ImageShift<D>>& shift) {
  Vec<D> r = packing.bodies.position[j] - packing.bodies.position[i];
  if (packing.cell) r += packing.cell->offset(shift);
  return r;
}

template <int D>
LinkEnds<D> ends(const Packing<D>& packing, const Link<D>& link) {
  const auto i = static_cast<std::size_t>(link.i), j = static_cast<std::size_t>(link.j);
  const Vec<D> r = branch(packing, i, j, link.shift);
  if (link.kind == LinkKind::beam) {
    const double half = 0.5 * packing.beams[static_cast<std::size_t>(link.beam)].rest_length;
    return {r, half, half};
  }
  return {r, packing.bodies.radius[i], packing.bodies.radius[j]};
}

inline LinkFrame<double> frame(const LinkEnds<2>& e) {
  return link_frame(e.branch[0], e.branch[1], e.radius_i, e.radius_j);
}
inline LinkFrame3<double> frame(const LinkEnds<3>& e) { return link_frame(e.branch.c, e.radius_i, e.radius_j); }

}  // namespace isostat
