#include "dem/disks/state_check.hpp"

namespace isostat {

using namespace state_check;

std::optional<StateFault> memory_fault(const DiskMemory& m, const Packing<2>& packing) {
  if (!packing.beams.empty()) return StateFault{"links", "beams between disks are kept by .net files only"};
  const std::size_t n = packing.bodies.size();
  for (const std::size_t size : {m.half_velocity.size(), m.half_spin.size(), m.force.size(), m.torque.size()})
    if (size != n && size != 0) return StateFault{"solver", "an array has neither one element a grain nor none"};
  const std::size_t grains = packing.grains();
  for (const std::size_t size : {m.lists.outer_position.size(), m.lists.inner_position.size()})
    if (size != grains && size != 0)
      return StateFault{"solver", "an array has neither one element a grain, feet left out, nor none"};
  const std::size_t held = n - count_free(packing) - packing.feet.size();
  if (m.wall_position.size() != held && !m.wall_position.empty())
    return StateFault{"solver/wall_position", "has neither one element for each grain of a wall nor none"};
  if (auto f = check_values(m.wall_position, "solver/wall_position")) return f;
  if (auto f = check_values(m.half_velocity, "solver/half_velocity")) return f;
  if (auto f = check_values(m.half_spin, "solver/half_spin")) return f;
  if (auto f = check_values(m.force, "solver/force")) return f;
  if (auto f = check_values(m.torque, "solver/torque")) return f;
  for (const PairMemory<DiskHistory>& p : m.pairs)
    if (!names_two_bodies(p, grains) || !finite(p.history.tangential_force) || !finite(p.history.moment))
      return StateFault{"solver/pairs", "a pair does not join two grains or has a force that is not a finite number"};
  return lists_fault(m.lists);
}

std::optional<StateFault> law_fault(const DiskLaw& law) {
  const auto& [kn, kt, zeta, mu, mu_r, kr, f0, d0] = law;
  for (const double x : {kn, kt, zeta, mu, mu_r, kr, f0, d0})
    if (!finite(x) || x < 0) return StateFault{"law", "a parameter that is negative or not a finite number"};
  return std::nullopt;
}

}  // namespace isostat
