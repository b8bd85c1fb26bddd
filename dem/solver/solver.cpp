#include "dem/solver/solver.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "dem/disks/at_rest.hpp"
#include "dem/disks/kernel/crossing.hpp"
#include "dem/run_error.hpp"
#include "dem/state/link.hpp"

namespace isostat {
namespace {

constexpr double kMostMove = 0.1;         // [smallest diameter] in one step: beyond, the run has blown up
constexpr double kMostOverlap = 0.5;      // [R_i + R_j]
constexpr std::int64_t kTimedEvery = 64;  // reading the clock at every stage of every step would cost a few per cent

using Clock = std::chrono::steady_clock;

// Adds the time since the last mark to a stage, on the steps that are timed.
class StageClock {
 public:
  StageClock(StepTimes& times, bool on) : times_(times), on_(on) {
    if (on_) last_ = Clock::now();
  }
  void mark(std::size_t stage) {
    if (!on_) return;
    const auto now = Clock::now();
    times_.seconds[stage] += std::chrono::duration<double>(now - last_).count() * static_cast<double>(kTimedEvery);
    last_ = now;
  }

 private:
  StepTimes& times_;
  bool on_;
  Clock::time_point last_;
};

}  // namespace

Solver::Solver(const State& state, const CellControl& control, SolverOptions options)
    : law_(state.law),
      control_(control),
      dt_(state.time_step),
      time_(state.time),
      step_(state.step),
      cell_(state.packing.cell.value()),
      cell_motion_(state.cell_motion),
      ledger_(state.ledger),
      energies_(options.energies),
      rotates_(law_.friction > 0 || law_.rolling_friction > 0),
      force_kernel_(select_kernel(law_,
                                  options.energies  ? Tally::energy
                                  : control.moves() ? Tally::stress
                                                    : Tally::nothing,
                                  options.isa)),
      motion_kernel_(select_motion({rotates_, control.moves()})),
      team_(std::min(options.threads, NeighbourLists::chunk_count(state.packing.bodies.size()))),
      lists_(state.packing.bodies.size(), law_.attraction_range, law_.damping, law_.normal_stiffness) {
  load_bodies(state);
  prediction_ = velocity_prediction(law_, smallest_mass_, dt_);
  motion_tallies_.resize(static_cast<std::size_t>(lists_.chunks()));
  if (state.memory.half_velocity.empty()) {
    compute_forces(0.0);
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      double *row = bodies_.row(k), *load = bodies_.load(k);
      const BodyConstants& c = bodies_.constants[k];
      row[2] -= 0.5 * dt_ * load[0] * c.inverse_mass;
      row[3] -= 0.5 * dt_ * load[1] * c.inverse_mass;
      row[5] -= 0.5 * dt_ * (c.radius * load[2] + load[3]) * c.inverse_inertia;
      row[4] = c.radius * row[5];
      for (int a = 0; a < 2; ++a) motion_tally_.kinetic[a] += c.mass * row[6 + a] * row[6 + a];
    }
    measure_stress();
    if (energies_) set_work_due();
  }
}

void Solver::step() {
  StageClock clock(times_, step_ % kTimedEvery == 0);
  const double displacement = advance_bodies();
  clock.mark(0);
  update_lists(displacement);
  clock.mark(1);
  compute_forces(dt_);
  clock.mark(2);
  measure_stress();
  if (energies_) work_ledger();
  clock.mark(3);
  time_ += dt_;
  ++step_;
}

double Solver::advance_bodies() {
  MotionStep step;
  step.time_step = dt_;
  step.prediction = prediction_;
  step.keep[0] = step.keep[1] = step.keep_spin = 1 - drag_ * dt_;
  double affine = 0;
  if (control_.moves()) {
    flow_ = advance_cell(control_, dt_, cell_motion_, cell_, step);
    affine = std::max(std::abs(step.scale[0] - 1), std::abs(step.scale[1] - 1));
  }
  if (energies_ && (step.keep[0] != 1 || step.keep[1] != 1)) brake_ledger(step);

  team_.run(lists_.chunks(), [&](int chunk) {
    motion_tallies_[static_cast<std::size_t>(chunk)] =
        motion_kernel_(bodies_, lists_.chunk_begin(chunk), lists_.chunk_begin(chunk + 1), step);
  });
  motion_tally_ = {};
  for (const MotionTally& t : motion_tallies_) {
    motion_tally_.largest_speed_squared = std::max(motion_tally_.largest_speed_squared, t.largest_speed_squared);
    motion_tally_.kinetic[0] += t.kinetic[0], motion_tally_.kinetic[1] += t.kinetic[1];
  }
  const double move = dt_ * std::sqrt(motion_tally_.largest_speed_squared);
  if (!(move <= kMostMove * smallest_diameter_) || !(affine <= kMostMove)) check_sanity();
  // Listed neighbours are nearer than two diameters and the range; the first factor covers the rescaling of the
  // peculiar move, and the rounding of travels summed over many steps.
  return (1.01 + affine) * (2 * move + affine * (2 * largest_diameter_ + law_.attraction_range));
}

