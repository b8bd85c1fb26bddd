#include "dem/state/balance.hpp"

#include "dem/state/link_ends.hpp"

namespace isostat {
namespace {

LinkLoad<double> load_of(const LinkFrame<double>& f, const Link<2>& link) {
  return link_load(f, link.normal_force, link.tangential_force, link.moment);
}

}  // namespace

void add_kinetic(StressTensor& s, const Bodies<2>& b) {
  for (std::size_t k = 0; k < b.size(); ++k) {
    const Vec2& v = b.velocity[k];
    s.xx += b.mass[k] * v[0] * v[0], s.xy += b.mass[k] * v[0] * v[1];
    s.yx += b.mass[k] * v[1] * v[0], s.yy += b.mass[k] * v[1] * v[1];
  }
}

void add_virial(StressTensor& s, const Packing<2>& packing) {
  for (const Link<2>& link : packing.links) {
    const LinkFrame<double> f = frame(ends(packing, link));
    const LinkLoad<double> load = load_of(f, link);
    const double rx = f.nx * f.distance, ry = f.ny * f.distance;
    s.xx += load.fx * rx, s.xy += load.fx * ry;
    s.yx += load.fy * rx, s.yy += load.fy * ry;
  }
}

StressTensor measured_stress(const Packing<2>& packing) {
  StressTensor s;
  add_kinetic(s, packing.bodies);
  add_virial(s, packing);
  const double area = packing.cell.value().measure();
  return {s.xx / area, s.xy / area, s.yx / area, s.yy / area};
}

std::vector<BodyLoad> net_loads(const Packing<2>& packing) {
  std::vector<BodyLoad> loads(packing.bodies.size());
  for (const Link<2>& link : packing.links) {
    const LinkLoad<double> load = load_of(frame(ends(packing, link)), link);
    BodyLoad& on_i = loads[static_cast<std::size_t>(link.i)];
    BodyLoad& on_j = loads[static_cast<std::size_t>(link.j)];
    on_i.fx -= load.fx, on_i.fy -= load.fy, on_i.moment += load.moment_i, ++on_i.links;
    on_j.fx += load.fx, on_j.fy += load.fy, on_j.moment += load.moment_j, ++on_j.links;
  }
  return loads;
}

}  // namespace isostat
