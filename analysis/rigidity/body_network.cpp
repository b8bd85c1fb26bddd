#include "analysis/rigidity/body_network.hpp"

#include <algorithm>

#include "analysis/rigidity/area_rows.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

namespace {

// Links that join two bodies, or a body and another image of it; and how much room their rows take.
struct OuterLinks {
  std::vector<std::int32_t> link;
  std::size_t rows = 0, blocks = 0;  // at most
};
OuterLinks outer_links(const LinkNetwork& network, NetworkLaw law, bool cell_free, const RigidBodies& bodies) {
  const Packing<2>& packing = network.packing;
  OuterLinks outer;
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const Link<2>& link = packing.links[l];
    if (bodies.same(link) && bodies.image(link) == ImageShift<2>{}) continue;
    outer.link.push_back(static_cast<std::int32_t>(l));
    const auto rows = idx(rows_of(link.kind, law).count());
    outer.rows += rows, outer.blocks += (cell_free && bodies.image(link) != ImageShift<2>{} ? 3 : 2) * rows;
  }
  return outer;
}

template <class F>
F cross(const FieldVec<F>& a, const FieldVec<F>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

// The row of an overlap: the image by s of triangle k, which stands in image a_k in the frame of its body, moves with
// the frame at x_k and by -e (s - a_k) L. Left out if all of it lies inside one body.
template <class F>
void area_row(Rows<F>& rows, std::size_t link, RowKind kind, const LinkNetwork& network, bool cell_free,
              const RigidBodies& bodies, const FieldGeometry<F>& geometry) {
  const auto measure = [&](const AreaPair& pair) {
    const auto b = geometry.placed_corners(idx(pair.j), pair.shift);
    return pair_area<F>(pair.boundary, geometry.corner[idx(pair.i)], b, geometry.position[idx(pair.i)],
                        geometry.placed(idx(pair.j), pair.shift));
  };
  const auto loads =
      area_loads<F>(network.area(link), kind == RowKind::tangential, measure,
                    [&](std::int32_t body, const ImageShift<2>& s) { return geometry.placed(idx(body), s); });
  std::vector<RowBlock<F>> blocks;
  std::array<F, 2> strain{};
  ImageShift<2> first{};
  bool several_bodies = false, several_images = false;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const auto& [triangle, shift, at] = loads[k];
    const std::int32_t body = bodies.body_of[idx(triangle)];
    const ImageShift<2>& own = bodies.placement[idx(triangle)];
    const ImageShift<2> image{shift[0] - own[0], shift[1] - own[1]};
    if (k == 0) first = image;
    several_bodies = several_bodies || body != bodies.body_of[idx(loads[0].body)];
    several_images = several_images || image != first;
    const FieldVec<F> x = geometry.placed(idx(triangle), own), back = geometry.offset(image), force{at[0], at[1]};
    for (std::size_t d = 0; d < 2; ++d) strain[d] = strain[d] - back[d] * force[d];
    if (body == RigidBodies::held) continue;
    auto block = std::find_if(blocks.begin(), blocks.end(), [&](const auto& b) { return b.body == body; });
    if (block == blocks.end()) block = blocks.insert(blocks.end(), {body, {}});
    block->at = {block->at[0] + at[0], block->at[1] + at[1], block->at[2] + at[2] + cross(x, force)};
  }
  if (!several_bodies && !several_images) return;
  rows.begin_row(static_cast<std::int32_t>(link), kind);
  rows.blocks.insert(rows.blocks.end(), blocks.begin(), blocks.end());
  if (cell_free && several_images) rows.blocks.push_back({bodies.count, {strain[0], strain[1], F{}}});
}

}  // namespace

template <class F>
Rows<F> body_rows(const LinkNetwork& network, NetworkLaw law, bool cell_free, const RigidBodies& bodies,
                  const FieldGeometry<F>& geometry) {
  const Packing<2>& packing = network.packing;
  Rows<F> rows;
  const OuterLinks outer = outer_links(network, law, cell_free, bodies);
  rows.rows.reserve(outer.rows), rows.blocks.reserve(outer.blocks);
  const bool spins = dof_layout(network, law, cell_free).per_body == 3;
  for (const std::int32_t l : outer.link) {
    const Link<2>& link = packing.links[idx(l)];
    const auto i = idx(link.i), j = idx(link.j);
    const ImageShift<2> image = bodies.image(link);
    const bool own = bodies.same(link), through_image = image != ImageShift<2>{};

    const LinkRows kept = rows_of(link.kind, law);
    const std::array<F, 2> radii = geometry.radii(link);
    const FieldVec<F> r = geometry.branch(link), back = geometry.offset(image);
    const FieldVec<F> x_i = geometry.placed(i, bodies.placement[i]), x_j = geometry.placed(j, bodies.placement[j]);
    for (const RowKind kind : kRowKinds) {
      if (!kept[kind] || (own && kind == RowKind::rolling)) continue;  // a body and its image turn alike
      const LinkLoad<F> load = rational_load(kind, r, radii[0], radii[1]);
      const FieldVec<F> force = {load.fx, load.fy};
      // Moments about the origins of the two frames, from those about the centres.
      RowBlock<F> on_i{bodies.body_of[i], {-force[0], -force[1], F{}}},
          on_j{bodies.body_of[j], {force[0], force[1], F{}}};
      if (spins) on_i.at[2] = load.moment_i - cross(x_i, force), on_j.at[2] = load.moment_j + cross(x_j, force);
      rows.begin_row(l, kind);
      if (own) {
        for (std::size_t d = 0; d < 3; ++d) on_i.at[d] = on_i.at[d] + on_j.at[d];
        rows.blocks.push_back(on_i);
      } else {
        for (const auto& block : {on_i, on_j})
          if (block.body != RigidBodies::held) rows.blocks.push_back(block);
      }
      if (cell_free && through_image && kind != RowKind::rolling)  // the image moves with V - e back
        rows.blocks.push_back({bodies.count, {-(back[0] * force[0]), -(back[1] * force[1]), F{}}});
    }
  }
  for (std::size_t a = 0; a < network.areas.size(); ++a)
    for (const RowKind kind : kRowKinds)
      if (rows_of_area(law)[kind]) area_row(rows, packing.links.size() + a, kind, network, cell_free, bodies, geometry);
  return rows;
}

