// `lab cluster double-triangle`: the hyperstatic cluster of Gilabert 2007, Figs. 13 and 18.
//
// Disks 0, 1, 2 of radius a/2 form a triangle at rest with every h = -h0; 0 and 1 are its base. Disk 3 arrives below
// the base, on the other side of disk 2, and a fifth contact closes. Contacts 0-3 and 1-3 are C1, C2 of Fig. 18.
#pragma once
#include <optional>

#include "dem/disks/disks.hpp"
#include "dem/scene/scene.hpp"

namespace isostat::lab {

struct ClusterSetup {
  LawScene law;  // default: kappa 1e5, mu .5, zeta .8, K_T = K_N, no rolling
  double step_fraction = 0.01;
  std::optional<double> approach;  // [V*] speed of disk 3 towards the base; none: it rests, touching disk 0 with
                                   // h = -h0, at a gap just inside D0 of disk 1
  double impact_parameter = 0;     // [a] offset of disk 3's path from the axis of the base, towards disk 1
  double max_time = 2000;          // [T0]
};
ClusterSetup default_cluster_setup();

struct ClusterResult {
  State<Disks> state;    // links: the contacts
  bool at_rest = false;  // residual forces below 1e-6 F0 and kinetic energy below 1e-12 F0 a
  double residual = 0;   // [F0]
  std::size_t contacts = 0;
  // In the closed double triangle; NaN otherwise.
  double outer_normal = 0;      // [F0] mean N of 0-3 and 1-3
  double common_normal = 0;     // [F0] N of 0-1
  double outer_tangential = 0;  // [F0] mean |T| of the four outer contacts
};
ClusterResult double_triangle(const ClusterSetup& setup);

}  // namespace isostat::lab
