// Solver<System> written out; included where a system instantiates it.
#pragma once
#include <algorithm>
#include <cmath>

#include "dem/input_error.hpp"
#include "dem/run_error.hpp"
#include "dem/solver/neighbours.hpp"
#include "dem/solver/solver.hpp"

namespace isostat {

inline constexpr double kMostStrain = 0.1;  // [-] of the cell in one step: beyond, the run has blown up

template <class System>
Solver<System>::Solver(const State<System>& state, const CellControl<D>& control, SolverOptions options)
    : control_(control),
      dt_(state.time_step),
      time_(state.time),
      step_(state.step),
      cell_(state.packing.cell),
      cell_motion_(state.cell_motion),
      engine_(state, control, options) {
  if (control.moves() && !cell_)
    throw InputError("scene", 0, "stage", "",
                     "a stress or strain rate needs a periodic cell; this packing is isolated");
  if (constexpr bool can = requires { Engine::kShears; }; control.shears() && !can)
    throw InputError("scene", 0, "stage", "",
                     "a cell shears with disks or spheres in it, and not with " + std::string(System::name));
  if (engine_.begins()) {
    engine_.compute_forces(cell_, flow_, 0.0);
    engine_.start_half_steps();
    measure_stress();
  }
}

template <class System>
void Solver<System>::step() {
  StageClock clock(times_, step_ % kTimedEvery == 0);
  const double displacement = advance();
  clock.mark(Stage::motion);
  update_lists(displacement);
  clock.mark(Stage::neighbours);
  engine_.compute_forces(cell_, flow_, dt_);
  engine_.correct();
  clock.mark(Stage::forces);
  measure_stress();
  engine_.keep_books();
  clock.mark(Stage::stress);
  time_ += dt_;
  ++step_;
}

template <class System>
auto Solver<System>::move_cell() -> MotionStep<D> {
  MotionStep<D> step;
  step.time_step = dt_, step.time = time_ + dt_;
  step.keep_spin = 1 - drag_ * dt_;
  step.keep.fill(step.keep_spin);
  if (control_.moves()) flow_ = advance_cell(control_.at(time_), dt_, cell_motion_, *cell_, step);
  return step;
}

template <class System>
double Solver<System>::advance() {
  const MotionStep<D> step = move_cell();
  const Advance moved = engine_.advance(step, drag_);
  const bool sane = std::all_of(step.scale.begin(), step.scale.end(),
                                [](double scale) { return std::abs(scale - 1) <= kMostStrain; }) &&
                    std::abs(step.shear) <= kMostStrain;
  if (moved.violent || !sane) check_sanity();
  return moved.displacement;
}

template <class System>
void Solver<System>::update_lists(double displacement) {
  try {
    engine_.update_lists(cell_, displacement);
  } catch (const ListFailure& e) {
    check_sanity();  // may name the grain
    throw RunError(step_, -1, e.what(), Engine::kListAdvice);
  }
}

// sigma_ab = (1/V) [sum m v_a v_b + sum over pairs F_a r_b], each pair once, compression positive: the diagonal, and
// sigma_12 of a cell that shears.
template <class System>
void Solver<System>::measure_stress() {
  if (!control_.moves()) return;
  const StressSums<D> sums = engine_.sums();
  const double volume = cell_->measure();
  for (std::size_t a = 0; a < D; ++a)
    cell_motion_.stress[static_cast<int>(a)] = (sums.kinetic[a] + sums.virial[a]) / volume;
  if (control_.shears()) cell_motion_.shear_stress = (sums.shear_kinetic + sums.shear_virial) / volume;
}

template <class System>
void Solver<System>::snapshot(State<System>& s) const {
  s.time = time_, s.step = step_, s.time_step = dt_;
  s.packing.cell = cell_;
  s.cell_motion = cell_motion_;
  s.imposed_stress = control_.at(time_).stress;
  engine_.snapshot(s);
}

template <class System>
void Solver<System>::check_sanity() const {
  engine_.check_bodies(step_);
  check_cell();
  engine_.check_overlaps(cell_, step_);
}

template <class System>
void Solver<System>::check_cell() const {
  if (!cell_) return;
  for (int a = 0; a < D; ++a)
    if (!(std::abs(cell_motion_.strain_rate[a]) * dt_ <= kMostStrain) || !(cell_->length[a] > 0))
      throw RunError(step_, -1,
                     "the cell collapses, L" + std::to_string(a + 1) + " = " + std::to_string(cell_->length[a]),
                     "set stage.max_strain_rate or stage.max_edge_speed, raise cell.inertia or lower stage.pressure");
  if (!(std::abs(cell_motion_.shear_strain_rate) * dt_ <= kMostStrain))
    throw RunError(step_, -1,
                   "the cell shears by " + std::to_string(cell_motion_.shear_strain_rate * dt_) + " in a step",
                   "set stage.max_strain_rate, raise cell.inertia or lower stage.stress_12 or stage.shear_rate");
}

}  // namespace isostat
