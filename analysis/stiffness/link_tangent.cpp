#include "analysis/stiffness/link_tangent.hpp"

#include <algorithm>

#include "analysis/stiffness/area_tangent.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

namespace {

// The foot of a grain slides along its wall.
double turns_over(const Packing<2>& packing, const Link<2>& link, double distance) {
  const std::size_t last = idx(std::max(link.i, link.j));
  return last < packing.grains() ? distance : 1 / packing.feet[last - packing.grains()].turning;
}

}  // namespace

LinkTangent::Response LinkTangent::operator()(double dx, double dy, double spin_i, double spin_j) const {
  const auto v = link_velocity(f, dx, dy, spin_i, spin_j);
  // A beam keeps T L, a contact T (dem/state/beam.hpp).
  const double release = is_beam ? -tangential * v.normal / f.distance : 0;
  const double dn = -stiffness.normal * v.normal, dt = -stiffness.tangential * v.tangential + release,
               dm = -stiffness.rolling * v.rolling;
  const double tx = -f.ny, ty = f.nx;
  const double turn = (tx * dx + ty * dy) / turns_over;  // of the frame
  const double stretch = v.normal / (radius_i + radius_j);
  return {dn * f.nx + dt * tx + turn * (normal * tx - tangential * f.nx),
          dn * f.ny + dt * ty + turn * (normal * ty - tangential * f.ny),
          -dt * f.lever_i - tangential * stretch * radius_i - dm,
          -dt * f.lever_j - tangential * stretch * radius_j + dm};
}

LinkTangent::Response LinkTangent::to_dof(int d) const {
  const double sign = d < 3 ? -1 : 1;
  return (*this)(d % 3 == 0 ? sign : 0, d % 3 == 1 ? sign : 0, d == 2, d == 5);
}

std::vector<LinkTangent> link_tangents(const LinkNetwork& network, NetworkLaw network_law, const DiskLaw& law) {
  const Packing<2>& packing = network.packing;
  std::vector<LinkTangent> tangents;
  tangents.reserve(packing.links.size());
  for (const Link<2>& link : packing.links) {
    const LinkEnds<2> at = ends(packing, link);
    const LinkFrame<double> f = frame(at);
    tangents.push_back({f, at.branch, at.radius_i, at.radius_j, link.normal_force, link.tangential_force, link.moment,
                        link.kind == LinkKind::beam, turns_over(packing, link, f.distance)});
  }
  const RigidityMatrix g = rigidity_matrix(network, network_law, false);
  const std::vector<double> stiffness = row_stiffness(network, g, law);
  for (std::size_t r = 0; r < stiffness.size(); ++r)
    if (!network.is_area(idx(g.link_of_row[r]))) tangents[idx(g.link_of_row[r])].stiffness[g.kind[r]] = stiffness[r];
  return tangents;
}

UnsymmetricMatrix tangent_stiffness(const LinkNetwork& network, NetworkLaw network_law, const DiskLaw& law) {
  const Packing<2>& packing = network.packing;
  const DofLayout layout = dof_layout(network, network_law, false);
  const std::vector<LinkTangent> tangents = link_tangents(network, network_law, law);
  Triplets entries;
  for (std::size_t l = 0; l < tangents.size(); ++l) {
    const auto dof = [&](int d) {  // -1: no spin, or held
      const std::int32_t body = d < 3 ? packing.links[l].i : packing.links[l].j;
      return d % 3 < layout.per_body && network.is_free(body)
                 ? body * static_cast<std::int32_t>(layout.per_body) + d % 3
                 : -1;
    };
    for (int c = 0; c < 6; ++c) {
      if (dof(c) < 0) continue;
      const std::array<double, 6> column = LinkTangent::resistance(tangents[l].to_dof(c));
      for (int r = 0; r < 6; ++r)
        if (dof(r) >= 0) entries.add(dof(r), dof(c), column[idx(r)]);
    }
  }
  for (const AreaLink& area : network.areas) {
    const AreaTangent t = area_tangent(network, area);
    for (std::size_t r = 0; r < t.size(); ++r)
      for (std::size_t c = 0; c < t.size(); ++c) {
        const std::int32_t row = t.place[r / 3].body, column = t.place[c / 3].body;
        if (network.is_free(row) && network.is_free(column))
          entries.add(3 * row + static_cast<std::int32_t>(r % 3), 3 * column + static_cast<std::int32_t>(c % 3),
                      t.resistance[r * t.size() + c]);
      }
  }
  return assemble(static_cast<std::int32_t>(layout.size()), entries);
}

}  // namespace isostat
