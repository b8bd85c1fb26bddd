#include "dem/state/balance_3d.hpp"

#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

LinkLoad3<double> load_of(const Packing<3>& packing, const Link<3>& link) {
  return link_load(frame(ends(packing, link)), link.normal_force, link.tangential_force.c, link.moment.c);
}

}  // namespace

StressTensor3 measured_stress(const Packing<3>& packing) {
  StressTensor3 s{};
  const Bodies<3>& b = packing.bodies;
  for (std::size_t k = 0; k < b.size(); ++k)
    for (std::size_t a = 0; a < 3; ++a) s[a] += b.mass[k] * b.velocity[k][static_cast<int>(a)] * b.velocity[k];
  for (const Link<3>& link : packing.links) {
    const Vec3 r = ends(packing, link).branch;
    const LinkLoad3<double> load = load_of(packing, link);
    for (std::size_t a = 0; a < 3; ++a) s[a] += load.force[a] * r;
  }
  const double volume = packing.cell.value().measure();
  for (Vec3& row : s) row = (1 / volume) * row;
  return s;
}

std::vector<BodyLoad3> net_loads(const Packing<3>& packing) {
  std::vector<BodyLoad3> loads(packing.bodies.size());
  for (const Link<3>& link : packing.links) {
    const LinkLoad3<double> load = load_of(packing, link);
    BodyLoad3 &on_i = loads[idx(link.i)], &on_j = loads[idx(link.j)];
    on_i.force -= Vec3{load.force}, on_i.moment += Vec3{load.moment_i}, ++on_i.links;
    on_j.force += Vec3{load.force}, on_j.moment += Vec3{load.moment_j}, ++on_j.links;
  }
  return loads;
}

}  // namespace isostat
