// Everything a run is at one instant: the packing, and what the solver needs to go on bit for bit. Knows no system.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "dem/scene/scene.hpp"
#include "dem/state/certificate.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

// The cell's degrees of freedom (Gilabert 2007, Eq. 3).
template <int D>
struct CellMotion {
  Vec<D> reference_length{};  // [a] L0: the cell at the start of the stage; strain rate = -Ldot / L0; 0 without cell
  Vec<D> strain_rate{};       // [1/T0] at the last half step, compression positive
  Vec<D> stress{};  // [F0/a] measured sigma_11, sigma_22(, sigma_33) at `time`, kinetic and viscous parts included
  // Of a cell that shears: eps_12' and sigma_12 in the same sense, and d(tilt)/L2 summed up since the stage began.
  double shear_strain_rate = 0, shear_stress = 0, shear_strain = 0;
};

// Energy taken out of, or put into, the bodies since the start of the run; kept only when the scene asks for energies.
struct EnergyLedger {
  double viscous = 0, sliding = 0, rolling = 0, drag = 0;  // [F0 a] dissipated
  double cell_work = 0;                                    // [F0 a] done by the moving cell on the bodies
  double injected = 0;   // [F0 a] by drawing velocities, changing parameters, taking grains away (negative)
  double wall_work = 0;  // [F0 a] done by the moving container on the bodies
  // The forces at `time` act half before it and half after: the latter halves, due with the next step [F0 a].
  double viscous_due = 0, cell_work_due = 0, wall_work_due = 0;
};

// Where the run stands in the scene's stages.
template <int D>
struct StageProgress {
  std::int32_t stage = 0;         // index into Scene::stages; == size: finished
  double start_time = 0;          // [T0] when the current stage began
  bool started = false;           // the stage's opening actions (velocities, reference length) are done
  bool drag_on = false;           // the finishing drag acts
  double quiet_since = 0;         // [T0] since when only creep has been left, as seen by the checks
  std::uint64_t contact_set = 0;  // of the contacts at the last check, whatever their order
  double unchanged_since = 0;     // [T0] since when it has been the same
  double start_stiffness = 0;     // K_N [F0/a] when the stage began
  Vec<D> start_stress{};          // [F0/a] static stress sigma_11, sigma_22(, sigma_33) when the stage began
  double start_shear_stress = 0;  // [F0/a] and sigma_12
  Vec<D> ramp_stress{};           // [F0/a] imposed when the stage began, where nothing was: static
  Vec<D> ramp_rate{};             // [1/T0] strain rate imposed then
  double ramp_shear_stress = 0;   // [F0/a] and of shear
  double ramp_shear_rate = 0;     // [1/T0]
  double carried_stress = 0;      // [F0/a] that the tested direction carries, a mean over the last looks
  double carried_at = 0;          // [T0] of these the last
  double peak_stress = 0;         // [F0/a] the largest carried stress so far
  bool drifting = false;          // static solves have silenced the vibrations, but not what floppy modes still do
  std::int64_t solves = 0;        // static solves of the run so far that have moved the packing, in no time
  std::string unmet;              // of every stage so far that did not meet its end, why; empty: all did

  void add_unmet(const std::string& why) { unmet += (unmet.empty() ? "" : "; ") + why; }
};

// Where the container stands and what has left it.
struct Surroundings {
  Vec2 start_offset{};           // of the container against where it was built, when the current stage began
  double start_angle = 0;        // [rad] its turn then
  bool open = false;             // the outlet has been opened
  std::int64_t grains_left = 0;  // taken away below the outlet
  double mass_left = 0;          // of these
  double last_left = 0;          // [T0] when the last one was taken away
  friend bool operator==(const Surroundings&, const Surroundings&) = default;
};

// A system is a type with its dimension, Packing, Law, Memory and Engine, in a folder of its own (dem/systems.hpp).
template <class System>
struct State {
  static constexpr int D = System::dimension;
  typename System::Packing packing;  // positions, velocities and spins at `time`
  typename System::Law law;
  double time = 0;  // [T0]
  std::int64_t step = 0;
  double time_step = 0;  // dt [T0]
  CellMotion<D> cell_motion;
  ImposedStress<D> imposed_stress;  // of the current or last stage
  typename System::Memory memory;   // empty: no solver has touched the packing
  StageProgress<D> progress;
  Surroundings surroundings;
  EnergyLedger ledger;
  Certificate certificate;
  Scene scene;  // resolved scene: what was asked, --set applied
  std::uint64_t seed = 1;
  std::uint64_t random_counter = 0;  // draws made so far from the counter-based generator
};

}  // namespace isostat
