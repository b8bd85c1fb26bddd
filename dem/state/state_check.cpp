#include "dem/state/state_check.hpp"

#include <algorithm>
#include <cmath>

namespace isostat {
namespace {

using Broken = std::optional<StateFault>;

bool finite(double x) { return std::isfinite(x); }
template <int D>
bool finite(const Vec<D>& v) {
  return std::all_of(v.c.begin(), v.c.end(), [](double x) { return std::isfinite(x); });
}

// Every element finite, and positive where asked.
template <class T>
Broken check_values(const std::vector<T>& values, const char* field, bool positive = false) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!finite(values[k])) return StateFault{field, "element " + std::to_string(k) + " is not a finite number"};
    if constexpr (std::is_same_v<T, double>)
      if (positive && !(values[k] > 0)) return StateFault{field, "element " + std::to_string(k) + " is not positive"};
  }
  return std::nullopt;
}

template <int D>
Broken check_bodies(const Packing<D>& packing) {
  const Bodies<D>& b = packing.bodies;
  const std::size_t n = b.size();
  for (const std::size_t size :
       {b.position.size(), b.velocity.size(), b.spin.size(), b.radius.size(), b.mass.size(), b.inertia.size()})
    if (size != n) return StateFault{"particles/grains", "arrays of different lengths"};
  std::vector<std::int64_t> ids = b.id;
  std::sort(ids.begin(), ids.end());
  if (const auto twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end())
    return StateFault{"particles/grains/id", std::to_string(*twice) + " occurs twice"};
  if (auto f = check_values(b.position, "particles/grains/position")) return f;
  if (auto f = check_values(b.velocity, "particles/grains/velocity")) return f;
  if (auto f = check_values(b.spin, "particles/grains/spin")) return f;
  if (auto f = check_values(b.radius, "particles/grains/radius", true)) return f;
  if (auto f = check_values(b.mass, "particles/grains/mass", true)) return f;
  if (auto f = check_values(b.inertia, "particles/grains/inertia", true)) return f;
  if (packing.cell)
    for (int k = 0; k < D; ++k)
      if (!(packing.cell->length[k] > 0) || !std::isfinite(packing.cell->length[k]))
        return StateFault{"particles/grains/box/edges", "an edge is not positive and finite"};
  return std::nullopt;
}

template <class Pair>
bool names_two_bodies(const Pair& pair, std::size_t n) {
  const auto in = [n](std::int32_t k) { return k >= 0 && static_cast<std::size_t>(k) < n; };
  return in(pair.i) && in(pair.j) && (pair.i != pair.j || pair.shift != decltype(pair.shift){});
}

template <int D>
Broken check_links(const Packing<D>& packing) {
  for (std::size_t k = 0; k < packing.links.size(); ++k) {
    const Link<D>& l = packing.links[k];
    const std::string which = "link " + std::to_string(k);
    if (!names_two_bodies(l, packing.bodies.size())) return StateFault{"links/i", which + " does not join two grains"};
    if (!packing.cell && l.shift != ImageShift<D>{})
      return StateFault{"links/shift", which + " crosses a cell that is not there"};
    if (l.kind > LinkKind::beam) return StateFault{"links/kind", which + " has an unknown kind"};
    if (l.kind == LinkKind::beam && (l.beam < 0 || static_cast<std::size_t>(l.beam) >= packing.beams.size()))
      return StateFault{"links/beam", which + " names a beam that is not there"};
    if (!finite(l.gap) || !finite(l.normal_force) || !finite(l.tangential_force) || !finite(l.moment))
      return StateFault{"links", which + " has a gap, force or moment that is not a finite number"};
  }
  return std::nullopt;
}

Broken check_memory(const SolverMemory& m, std::size_t n) {
  for (const std::size_t size : {m.half_velocity.size(), m.half_spin.size(), m.force.size(), m.torque.size(),
                                 m.outer_position.size(), m.inner_position.size()})
    if (size != n && size != 0) return StateFault{"solver", "an array has neither one element a grain nor none"};
  if (auto f = check_values(m.half_velocity, "solver/half_velocity")) return f;
  if (auto f = check_values(m.half_spin, "solver/half_spin")) return f;
  if (auto f = check_values(m.force, "solver/force")) return f;
  if (auto f = check_values(m.torque, "solver/torque")) return f;
  if (auto f = check_values(m.outer_position, "solver/outer_position")) return f;
  if (auto f = check_values(m.inner_position, "solver/inner_position")) return f;
  for (const PairMemory& p : m.pairs)
    if (!names_two_bodies(p, n) || !finite(p.tangential_force) || !finite(p.moment))
      return StateFault{"solver/pairs", "a pair does not join two grains or has a force that is not a finite number"};
  if (!finite(m.outer_length) || !finite(m.inner_length) || !finite(m.outer_travel) || !finite(m.inner_travel) ||
      !finite(m.outer_skin) || !finite(m.inner_skin))
    return StateFault{"solver", "a length that is not a finite number"};
  return std::nullopt;
}

Broken check_numbers(const State& s) {
  const auto& [kn, kt, zeta, mu, mu_r, kr, f0, d0] = s.law;
  for (const double x : {kn, kt, zeta, mu, mu_r, kr, f0, d0})
    if (!finite(x) || x < 0) return StateFault{"law", "a parameter that is negative or not a finite number"};
  if (!finite(s.time) || !finite(s.time_step) || s.time_step < 0 || s.step < 0)
    return StateFault{"run", "a time or step that is negative or not a finite number"};
  for (const auto& stress : s.imposed_stress)
    if (stress && !finite(*stress)) return StateFault{"run", "an imposed stress that is not a finite number"};
  if (!finite(s.cell_motion.reference_length) || !finite(s.cell_motion.strain_rate) || !finite(s.cell_motion.stress))
    return StateFault{"cell", "a number that is not finite"};
  if (s.progress.stage < 0 || static_cast<std::size_t>(s.progress.stage) > s.scene.stages.size())
    return StateFault{"progress", "stage is not one of the scene's"};
  if (!finite(s.progress.start_time) || !finite(s.progress.quiet_since) || !finite(s.progress.unchanged_since) ||
      !finite(s.progress.start_stiffness) || !finite(s.progress.start_stress) || !finite(s.progress.peak_stress))
    return StateFault{"progress", "a number that is not finite"};
  return std::nullopt;
}

}  // namespace

template <int D>
std::optional<StateFault> packing_fault(const Packing<D>& packing) {
  if (auto f = check_bodies(packing)) return f;
  return check_links(packing);
}
template std::optional<StateFault> packing_fault(const Packing<2>&);
template std::optional<StateFault> packing_fault(const Packing<3>&);

std::optional<StateFault> state_fault(const State& state) {
  if (auto f = packing_fault(state.packing)) return f;
  if (!state.packing.beams.empty()) return StateFault{"links", "beams between disks are kept by .net files only"};
  if (auto f = check_memory(state.memory, state.packing.bodies.size())) return f;
  return check_numbers(state);
}

}  // namespace isostat
