#include "analysis/rigidity/sphere_rows.hpp"

namespace isostat {

template <class F>
SphereGeometry<F> exact_geometry(const SphereNetwork& network) {
  const Packing<3>& packing = network.packing;
  const auto image = [](const Vec3& r) {
    return Real3<F>{F::from_double(r[0]), F::from_double(r[1]), F::from_double(r[2])};
  };
  SphereGeometry<F> g;
  g.position.reserve(packing.bodies.size()), g.radius.reserve(packing.bodies.size());
  for (const Vec3& r : packing.bodies.position) g.position.push_back(image(r));
  for (const double r : packing.bodies.radius) g.radius.push_back(F::from_double(r));
  if (packing.cell) g.cell = image(packing.cell->length), g.tilt = F::from_double(packing.cell->tilt);
  return g;
}

template <class F>
SphereGeometry<F> random_geometry(const SphereNetwork& network, std::uint64_t seed) {
  SphereGeometry<F> g;
  std::uint64_t draw = 0;
  const auto next = [&] { return F::random(seed, draw++); };
  const auto point = [&] {
    Real3<F> p;
    for (F& x : p) x = next();
    return p;
  };
  for (std::size_t i = 0; i < network.packing.bodies.size(); ++i)
    g.position.push_back(point()), g.radius.push_back(next());
  if (network.packing.cell) g.cell = point();
  if (network.packing.cell && network.packing.cell->tilt != 0) g.tilt = next();
  return g;
}

template <class F>
SphereRowList<F> body_rows(const SphereNetwork& network, NetworkLaw law, bool cell_free, const RigidBodiesOf<3>& bodies,
                           const SphereGeometry<F>& geometry) {
  SphereRowList<F> rows;
  const bool spins = dof_layout(network, law, cell_free).per_body == kSphereDofs;
  const auto outer = [&](const Link<3>& link) {
    return !bodies.same(link) || (bodies.body_of[idx(link.i)] != bodies.held && bodies.image(link) != ImageShift<3>{});
  };
  std::size_t row_total = 0, block_total = 0;
  for (const Link<3>& link : network.packing.links) {
    if (!outer(link)) continue;
    const auto count = static_cast<std::size_t>(sphere_rows(link.kind, law).count());
    row_total += count;
    block_total += (cell_free && bodies.image(link) != ImageShift<3>{} ? 3 : 2) * count;
  }
  rows.rows.reserve(row_total), rows.blocks.reserve(block_total);

  for (std::size_t l = 0; l < network.links(); ++l) {
    const Link<3>& link = network.packing.links[l];
    if (!outer(link)) continue;
    const auto i = idx(link.i), j = idx(link.j);
    const ImageShift<3> image = bodies.image(link);
    const bool own = bodies.same(link);
    const Real3<F> r = geometry.branch(link), back = geometry.offset(image);
    const Real3<F> x_i = geometry.placed(i, bodies.placement[i]), x_j = geometry.placed(j, bodies.placement[j]);
    const SphereRows kept = sphere_rows(link.kind, law);
    for (int k = 0; k < kept.count(); ++k) {
      const SphereRow row = kept.at(k);
      if (own && row.kind == RowKind::rolling) continue;  // a body and its image turn alike
      const LinkLoad3<F> load = rational_load<F>(row, r, geometry.radius[i], geometry.radius[j]);
      PairBlocks<F> on = pair_blocks<F>(load, x_i, x_j, spins);
      rows.begin_row(static_cast<std::int32_t>(l), row.kind, row.axis);
      if (own) {
        for (std::size_t d = 0; d < kSphereDofs; ++d) on.i[d] = on.i[d] + on.j[d];
        rows.blocks.push_back({bodies.body_of[i], on.i});
      } else {
        if (bodies.body_of[i] != bodies.held) rows.blocks.push_back({bodies.body_of[i], on.i});
        if (bodies.body_of[j] != bodies.held) rows.blocks.push_back({bodies.body_of[j], on.j});
      }
      if (cell_free && image != ImageShift<3>{} && row.kind != RowKind::rolling) {  // the image moves with V - e back
        SphereBlock<F> strain{bodies.count, {}};
        for (std::size_t d = 0; d < 3; ++d) strain.at[d] = -(back[d] * load.force[d]);
        rows.blocks.push_back(strain);
      }
    }
  }
  return rows;
}

#define ISOSTAT_SPHERE_ROWS(F)                                                                         \
  template SphereGeometry<F> exact_geometry(const SphereNetwork&);                                     \
  template SphereGeometry<F> random_geometry(const SphereNetwork&, std::uint64_t);                     \
  template SphereRowList<F> body_rows(const SphereNetwork&, NetworkLaw, bool, const RigidBodiesOf<3>&, \
                                      const SphereGeometry<F>&);
ISOSTAT_SPHERE_ROWS(FirstField)
ISOSTAT_SPHERE_ROWS(SecondField)
ISOSTAT_SPHERE_ROWS(WideField)
#undef ISOSTAT_SPHERE_ROWS

}  // namespace isostat
