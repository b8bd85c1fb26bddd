#include "dem/state/balance_3d.hpp"

#include "dem/state/link_3d.hpp"
#include "dem/state/link_ends.hpp"

namespace isostat {
namespace {

LinkLoad3<double> load_of(const LinkEnds<3>& e, const Link<3>& link) {
  return link_load(link_frame(e.branch.c, e.radius_i, e.radius_j), link.normal_force, link.tangential_force.c,
                   link.moment.c);
}

}  // namespace

StressTensor3 measured_stress(const Packing<3>& packing) {
  StressTensor3 sum{};
  const Bodies<3>& b = packing.bodies;
  for (std::size_t k = 0; k < b.size(); ++k)
    for (std::size_t a = 0; a < 3; ++a) sum[a] += (b.mass[k] * b.velocity[k].c[a]) * b.velocity[k];
  for (const Link<3>& link : packing.links) {
    const LinkEnds<3> e = ends(packing, link);
    const LinkLoad3<double> load = load_of(e, link);
    for (std::size_t a = 0; a < 3; ++a) sum[a] += load.force[a] * e.branch;
  }
  for (Vec3& row : sum) row = (1 / packing.cell.value().measure()) * row;
  return sum;
}

std::vector<BodyLoad3> net_loads(const Packing<3>& packing) {
  std::vector<BodyLoad3> loads(packing.bodies.size());
  for (const Link<3>& link : packing.links) {
    const LinkLoad3<double> load = load_of(ends(packing, link), link);
    BodyLoad3& on_i = loads[static_cast<std::size_t>(link.i)];
    BodyLoad3& on_j = loads[static_cast<std::size_t>(link.j)];
    on_i.force -= Vec3{load.force}, on_i.moment += Vec3{load.moment_i}, ++on_i.links;
    on_j.force += Vec3{load.force}, on_j.moment += Vec3{load.moment_j}, ++on_j.links;
  }
  return loads;
}

}  // namespace isostat
