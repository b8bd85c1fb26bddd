// Soft contacts among the lanes of a batch: few, and their laws are powers, so they are evaluated one by one by the
// scalar law (dem/spheres/soft_contact.hpp), and put into their lanes.
#pragma once
#include "dem/spheres/kernel/pair_force.hpp"
#include "dem/spheres/kernel/row.hpp"

namespace isostat::spheres {

// visit(lane, contact) for every soft contact that touches.
template <class V, class Visit>
ISOSTAT_INLINE void for_soft_lanes(const PairArrays& pairs, std::size_t k, const V& overlap, Visit&& visit) {
  for (std::size_t lane = 0; lane < V::size(); ++lane)
    if (pairs.soft[k + lane] != kNotSoft && overlap[lane] > 0) visit(lane, pairs.soft_contacts[pairs.soft[k + lane]]);
}

// N_e, and what the damping of the pair is multiplied by.
template <class V>
ISOSTAT_INLINE void soft_normal(const PairArrays& pairs, std::size_t k, const V& overlap, V& repulsion, V& damping) {
  for_soft_lanes(pairs, k, overlap, [&](std::size_t lane, const SoftContact& c) {
    const SoftForce f = soft_force(c, overlap[lane]);
    repulsion[lane] = f.force, damping[lane] = std::sqrt(f.stiffness);
  });
}

// k_T, and what is left of the spring where the overlap has become less by `lengthened`.
template <class V>
ISOSTAT_INLINE void soft_tangential(const PairArrays& pairs, std::size_t k, const V& overlap, const V& lengthened,
                                    V& spring, V& softened) {
  for_soft_lanes(pairs, k, overlap, [&](std::size_t lane, const SoftContact& c) {
    const double now = soft_tangential_stiffness(c, overlap[lane]);
    spring[lane] = now, softened[lane] = 1.0;
    if (!(lengthened[lane] > 0)) return;
    const double before = soft_tangential_stiffness(c, overlap[lane] + lengthened[lane]);
    softened[lane] = before > 0 ? now / before : 0.0;
  });
}

}  // namespace isostat::spheres