void Solver::update_lists(double displacement) {
  try {
    lists_.update(bodies_, cell_, displacement);
  } catch (const std::runtime_error& e) {
    check_sanity();  // may name the grain
    throw RunError(step_, -1, e.what(), "use more grains (grains.count), or lower stage.pressure or step.fraction");
  }
}

void Solver::compute_forces(double time_step) {
  PairForceInput in;
  in.rows = bodies_.rows.data();
  in.loads = bodies_.loads.data();
  in.pairs = lists_.arrays();
  in.law = law_;
  in.time_step = time_step;
  for (int a = 0; a < 2; ++a) in.flow_half[a] = flow_.half[a], in.flow_now[a] = flow_.now[a];
  for (std::uint8_t code = 0; code < 9; ++code) {
    const Vec2 offset = cell_.offset(image_shift(code));
    in.offset_x[code] = offset[0], in.offset_y[code] = offset[1];
  }
  force_tally_ = {};
  for (int phase = 0; phase < NeighbourLists::kPhases; ++phase) {
    const std::vector<PairGroup>& groups = lists_.phase(phase);
    force_tallies_.assign(groups.size(), {});
    team_.run(static_cast<int>(groups.size()), [&](int g) {
      const PairGroup& group = groups[static_cast<std::size_t>(g)];
      PairForceTally& tally = force_tallies_[static_cast<std::size_t>(g)];
      PairForceInput part = in;
      part.begin = group.begin, part.end = group.images, part.images = false;
      if (part.begin < part.end) tally += force_kernel_(part);
      part.begin = group.images, part.end = group.end, part.images = true;
      if (part.begin < part.end) tally += force_kernel_(part);
    });
    for (const PairForceTally& t : force_tallies_) force_tally_ += t;
  }
}

// sigma_aa = (1/A) [sum m v_a^2 + sum over pairs F_a r_a], each pair once, compression positive.
void Solver::measure_stress() {
  if (!control_.moves()) return;
  const double area = cell_.measure();
  for (int a = 0; a < 2; ++a) {
    cell_motion_.stress[a] = (motion_tally_.kinetic[a] + force_tally_.virial[a]) / area;
  }
}

// Work of the forces that keep only a part of the velocity: the impulse of each times the mean of the velocities before
// and after, exactly what the kinetic energy loses. The part due to the rate of the cell is the cell's work.
void Solver::brake_ledger(const MotionStep& step) {
  const double drag = drag_ * dt_;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const double *row = bodies_.row(k), *load = bodies_.load(k);
    const BodyConstants& c = bodies_.constants[k];
    for (int a = 0; a < 2; ++a) {
      const double free = row[2 + a] + dt_ * load[a] * c.inverse_mass, brake = 1 - step.keep[a];
      const double mean = 0.5 * (row[2 + a] + free * step.keep[a]);
      ledger_.drag += c.mass * drag * free * mean;
      ledger_.cell_work -= c.mass * (brake - drag) * free * mean;
    }
    if (!rotates_) continue;
    const double free = row[5] + dt_ * (c.radius * load[2] + load[3]) * c.inverse_inertia;
    ledger_.drag += drag * free * 0.5 * (row[5] + free * step.keep_spin) / c.inverse_inertia;
  }
}

// Springs were stretched over the step that ends now. Viscous forces and the moving cell work as the trapezium rule
// says: half of a step's work before its instant, half after.
void Solver::work_ledger() {
  ledger_.sliding += force_tally_.sliding;
  ledger_.rolling += force_tally_.rolling;
  ledger_.viscous += ledger_.viscous_due, ledger_.cell_work += ledger_.cell_work_due;
  set_work_due();
  ledger_.viscous += ledger_.viscous_due, ledger_.cell_work += ledger_.cell_work_due;
}

void Solver::set_work_due() {
  ledger_.viscous_due = 0.5 * dt_ * viscous_power();
  ledger_.cell_work_due = -0.5 * dt_ * (force_tally_.virial[0] * flow_.now[0] + force_tally_.virial[1] * flow_.now[1]);
}

