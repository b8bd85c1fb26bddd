// What is left of G after contraction: rows between rigid bodies, with entries in a prime field.
//
// Unknowns of a body: the velocity field V + W z x of its frame at the origin, in absolute (not peculiar) velocities,
// so that the image by S of a body moves with V - e S L and the strain rates e appear only in rows through an image.
// Rows are scaled by |r_ij| (R_i + R_j): with proportional lever arms every entry is then a rational function of the
// data without square roots. Neither changes a rank or a null space's dimension.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "analysis/rigidity/field_geometry.hpp"
#include "analysis/rigidity/link_rows.hpp"
#include "analysis/rigidity/rigid_bodies.hpp"

namespace isostat {

template <class F>
struct BodyRow {
  std::int32_t a = 0, b = 0;        // bodies; a == b: a body and its own image, all entries in at_a
  std::array<F, 3> at_a{}, at_b{};  // of Vx, Vy, W (points: W unused)
  std::array<F, 2> at_strain{};
  std::int32_t link = 0;      // index into Packing::links
  std::int8_t component = 0;  // 0 normal, 1 tangential, 2 moment
};

// Rows of one packing between its rigid bodies, in the order of G; rows inside a body are left out.
template <class F>
std::vector<BodyRow<F>> body_rows(const Packing<2>& packing, NetworkLaw law, bool cell_free, const RigidBodies& bodies,
                                  const FieldGeometry<F>& geometry);

// Bodies whose rows, at the time of removal, are independent on the columns of that body alone: they and their rows go,
// the rank drops by the number of those rows. Dangling ends and chains of them vanish this way. Proved in the field:
// a nonzero minor stays nonzero over the rationals.
struct PrunedBody {
  std::int32_t body = 0, count = 0;
  std::array<std::int32_t, 3> rows{};  // indices of the rows that went with it
};
struct PrunedNetwork {
  std::vector<std::int32_t> rows;    // indices of the rows that remain
  std::vector<std::int32_t> bodies;  // bodies that remain, ascending, including those without rows
  std::vector<PrunedBody> pruned;    // in the order of removal
  std::int64_t pruned_rank = 0;      // number of rows removed
};
template <class F>
PrunedNetwork prune(const std::vector<BodyRow<F>>& rows, std::int32_t body_count, int dofs);

}  // namespace isostat
