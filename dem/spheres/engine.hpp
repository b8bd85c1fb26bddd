// What a step does to spheres: leapfrog motion, walls that move, neighbour lists, forces of pairs and of walls, and the
// traffic of bodies and links with a state. Between steps, measurements may ask for forces and interfere
// (Solver::engine()).
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "dem/solver/neighbours.hpp"
#include "dem/solver/solver.hpp"
#include "dem/solver/team.hpp"
#include "dem/spheres/kernel/pair_force.hpp"
#include "dem/spheres/motion.hpp"
#include "dem/spheres/pairs.hpp"
#include "dem/spheres/sphere_store.hpp"
#include "dem/spheres/spheres.hpp"

namespace isostat {

class SphereEngine {
 public:
  using Lists = NeighbourLists<SpherePairs>;
  using Cell = std::optional<PeriodicCell<3>>;
  static constexpr bool kShears = true;  // with the cell
  static constexpr const char* kListAdvice = "use more grains (grains.count), or lower stage.pressure or step.fraction";

  // Throws InputError: energies are asked for, grains that are parts of a container, walls in a cell that moves.
  SphereEngine(const State<Spheres>& state, const CellControl<3>& control, const SolverOptions& options);

  // Without memory the half-step velocities follow from the first forces: compute_forces(), then start_half_steps().
  bool begins() const { return begins_; }
  void start_half_steps();

  Advance advance(const MotionStep<3>& step, double drag);   // all bodies and walls
  void update_lists(const Cell& cell, double displacement);  // throws ListFailure
  void compute_forces(const Cell& cell, const CellFlow<3>& flow, double time_step);
  void correct() {}  // of a predictor-corrector: leapfrog has none
  StressSums<3> sums() const;
  void keep_books() {}  // no energy ledger

  // Another law, of any supported composition; the attraction must not reach further than before (std::logic_error).
  void set_law(const SphereLaw& law, Springs springs);
  void snapshot(State<Spheres>& state) const;  // packing, memory and law
  // Throw RunError, which names the step: a body that is lost or flies, grains that overlap absurdly.
  void check_bodies(std::int64_t step) const;
  void check_overlaps(const Cell& cell, std::int64_t step) const;
  const Lists& lists() const { return lists_; }

  // Forces of the instant by the law at rest, springs included, viscous parts not [F0].
  const std::vector<SphereWall>& walls() const { return walls_; }
  Vec3 force_on_wall(std::size_t wall) const;
  Vec3 force_between(std::int32_t from, std::int32_t on) const;  // of the bodies of one group on those of the other
  double squared_contact_forces() const;                         // sum of N^2 + T^2 over pairs and walls [F0^2]

  // Interference. A group's walls go with it; walls of every group do not.
  void boost(std::int32_t group, const Vec3& velocity);  // adds it
  // The group rigidly about an axis (a unit vector) through the centre: positions, velocities, spins, loads, springs
  // inside the group and at its walls; springs that join it to others are stretched. Without a cell only
  // (std::logic_error).
  void rotate(std::int32_t group, const Vec3& axis, double angle, const Vec3& centre);
  void set_wall_velocity(std::size_t wall, const Vec3& velocity);
  void stop();  // every velocity and spin is zero, of walls too

  // A relaxation (FIRE: Bitzek et al. 2006) in coordinates weighted by mass and inertia, on half-step velocities and
  // the forces of the instant; free of viscous parts under a law without damping.
  struct Relaxation {
    double power = 0;          // sum of F.v + M.w [F0 a/T0]
    double speed_squared = 0;  // sum of m v^2 + I w^2
    double pull_squared = 0;   // sum of F^2/m + M^2/I
    double force_squared = 0;  // sum of F^2 [F0^2]
  };
  Relaxation relaxation() const;
  void steer(double keep, double push);  // v <- keep v + push F/m, w <- keep w + push M/I

 private:
  template <class Stretched>
  void stretch_springs_out_of(std::int32_t group, Stretched&& stretched);
  void load_bodies(const State<Spheres>& state);
  void load_springs(const State<Spheres>& state);
  void lists_are_new();  // what follows from the inner list
  void find_near_walls();
  void add_wall_loads(double time_step);
  void snapshot_bodies(State<Spheres>& state) const;
  void snapshot_links(State<Spheres>& state) const;
  void snapshot_walls(State<Spheres>& state) const;
  Vec3 branch(std::int32_t i, std::int32_t j, std::uint8_t shift, const Cell& cell) const;
  Vec3 force_at_rest(std::size_t place, std::int32_t i, std::int32_t j, std::uint8_t shift) const;  // on j
  Vec3 wall_force_at_rest(const NearWall& near) const;                                              // on the sphere
  void choose_kernels();
  double stiffest_contact() const;  // k_N/m [1/T0^2] when the inner list was made

  SphereLaw law_;
  double dt_ = 0, gravity_ = 0;  // [T0], [a/T0^2]
  Isa isa_;
  bool begins_, free_cell_, shears_, has_groups_, unlike_, rotates_ = false;
  spheres::PairForceKernel force_kernel_ = nullptr;
  SphereMotionKernel motion_kernel_ = nullptr, next_motion_kernel_ = nullptr;  // the next one differs after a restart
  Team team_;
  SphereStore bodies_;
  Lists lists_;
  std::size_t rebuilds_seen_ = 0;
  std::vector<SphereWall> walls_;
  std::vector<std::size_t> near_begin_;                 // of a chunk of bodies, in the store's near_walls
  std::vector<SphereMotionTally> motion_tallies_;       // by chunk
  std::vector<spheres::PairForceTally> force_tallies_;  // by group of a phase
  SphereMotionTally motion_tally_;
  spheres::PairForceTally force_tally_;
  Cell cell_;                                            // of the last forces
  CellFlow<3> flow_;                                     // of the last forces
  double smallest_diameter_ = 0, largest_diameter_ = 0;  // [a]
  double prediction_ = 0.5;                              // [dt]
};

}  // namespace isostat
