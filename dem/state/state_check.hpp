// What every stored State obeys: array sizes, finite numbers, indices in range.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "dem/state/list_memory.hpp"
#include "dem/state/state.hpp"

namespace isostat {

struct StateFault {
  std::string field;  // as in the state file: "links/i"
  std::string rule;
};

// What the checks of a system's own parts are written with.
namespace state_check {

inline bool finite(double x) { return std::isfinite(x); }
template <int D>
bool finite(const Vec<D>& v) {
  return std::all_of(v.c.begin(), v.c.end(), [](double x) { return std::isfinite(x); });
}
template <std::size_t N>
bool finite(const std::array<Vec2, N>& vectors) {
  return std::all_of(vectors.begin(), vectors.end(), [](const Vec2& v) { return finite(v); });
}

// Every element finite, and positive where asked, but for the last ones, so many, which are then 0.
template <class T>
std::optional<StateFault> check_values(const std::vector<T>& values, const std::string& field, bool positive = false,
                                       std::size_t zeros = 0) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!finite(values[k])) return StateFault{field, "element " + std::to_string(k) + " is not a finite number"};
    if constexpr (std::is_same_v<T, double>)
      if (positive && !(k < values.size() - zeros ? values[k] > 0 : values[k] == 0))
        return StateFault{field, "element " + std::to_string(k) + " is not positive"};
  }
  return std::nullopt;
}

template <class Pair>
bool names_two_bodies(const Pair& pair, std::size_t n) {
  const auto in = [n](std::int32_t k) { return k >= 0 && static_cast<std::size_t>(k) < n; };
  return in(pair.i) && in(pair.j) && (pair.i != pair.j || pair.shift != decltype(pair.shift){});
}

// Lengths of the neighbour lists, and their positions.
template <int D>
std::optional<StateFault> lists_fault(const ListMemory<D>& m) {
  if (auto f = check_values(m.outer_position, "solver/outer_position")) return f;
  if (auto f = check_values(m.inner_position, "solver/inner_position")) return f;
  if (!finite(m.outer_length) || !finite(m.inner_length) || !finite(m.outer_travel) || !finite(m.inner_travel) ||
      !finite(m.outer_skin) || !finite(m.inner_skin) || !finite(m.outer_tilt) || !finite(m.inner_tilt))
    return StateFault{"solver", "a length that is not a finite number"};
  return std::nullopt;
}

}  // namespace state_check

// The first broken rule of ids, arrays and numbers, if any; `group` is where they lie in the file. The last bodies, so
// many, are points without radius, mass and inertia.
template <int D>
std::optional<StateFault> bodies_fault(const Bodies<D>& bodies, const std::string& group, std::size_t points = 0);
template <int D>
std::optional<StateFault> cell_fault(const std::optional<PeriodicCell<D>>& cell, const std::string& group);

// The same of a whole packing, links included.
template <int D>
std::optional<StateFault> packing_fault(const Packing<D>& packing);

// Of the numbers that all systems have.
template <class System>
std::optional<StateFault> run_fault(const State<System>& s) {
  using state_check::finite;
  if (!finite(s.time) || !finite(s.time_step) || s.time_step < 0 || s.step < 0)
    return StateFault{"run", "a time or step that is negative or not a finite number"};
  for (const auto& stress : s.imposed_stress)
    if (stress && !finite(*stress)) return StateFault{"run", "an imposed stress that is not a finite number"};
  if (s.imposed_stress.shear && !finite(*s.imposed_stress.shear))
    return StateFault{"run", "an imposed shear stress that is not a finite number"};
  const CellMotion<System::dimension>& motion = s.cell_motion;
  if (!finite(motion.reference_length) || !finite(motion.strain_rate) || !finite(motion.stress) ||
      !finite(motion.shear_strain_rate) || !finite(motion.shear_stress) || !finite(motion.shear_strain))
    return StateFault{"cell", "a number that is not finite"};
  if (name(s.scene.system) != System::name) return StateFault{"scene", "is of another system than the state"};
  if (s.progress.stage < 0 || static_cast<std::size_t>(s.progress.stage) > s.scene.stages.size())
    return StateFault{"progress", "stage is not one of the scene's"};
  if (!finite(s.progress.start_time) || !finite(s.progress.quiet_since) || !finite(s.progress.unchanged_since) ||
      !finite(s.progress.start_stiffness) || !finite(s.progress.start_stress) ||
      !finite(s.progress.start_shear_stress) || !finite(s.progress.ramp_stress) || !finite(s.progress.ramp_rate) ||
      !finite(s.progress.ramp_shear_stress) || !finite(s.progress.ramp_shear_rate) ||
      !finite(s.progress.carried_stress) || !finite(s.progress.carried_at) || !finite(s.progress.peak_stress))
    return StateFault{"progress", "a number that is not finite"};
  const Surroundings& around = s.surroundings;
  if (!finite(around.start_offset) || !finite(around.start_angle) || !finite(around.mass_left) ||
      !finite(around.last_left) || around.grains_left < 0 || around.mass_left < 0)
    return StateFault{"surroundings", "a number that is not finite, or a negative count or mass"};
  return std::nullopt;
}

// The system says what holds for its memory, given the packing, and for its law (dem/disks/state_check.hpp).
template <class System>
std::optional<StateFault> state_fault(const State<System>& state) {
  if (auto f = packing_fault(state.packing)) return f;
  if (auto f = memory_fault(state.memory, state.packing)) return f;
  if (auto f = law_fault(state.law)) return f;
  return run_fault(state);
}

}  // namespace isostat