namespace {

// Rank of up to `dofs` vectors of `dofs` entries, by elimination.
template <class F, std::size_t Most>
bool independent(std::array<std::array<F, Most>, Most> v, int count, int dofs) {
  const auto n = idx(dofs), m = idx(count);
  if (m > n) return false;
  for (std::size_t k = 0; k < m; ++k) {
    std::size_t c = 0;
    while (c < n && v[k][c].is_zero()) ++c;
    if (c == n) return false;
    for (std::size_t other = k + 1; other < m; ++other) {
      const F factor = v[other][c], pivot = v[k][c];  // fraction-free: v_o <- pivot v_o - factor v_k
      for (std::size_t d = 0; d < n; ++d) v[other][d] = pivot * v[other][d] - factor * v[k][d];
    }
  }
  return true;
}

}  // namespace

template <class F, int Most>
PrunedNetwork<Most> prune(const Rows<F, Most>& rows, std::int32_t body_count, int dofs) {
  const auto n = idx(body_count);
  std::vector<std::int32_t> degree(n, 0);
  for (const auto& block : rows.blocks)
    if (block.body < body_count) ++degree[idx(block.body)];
  std::vector<std::int32_t> start(n + 1, 0);
  for (std::size_t b = 0; b < n; ++b) start[b + 1] = start[b] + degree[b];
  std::vector<std::int32_t> incident(idx(start[n]));
  {
    std::vector<std::int32_t> next(start.begin(), start.end() - 1);
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (const auto& block : rows.of(r))
        if (block.body < body_count) incident[idx(next[idx(block.body)]++)] = static_cast<std::int32_t>(r);
  }

  PrunedNetwork<Most> result;
  std::vector<char> row_gone(rows.size(), 0), body_gone(n, 0);
  std::vector<std::int32_t> queue;
  for (std::size_t b = n; b-- > 0;)
    if (degree[b] > 0 && degree[b] <= dofs) queue.push_back(static_cast<std::int32_t>(b));
  while (!queue.empty()) {
    const std::int32_t body = queue.back();
    const auto b = idx(body);
    queue.pop_back();
    if (body_gone[b] || degree[b] == 0 || degree[b] > dofs) continue;
    std::array<std::array<F, Most>, Most> entries{};
    std::array<std::int32_t, Most> mine{};
    int count = 0;
    for (std::int32_t e = start[b]; e < start[b + 1]; ++e) {
      const std::int32_t r = incident[idx(e)];
      if (row_gone[idx(r)]) continue;
      mine[idx(count)] = r;
      entries[idx(count++)] = rows.at(idx(r), body);
    }
    if (!independent(entries, count, dofs)) continue;
    body_gone[b] = 1;
    result.pruned.push_back({body, count, mine});
    result.pruned_rank += count;
    for (int k = 0; k < count; ++k) {
      const auto r = idx(mine[idx(k)]);
      row_gone[r] = 1;
      for (const auto& block : rows.of(r)) {
        if (block.body == body || block.body >= body_count) continue;
        if (--degree[idx(block.body)] <= dofs) queue.push_back(block.body);
      }
    }
  }
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (!row_gone[r]) result.rows.push_back(static_cast<std::int32_t>(r));
  for (std::size_t b = 0; b < n; ++b)
    if (!body_gone[b]) result.bodies.push_back(static_cast<std::int32_t>(b));
  return result;
}

template Rows<FirstField> body_rows(const LinkNetwork&, NetworkLaw, bool, const RigidBodies&,
                                    const FieldGeometry<FirstField>&);
template Rows<SecondField> body_rows(const LinkNetwork&, NetworkLaw, bool, const RigidBodies&,
                                     const FieldGeometry<SecondField>&);
template Rows<WideField> body_rows(const LinkNetwork&, NetworkLaw, bool, const RigidBodies&,
                                   const FieldGeometry<WideField>&);
template PrunedNetwork<3> prune(const Rows<FirstField>&, std::int32_t, int);
template PrunedNetwork<3> prune(const Rows<WideField>&, std::int32_t, int);
template PrunedNetwork<6> prune(const Rows<FirstField, 6>&, std::int32_t, int);
template PrunedNetwork<6> prune(const Rows<WideField, 6>&, std::int32_t, int);

}  // namespace isostat
