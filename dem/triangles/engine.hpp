// What a step does to grains of triangles: motion (velocity Verlet with the spin implicit in the dampers, or Gear's
// predictor-corrector), the container, lists of grains and candidates of triangles, overlaps, beams and their failure,
// and the traffic with a state.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "dem/solver/solver.hpp"
#include "dem/solver/team.hpp"
#include "dem/state/container_motion.hpp"
#include "dem/triangles/candidates.hpp"
#include "dem/triangles/grain_store.hpp"
#include "dem/triangles/kernel/triangle_kernels.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

class TriangleEngine {
 public:
  using Lists = NeighbourLists<GrainPairs>;
  using Cell = std::optional<PeriodicCell<2>>;
  static constexpr const char* kListAdvice = "use more grains (grains.count), or lower stage.pressure or step.fraction";

  TriangleEngine(const State<TriangleGrains>& state, const CellControl<2>& control, const SolverOptions& options);

  bool begins() const { return begins_; }
  void start_half_steps();

  Advance advance(const MotionStep<2>& step, double drag);
  void update_lists(const Cell& cell, double displacement);  // throws ListFailure
  void compute_forces(const Cell& cell, const CellFlow<2>& flow, double time_step);
  void correct();  // of Gear's scheme, with the forces at the predicted positions
  StressSums<2> sums() const;
  void keep_books();  // of the step that ends, if the ledger is kept; beams that fail in it

  void set_law(const TriangleLaw&, Springs) {}  // no stage changes it
  void snapshot(State<TriangleGrains>& state) const;
  void check_bodies(std::int64_t step) const;
  void check_overlaps(const Cell& cell, std::int64_t step) const;
  const Lists& lists() const { return *lists_; }
  const Candidates& candidates() const { return candidates_; }
  std::size_t triangles() const;

 private:
  // Sums by chunk of blocks; a number that depends on the packing alone.
  struct Chunk {
    std::size_t block_begin, block_end, slot_begin, slot_end;
  };
  void load(const State<TriangleGrains>& state);
  void cut_chunks();
  void restore_lists(const State<TriangleGrains>& state);
  void build_lists(const Cell& cell, std::vector<PairMemory<GrainHistory>> springs);
  void build_candidates(const GrainStore& store, const Cell& cell);
  void take_wall_springs(std::vector<PairMemory<GrainHistory>>& springs);
  void mark_built();
  void move_container();
  double drift(const MotionStep<2>& step);
  double predict();
  void snapshot_bodies(State<TriangleGrains>& state) const;
  void snapshot_memory(State<TriangleGrains>& state) const;
  struct SlotMotion {
    double vx, vy, spin;
  };
  SlotMotion full_step_motion(std::size_t slot) const;
  void brake_ledger(const MotionStep<2>& step);
  void add_gear_drag();
  void add_works();
  void set_work_due();
  double viscous_power() const;
  double wall_power() const;
  // Stretches, breaks and yields; true if a beam has broken.
  bool strain_beams();
  void split_grains();

  TriangleLaw law_;
  OverlapNeeds overlap_needs_;
  Integrator integrator_;
  double dt_ = 0, time_ = 0, gravity_ = 0, drag_ = 0;
  ContainerMotionScene motion_;
  Surroundings surroundings_;
  double stage_start_ = 0;
  EnergyLedger ledger_;
  bool begins_, energies_, kinetic_;
  TriangleKernels kernels_;
  Team team_;
  GrainStore store_;
  std::optional<Lists> lists_;
  Candidates candidates_;
  std::vector<Candidates::WallSpring> wall_springs_;  // between two rebuilds of candidates
  std::vector<Chunk> chunks_;
  std::vector<DriftTally> drift_tallies_;
  std::vector<BeamTally> beam_tallies_;
  std::vector<OverlapTally> overlap_tallies_;
  std::vector<AlignedVector<double>> work_;  // by thread task
  DriftTally drift_tally_;
  OverlapTally overlap_tally_;
  BeamTally beam_tally_;
  Cell cell_;
  CellFlow<2> flow_;           // of the last forces
  double smallest_reach_ = 0;  // [cm]
  double container_move_ = 0;  // [cm] by the container in the last step
  std::vector<BeamEvent> events_;
};

}  // namespace isostat
