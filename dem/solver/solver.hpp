// The solver: marches a packing in time,  body forces = G^T law(G velocities), matrix-free.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "dem/disks/bodies_store.hpp"
#include "dem/disks/kernel/pair_force.hpp"
#include "dem/disks/motion.hpp"
#include "dem/solver/barostat.hpp"
#include "dem/solver/neighbours.hpp"
#include "dem/solver/team.hpp"
#include "dem/state/state.hpp"

namespace isostat {

struct SolverOptions {
  int threads = 1;
  Isa isa = best_isa();
  bool energies = false;  // keep the energy ledger (a dearer kernel)
};

// Where the wall time of the step loop went, sampled [s].
struct StepTimes {
  static constexpr std::array<std::string_view, 4> kNames{"motion", "neighbours", "forces", "stress"};
  std::array<double, 4> seconds{};
  StepTimes& operator+=(const StepTimes& o) {
    for (std::size_t k = 0; k < seconds.size(); ++k) seconds[k] += o.seconds[k];
    return *this;
  }
};

// What the springs of friction and rolling keep when their stiffness changes: T and M, or T/K_T and M/K_r.
enum class Springs { keep_forces, keep_elongations };

class Solver {
 public:
  // From a state: with its memory the run goes on bit for bit; without (a new or foreign packing) lists and half-step
  // velocities are made from the packing, and spring histories from its links.
  // Throws InputError if the law is not among the supported compositions, RunError if the cell is too small.
  Solver(const State& state, const CellControl& control, SolverOptions options = {});

  void run(std::int64_t steps) {
    for (std::int64_t k = 0; k < steps; ++k) step();
  }
  void step();  // throws RunError when it blows up

  void set_drag(double rate) { drag_ = rate; }  // [1/T0] global drag -rate m v, -rate I w; 0: none
  // Other stiffnesses; the composition may not change.
  void set_law(const LawParameters& law, Springs springs = Springs::keep_forces);
  double time() const { return time_; }
  std::int64_t steps() const { return step_; }
  const PeriodicCell<2>& cell() const { return cell_; }
  const CellMotion& cell_motion() const { return cell_motion_; }
  StepTimes times() const { return times_; }
  const NeighbourLists& lists() const { return lists_; }

  // The instant as data: packing with full-step velocities and links, and the memory for a restart. Reads only.
  void snapshot(State& state) const;
  // Throws RunError if a position or velocity is not finite or grains overlap absurdly.
  void check_sanity() const;

 private:
  double advance_bodies();  // returns the bound on the relative displacement of two neighbours [a]
  void compute_forces(double time_step);
  void measure_stress();
  void load_bodies(const State& state);
  void update_lists(double displacement);
  void brake_ledger(const MotionStep& step);
  void work_ledger();
  void set_work_due();
  double viscous_power() const;
  double elastic_energy() const;

  LawParameters law_;
  CellControl control_;
  double dt_ = 0, drag_ = 0, time_ = 0;
  std::int64_t step_ = 0;
  PeriodicCell<2> cell_;
  CellMotion cell_motion_;
  CellFlow flow_;
  EnergyLedger ledger_;

  bool energies_, rotates_;
  PairForceKernel force_kernel_;
  MotionKernel motion_kernel_;
  Team team_;
  BodiesStore bodies_;
  NeighbourLists lists_;
  std::vector<MotionTally> motion_tallies_;    // by chunk
  std::vector<PairForceTally> force_tallies_;  // by group of a phase
  MotionTally motion_tally_;
  PairForceTally force_tally_;
  double smallest_diameter_ = 0, largest_diameter_ = 0, smallest_mass_ = 0;  // [a], [m]
  double prediction_ = 0.5;                                                  // [dt]
  StepTimes times_;
};

}  // namespace isostat
