// What a step does to disks: leapfrog motion, a container that moves by itself, neighbour lists, forces of pairs and of
// smooth walls, the energy ledger, and the traffic of bodies and links with a state.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "dem/disks/bodies_store.hpp"
#include "dem/disks/disks.hpp"
#include "dem/disks/kernel/pair_force.hpp"
#include "dem/disks/motion.hpp"
#include "dem/disks/pairs.hpp"
#include "dem/disks/wall_contacts.hpp"
#include "dem/solver/neighbours.hpp"
#include "dem/solver/solver.hpp"
#include "dem/solver/team.hpp"
#include "dem/state/container_motion.hpp"

namespace isostat {

class DiskEngine {
 public:
  using Lists = NeighbourLists<DiskPairs>;
  using Cell = std::optional<PeriodicCell<2>>;
  static constexpr bool kShears = true;  // with the cell
  static constexpr const char* kListAdvice = "use more grains (grains.count), or lower stage.pressure or step.fraction";

  DiskEngine(const State<Disks>& state, const CellControl<2>& control, const SolverOptions& options);

  // Without memory the half-step velocities follow from the first forces: compute_forces(), then start_half_steps().
  bool begins() const { return begins_; }
  void start_half_steps();

  Advance advance(const MotionStep<2>& step, double drag);   // all bodies
  void update_lists(const Cell& cell, double displacement);  // throws ListFailure
  void compute_forces(const Cell& cell, const CellFlow<2>& flow, double time_step);
  void correct() {}  // of a predictor-corrector: leapfrog has none
  StressSums<2> sums() const;
  void keep_books();  // of the step that ends, if the ledger is kept

  void set_law(const DiskLaw& law, Springs springs);
  void snapshot(State<Disks>& state) const;  // packing, memory, law and ledger
  // Throw RunError, which names the step: a body that is lost or flies, grains that overlap absurdly.
  void check_bodies(std::int64_t step) const;
  void check_overlaps(const Cell& cell, std::int64_t step) const;
  const Lists& lists() const { return lists_; }

 private:
  void load_bodies(const State<Disks>& state);
  void load_walls(const State<Disks>& state);
  void load_feet(const DiskMemory& memory);
  void move_container(double time);
  double place_walls();  // rows of the container's bodies; their largest speed [a/T0]
  void list_walls(std::vector<WallContacts::Spring> springs);
  void snapshot_bodies(State<Disks>& state) const;
  void snapshot_feet(State<Disks>& state) const;
  void snapshot_links(State<Disks>& state) const;
  std::vector<std::size_t> touching_walls() const;  // places of wall contacts, by the ids of their disks
  // visit(columns, place in them, i, j, shift code) for every listed pair, those with feet last.
  template <class Self, class Visit>
  static void for_each_pair(Self& self, Visit&& visit) {
    self.lists_.for_each([&](std::size_t k, std::int32_t i, std::int32_t j, std::uint8_t shift) {
      visit(self.lists_.columns(), k, i, j, shift);
    });
    self.walls_.for_each(
        [&](std::size_t k, std::int32_t i, std::int32_t j) { visit(self.walls_.columns(), k, i, j, kNoImage<2>); });
  }
  Vec2 branch(std::int32_t i, std::int32_t j, std::uint8_t shift, const Cell& cell) const;
  void brake_ledger(const MotionStep<2>& step, double drag);
  void set_work_due();
  double viscous_power() const;
  double wall_power() const;
  double elastic_energy() const;

  DiskLaw law_;
  double dt_ = 0, gravity_ = 0;  // [T0], [a/T0^2]
  EnergyLedger ledger_;
  bool begins_, energies_, rotates_;
  PairForceKernel force_kernel_, wall_kernel_;
  MotionKernel motion_kernel_;
  Team team_;
  BodiesStore bodies_;
  Lists lists_;
  WallContacts walls_;
  std::vector<MotionTally> motion_tallies_;    // by chunk
  std::vector<PairForceTally> force_tallies_;  // by group of a phase
  MotionTally motion_tally_;
  PairForceTally force_tally_;
  Cell cell_;                                                                // of the last forces
  CellFlow<2> flow_;                                                         // of the last forces
  double smallest_diameter_ = 0, largest_diameter_ = 0, smallest_mass_ = 0;  // [a], [m]
  double prediction_ = 0.5;                                                  // [dt]
  ContainerMotionScene container_motion_;                                    // of the stage
  Surroundings surroundings_;                                                // when it began
  double stage_start_ = 0;                                                   // [T0]
  ContainerStep container_;                                                  // in the step that ends now
  std::vector<std::int64_t> ids_;                                            // sorted, where there are smooth walls
};

}  // namespace isostat
