#include "dem/disks/lab/cluster.hpp"

#include <cmath>
#include <limits>

#include "dem/disks/certificate.hpp"
#include "dem/disks/lab/few_bodies.hpp"

namespace isostat::lab {
namespace {

constexpr double kResidual = 1e-6;     // [F0]
constexpr double kRestEnergy = 1e-12;  // [F0 a] per grain
constexpr double kJustInside = 1e-3;   // [D0] how far inside the range of attraction the second gap is

}  // namespace

ClusterSetup default_cluster_setup() {
  ClusterSetup s;
  s.law.rolling = false;
  return s;
}

ClusterResult double_triangle(const ClusterSetup& setup) {
  const DiskLaw law = resolve(setup.law);
  const double side = 1 - law.attraction / law.normal_stiffness;  // h = -h0
  std::vector<Disk> disks = {{0, 0}, {side, 0}, {side / 2, side * std::sqrt(0.75)}, {}};
  if (setup.approach) {
    const double v = *setup.approach * std::sqrt(law.attraction * law.attraction_range);
    const double x = side / 2 + setup.impact_parameter;
    const double far = 1 + 2 * law.attraction_range;  // outside every attraction
    const double dx = std::min(std::abs(x), std::abs(x - side));
    disks[3] = {x, dx < far ? -std::sqrt(far * far - dx * dx) : 0.0, 0.5, 0, v, 0};
  } else {
    // Distances `side` from disk 0 and `reach` from disk 1, below the base.
    const double reach = 1 + law.attraction_range * (1 - kJustInside);
    const double x = (side * side + side * side - reach * reach) / (2 * side);
    disks[3] = {x, -std::sqrt(side * side - x * x), 0.5, 0, 0, 0};
  }

  ClusterResult r;
  r.state = few_bodies(setup.law, disks, setup.step_fraction);
  Solver solver(r.state, {});
  EquilibriumScene tolerance;
  tolerance.force = kResidual;
  tolerance.kinetic_energy = kRestEnergy;
  const auto interval = static_cast<std::int64_t>(std::ceil(0.25 / r.state.time_step));
  while (solver.time() < setup.max_time && !r.at_rest) {
    solver.run(interval);
    solver.snapshot(r.state);
    r.state.certificate = evaluate_certificate(r.state.packing, r.state.law, {}, tolerance);
    r.at_rest = r.state.certificate.equilibrated && find_link(r.state, 2, 0) && !r.state.packing.links.empty() &&
                (find_link(r.state, 0, 3) || find_link(r.state, 1, 3) || find_link(r.state, 2, 3));
  }
  r.residual = r.state.certificate.max_force;
  for (const Link<2>& l : r.state.packing.links) r.contacts += is_contact(l.kind);

  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Link<2>*c1 = find_link(r.state, 0, 3), *c2 = find_link(r.state, 1, 3), *base = find_link(r.state, 0, 1);
  const Link<2>*c3 = find_link(r.state, 0, 2), *c4 = find_link(r.state, 1, 2);
  if (r.contacts == 5 && c1 && c2 && c3 && c4 && base) {
    r.outer_normal = 0.5 * (c1->normal_force + c2->normal_force);
    r.common_normal = base->normal_force;
    r.outer_tangential = 0.25 * (std::abs(c1->tangential_force) + std::abs(c2->tangential_force) +
                                 std::abs(c3->tangential_force) + std::abs(c4->tangential_force));
  } else {
    r.outer_normal = r.common_normal = r.outer_tangential = nan;
  }
  return r;
}

}  // namespace isostat::lab
