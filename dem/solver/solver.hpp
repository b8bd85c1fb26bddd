// The solver: marches a packing in time,  body forces = G^T law(G velocities), matrix-free. The loop, the clock and the
// cell; what a step does to the bodies is the engine's of the system (dem/disks/engine.hpp).
#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>

#include "dem/solver/barostat.hpp"
#include "dem/solver/isa.hpp"
#include "dem/state/state.hpp"

namespace isostat {

struct SolverOptions {
  int threads = 1;
  Isa isa = best_isa();
  bool energies = false;  // keep the energy ledger (a dearer kernel)
};

enum class Stage { motion, neighbours, forces, stress };

// Where the wall time of the step loop went, sampled [s].
struct StepTimes {
  static constexpr std::array<std::string_view, 4> kNames{"motion", "neighbours", "forces", "stress"};
  std::array<double, 4> seconds{};
  StepTimes& operator+=(const StepTimes& o) {
    for (std::size_t k = 0; k < seconds.size(); ++k) seconds[k] += o.seconds[k];
    return *this;
  }
};

// Sums over the bodies and links of one instant, from which the stress follows [F0 a].
template <int D>
struct StressSums {
  std::array<double, D> kinetic{};             // sum of m v_a^2
  std::array<double, D> virial{};              // sum of F_a r_a, repulsion positive
  double shear_kinetic = 0, shear_virial = 0;  // of m v_1 v_2 and F_1 r_2; where the cell shears
};

// How far the bodies went in a step.
struct Advance {
  double displacement = 0;  // [a] bound on the relative displacement of two neighbours
  bool violent = false;     // further than a sane run goes
};

template <class System>
class Solver {
 public:
  using Engine = typename System::Engine;
  using Law = typename System::Law;
  static constexpr int D = System::dimension;

  // From a state: with its memory the run goes on bit for bit; without (a new or foreign packing) lists and half-step
  // velocities are made from the packing, and spring histories from its links.
  // Throws InputError if the law is not among the supported compositions or a cell that is not there is to move,
  // RunError if the cell is too small.
  Solver(const State<System>& state, const CellControl<D>& control, SolverOptions options = {});

  void run(std::int64_t steps) {
    for (std::int64_t k = 0; k < steps; ++k) step();
  }
  void step();  // throws RunError when it blows up

  void set_drag(double rate) { drag_ = rate; }  // [1/T0] global drag -rate m v, -rate I w; 0: none
  // Other stiffnesses; the composition may not change.
  void set_law(const Law& law, Springs springs = Springs::keep_forces) { engine_.set_law(law, springs); }
  double time() const { return time_; }
  std::int64_t steps() const { return step_; }
  const std::optional<PeriodicCell<D>>& cell() const { return cell_; }
  const CellMotion<D>& cell_motion() const { return cell_motion_; }
  StepTimes times() const { return times_; }
  const Engine& engine() const { return engine_; }
  Engine& engine() { return engine_; }  // for protocols that interfere between steps

  // The instant as data: packing with full-step velocities and links, and the memory for a restart. Reads only.
  void snapshot(State<System>& state) const;
  // Throws RunError if a position or velocity is not finite or grains overlap absurdly.
  void check_sanity() const;

 private:
  // Adds the time since the last mark to a stage, on the steps that are timed.
  class StageClock {
   public:
    StageClock(StepTimes& times, bool on) : times_(times), on_(on) {
      if (on_) last_ = Clock::now();
    }
    void mark(Stage stage) {
      if (!on_) return;
      const auto now = Clock::now();
      times_.seconds[static_cast<std::size_t>(stage)] +=
          std::chrono::duration<double>(now - last_).count() * static_cast<double>(kTimedEvery);
      last_ = now;
    }

   private:
    using Clock = std::chrono::steady_clock;
    StepTimes& times_;
    bool on_;
    Clock::time_point last_;
  };
  // Reading the clock at every stage of every step would cost a few per cent.
  static constexpr std::int64_t kTimedEvery = 64;

  MotionStep<D> move_cell();
  double advance();
  void update_lists(double displacement);
  void measure_stress();
  void check_cell() const;

  CellControl<D> control_;
  double dt_ = 0, drag_ = 0, time_ = 0;
  std::int64_t step_ = 0;
  std::optional<PeriodicCell<D>> cell_;
  CellMotion<D> cell_motion_;
  CellFlow<D> flow_;
  Engine engine_;
  StepTimes times_;
};

}  // namespace isostat
