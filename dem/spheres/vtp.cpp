#include "dem/spheres/vtp.hpp"

#include "dem/files/formats/vtp.hpp"
#include "dem/spheres/wall_foot.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

std::string vtk_polydata(const SpherePacking& packing, double time) {
  VtkExtras<3> extras;
  extras.group = packing.group;
  extras.group.resize(packing.bodies.size());  // without any, all are in group 0
  for (const WallLink& w : packing.wall_links) {
    const Vec3 centre = packing.bodies.position[idx(w.body)];
    Link<3> link;
    link.i = w.body, link.kind = w.kind, link.gap = w.gap;
    link.normal_force = w.normal_force, link.tangential_force = w.tangential_force;
    extras.feet.push_back({link, foot_on(packing.walls[idx(w.wall)], centre) - centre});
  }
  return vtk_polydata(static_cast<const Packing<3>&>(packing), time, extras);
}

}  // namespace isostat
