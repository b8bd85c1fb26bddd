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
#include "analysis/rigidity/rigid_bodies.hpp"
#include "analysis/rigidity/rows.hpp"

namespace isostat {

// Rows of one packing between its rigid bodies, in the order of G; rows inside a body, and blocks of held ones, are
// left out. A body and its own image make one block; a row through an image has one of the strain (body number
// bodies.count) if the cell is free.
template <class F>
Rows<F> body_rows(const LinkNetwork& network, NetworkLaw law, bool cell_free, const RigidBodies& bodies,
                  const FieldGeometry<F>& geometry);

// Bodies whose rows, at the time of removal, are independent on the columns of that body alone: they and their rows go,
// the rank drops by the number of those rows. Dangling ends and chains of them vanish this way. Proved in the field:
// a nonzero minor stays nonzero over the rationals.
template <int Most>
struct PrunedBody {
  std::int32_t body = 0, count = 0;
  std::array<std::int32_t, Most> rows{};  // indices of the rows that went with it
};
template <int Most>
struct PrunedNetwork {
  std::vector<std::int32_t> rows;        // indices of the rows that remain
  std::vector<std::int32_t> bodies;      // bodies that remain, ascending, including those without rows
  std::vector<PrunedBody<Most>> pruned;  // in the order of removal
  std::int64_t pruned_rank = 0;          // number of rows removed
};
template <class F, int Most>
PrunedNetwork<Most> prune(const Rows<F, Most>& rows, std::int32_t body_count, int dofs);

}  // namespace isostat