// Of the viscous forces of this instant, with the mean of the velocities before and after it. The forces themselves
// were evaluated with predicted velocities, before the loads were known.
double Solver::viscous_power() const {
  if (!(law_.damping > 0)) return 0;
  double power = 0;
  lists_.for_each([&](std::int32_t a, std::int32_t b, std::uint8_t shift, double, double) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const BodyConstants &ci = bodies_.constants[i], &cj = bodies_.constants[j];
    const Vec2 r = bodies_.position(j) + cell_.offset(image_shift(shift)) - bodies_.position(i);
    const PairFrame<double> frame = pair_frame(r[0], r[1], ci.radius + cj.radius);
    if (frame.gap >= 0) return;
    double receding = 0, predicted = 0, mean = 0;
    for (int k = 0; k < 2; ++k) {
      const double normal = k == 0 ? frame.nx : frame.ny, affine = flow_.now[k] * r[k];
      const double *ri = bodies_.row(i), *rj = bodies_.row(j);
      const double kick = 0.5 * dt_ * (bodies_.load(j)[k] * cj.inverse_mass - bodies_.load(i)[k] * ci.inverse_mass);
      receding += normal * (rj[2 + k] - ri[2 + k] + flow_.half[k] * r[k]);
      predicted += normal * (rj[6 + k] - ri[6 + k] + affine);
      mean += normal * (rj[2 + k] - ri[2 + k] + kick + affine);
    }
    const double damping = law_.damping * std::sqrt(4 * law_.normal_stiffness / (ci.inverse_mass + cj.inverse_mass));
    using kernel::Scalar;
    const Scalar weight = kernel::crossing_weights(Scalar(frame.gap), Scalar(receding * dt_),
                                                   kernel::crossing_braking(law_, dt_), Scalar(damping))
                              .viscous;
    power += weight[0] * damping * predicted * mean;
  });
  return power;
}

void Solver::set_law(const LawParameters& law, Springs springs) {
  if (energies_) ledger_.injected -= elastic_energy();
  if (springs == Springs::keep_elongations) {
    const auto growth = [](double now, double before) { return before > 0 ? now / before : 1.0; };
    lists_.scale_springs(growth(law.tangential_stiffness, law_.tangential_stiffness),
                         growth(law.rolling_stiffness, law_.rolling_stiffness));
  }
  lists_.set_stiffness(law.normal_stiffness, bodies_);
  law_ = law;
  prediction_ = velocity_prediction(law_, smallest_mass_, dt_);
  if (energies_) ledger_.injected += elastic_energy();
}

double Solver::elastic_energy() const {
  double energy = 0;
  lists_.for_each([&](std::int32_t i, std::int32_t j, std::uint8_t shift, double tangential, double moment) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const double sum = bodies_.constants[a].radius + bodies_.constants[b].radius;
    const double gap = norm(bodies_.position(b) + cell_.offset(image_shift(shift)) - bodies_.position(a)) - sum;
    if (!(gap < 0)) return;
    const SpringEnergy springs = spring_energy(law_, tangential, moment);
    energy += contact(law_, gap).elastic + springs.tangential + springs.rolling;
  });
  return energy;
}

void Solver::check_sanity() const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const double* row = bodies_.row(k);
    const double move = dt_ * std::hypot(row[2], row[3]);
    if (!std::isfinite(row[0] + row[1] + row[2] + row[3] + row[5]))
      throw RunError(step_, bodies_.id[k], "its position or velocity is not a number", "lower step.fraction");
    if (!(move <= kMostMove * smallest_diameter_))
      throw RunError(step_, bodies_.id[k], "it moves " + std::to_string(move) + " a in one step",
                     "lower step.fraction or stage.velocity");
  }
  for (int a = 0; a < 2; ++a)
    if (!(std::abs(cell_motion_.strain_rate[a]) * dt_ <= kMostMove) || !(cell_.length[a] > 0))
      throw RunError(step_, -1,
                     "the cell collapses, L" + std::to_string(a + 1) + " = " + std::to_string(cell_.length[a]),
                     "set stage.max_strain_rate, raise cell.inertia or lower stage.pressure");
  lists_.for_each([&](std::int32_t i, std::int32_t j, std::uint8_t shift, double, double) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const double sum = bodies_.constants[a].radius + bodies_.constants[b].radius;
    const double distance = norm(bodies_.position(b) + cell_.offset(image_shift(shift)) - bodies_.position(a));
    if (distance < (1 - kMostOverlap) * sum)
      throw RunError(
          step_, bodies_.id[a],
          "it overlaps grain " + std::to_string(bodies_.id[b]) + " by " + std::to_string(sum - distance) + " a",
          "raise law.normal_stiffness or lower stage.pressure");
  });
}

}  // namespace isostat
