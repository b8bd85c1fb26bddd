// What the user asks for: a scene of materials, cell, numerics and stages. Plain data with defaults; every field has a
// unit and a rule in the table of keys (dem/scene/keys.cpp, and keys.cpp of each system), where the documentation of
// the keys comes from, too.
//
// Reduced units: a, m, F0; without cohesion the unit of force is a P, so a cohesionless scene has pressure = 1.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem/disks/scene.hpp"
#include "dem/scene/surroundings.hpp"
#include "dem/spheres/scene.hpp"
#include "dem/triangles/scene.hpp"

namespace isostat {

// Which system a scene is of: the key `system`, disks where it is absent.
enum class SceneSystem { disks, triangles, spheres };
inline constexpr std::array<std::string_view, 3> kSystemNames{"disks", "triangles", "spheres"};
constexpr std::string_view name(SceneSystem system) { return kSystemNames[static_cast<std::size_t>(system)]; }
constexpr std::string_view time_unit(SceneSystem system) { return system == SceneSystem::triangles ? "s" : "T0"; }

enum class Integrator { verlet, gear };
inline constexpr std::array<std::string_view, 2> kIntegratorNames{"verlet", "gear"};

// [step]: of disks dt = fraction * sqrt(m_max / K_N), of triangles dt = fraction / omega_max of the smallest grain, of
// spheres fraction * sqrt(m / k) of the smallest.
struct StepScene {
  std::optional<double> fraction;  // c [-]; absent: the default of the system, or what its smallest grains bear
  Integrator integrator = Integrator::verlet;
  friend bool operator==(const StepScene&, const StepScene&) = default;
};

// [cell]: periodic cell and its barostat (Eq. 3).
struct CellScene {
  double inertia = 0.3;        // M in units of the sum of grain masses (PHYSICS.md: cell inertia)
  double aspect = 1.0;         // [-] L1 / L2 of the initial cell
  double damping = 0;          // [1/T0] of its strain rate under an imposed stress; the paper has none
  bool rate_coupling = false;  // add -(Ldot/L) v to the peculiar acceleration
  friend bool operator==(const CellScene&, const CellScene&) = default;
};

// [equilibrium]: Sec. II.D, in units of F1 = max(F0, a P).
struct EquilibriumScene {
  double force = 1e-4;           // [F1] net force on a grain; also [F1 a] net moment
  double pressure = 1e-4;        // [F1/a] imposed minus measured stress, each free direction
  double kinetic_energy = 5e-8;  // [F1 a] per grain
  friend bool operator==(const EquilibriumScene&, const EquilibriumScene&) = default;
};

// Choices of a key are enumerators, in the order of their names.
enum class Finish { none, drag, newton };
inline constexpr std::array<std::string_view, 3> kFinishNames{"none", "drag", "newton"};

// What ends a stage.
enum class Until { equilibrium, aggregated, time, strain, failure, empty, clogged, separated };
inline constexpr std::array<std::string_view, 8> kUntilNames{"equilibrium", "aggregated", "time",    "strain",
                                                             "failure",     "empty",      "clogged", "separated"};
static_assert(kUntilNames.size() == static_cast<std::size_t>(Until::separated) + 1, "a name for each end, no more");
constexpr std::string_view name(Until until) { return kUntilNames[static_cast<std::size_t>(until)]; }
constexpr bool waits_for_equilibrium(Until until) { return until == Until::equilibrium || until == Until::aggregated; }
constexpr bool ends_with_event(Until until) {  // of the surroundings
  return until == Until::empty || until == Until::clogged || until == Until::separated;
}

// What the springs of friction and rolling keep when their stiffness changes: T and M, or T/K_T and M/K_r.
enum class Springs { keep_forces, keep_elongations };
inline constexpr std::array<std::string_view, 2> kSpringsNames{"forces", "elongations"};

// Whose root mean square stage.velocity is: |v|, or each component of v (the standard deviation of a Maxwell
// distribution, sqrt(D) times less than that of |v|).
enum class VelocityOf { vector, component };
inline constexpr std::array<std::string_view, 2> kVelocityOfNames{"vector", "component"};

// [finish]: what ends a stage faster than the bare law does; "none" is the paper.
struct FinishScene {
  Finish method = Finish::none;
  double drag = 0.5;              // [1/T0] rate of the global drag -drag * m * v
  double quiet_time = 10.0;       // [T0] begin when a network that carries the stress has met the kinetic criterion
                                  // for so long
  double unchanged_time = 100.0;  // [T0] or when its contacts have not changed for so long
  friend bool operator==(const FinishScene&, const FinishScene&) = default;
};

// [[stage]]: one step of the history of a sample. Each direction of the cell has an imposed stress, or an imposed
// strain rate, or stays fixed.
struct StageScene {
  std::optional<double> pressure;  // P* [F0/a] stress applied in both directions
  std::vector<double> pressures;   // [F0/a] the stage once for each; empty in a resolved scene
  // Of one direction, compression positive [F0/a], [1/T0]; the third in space only.
  std::optional<double> stress_1, stress_2, stress_3;
  std::optional<double> strain_rate_1, strain_rate_2, strain_rate_3;
  std::optional<double> stress_12;   // [F0/a] shear stress sigma_12; of disks
  std::optional<double> shear_rate;  // [1/T0] d(tilt)/dt / L2 in place of it; of disks
  double ramp_time = 0;              // [T0] in which imposed stresses and rates come to these values; 0: at once
  double velocity = 0.0;  // V0 [V*, velocity_unit() of dem/solver/agitation.hpp] rms drawn at the start; 0: keep
  VelocityOf velocity_of = VelocityOf::vector;
  double max_strain_rate = 0.05;           // [1/T0] cap of the cell's strain rate; 0: no cap
  std::optional<double> max_edge_speed;    // [a/T0] cap of |Ldot| of each edge that a stress controls; absent: none
  std::optional<double> normal_stiffness;  // K_N [F0/a] that the contacts are brought to; absent: it stays
  double stiffening_time = 200.0;          // [T0] of the exponential change of K_N
  Springs stiffening_keeps = Springs::keep_forces;
  std::optional<double> friction;  // mu of spheres from this stage on; absent: it stays
  bool stop = false;               // spheres and walls stand still when it begins
  double approach = 0;             // [a/T0] speed of the first soft-particle towards its partner
  Until until = Until::equilibrium;
  double time = 0.0;          // [T0] length of the stage with until = "time"
  double strain = 0.0;        // [-] |1 - L/L0| of a driven direction, or the shear strain, that ends the stage
  double drop = 0.5;          // [-] part of the peak stress whose loss is failure
  double max_time = 20000.0;  // [T0] give up (exit code 3) after so long
  ContainerMotionScene container;
  std::array<std::optional<double>, 3> stresses() const { return {stress_1, stress_2, stress_3}; }
  std::array<std::optional<double>, 3> strain_rates() const { return {strain_rate_1, strain_rate_2, strain_rate_3}; }
  // Strain rates other than 0: of a driven cell.
  bool driven(int direction) const { return strain_rates()[static_cast<std::size_t>(direction)].value_or(0) != 0; }
  bool shear_driven() const { return shear_rate.value_or(0) != 0; }
  bool driven() const { return driven(0) || driven(1) || driven(2) || shear_driven(); }
  friend bool operator==(const StageScene&, const StageScene&) = default;
};

// Stress imposed along each edge of the cell [F0/a], compression positive; none: that edge is fixed or driven. The
// shear stress sigma_12 likewise, work-conjugate to the strain -d(tilt)/L2.
template <int D>
struct ImposedStress : std::array<std::optional<double>, D> {
  std::optional<double> shear = std::nullopt;
  friend bool operator==(const ImposedStress&, const ImposedStress&) = default;
};
template <int D>
ImposedStress<D> isotropic(std::optional<double> pressure) {
  ImposedStress<D> stress;
  stress.fill(pressure);
  return stress;
}
// P [F0/a]: the imposed stress of largest magnitude, with its sign, the shear stress where no edge has one; none if
// nothing is imposed.
template <int D>
std::optional<double> largest_stress(const ImposedStress<D>& stress) {
  std::optional<double> largest;
  for (const std::optional<double>& s : stress)
    if (s && (!largest || std::abs(*largest) < std::abs(*s))) largest = s;
  return largest ? largest : stress.shear;
}

template <int D>
ImposedStress<D> imposed_stress(const StageScene& stage) {
  ImposedStress<D> imposed = isotropic<D>(stage.pressure);
  for (std::size_t a = 0; a < D; ++a)
    if (stage.stresses()[a] || stage.strain_rates()[a]) imposed[a] = stage.stresses()[a];
  imposed.shear = stage.stress_12;
  return imposed;
}

// [output]: observers; they read, they never touch the run.
struct OutputScene {
  std::string series;                            // CSV file of the time series; empty: none
  double series_interval = 1.0;                  // [T0]
  bool energies = false;                         // energy ledger in the series (costs a tally kernel)
  bool stages = false;                           // keep the state at the end of each stage but the last
  std::optional<double> snapshot_interval;       // [T0] none: only at the times and solid fractions
  std::vector<double> snapshot_times;            // [T0]
  std::vector<double> snapshot_solid_fractions;  // [-]
  bool keeps_snapshots() const {
    return snapshot_interval || !snapshot_times.empty() || !snapshot_solid_fractions.empty();
  }
  friend bool operator==(const OutputScene&, const OutputScene&) = default;
};

struct Scene {
  SceneSystem system = SceneSystem::disks;
  std::uint64_t seed = 1;
  GrainsScene grains;                   // of disks
  TriangleGrainsScene triangle_grains;  // of triangles
  SphereGrainsScene sphere_grains;      // of spheres
  LawScene law;
  TriangleLawScene triangle_law;
  SphereLawScene sphere_law;
  double gravity = 0;  // weight per mass, along -y
  ContainerScene container;
  StepScene step;
  CellScene cell;
  EquilibriumScene equilibrium;
  FinishScene finish;
  std::vector<StageScene> stages;
  OutputScene output;
  std::optional<UnitsScene> units;
  friend bool operator==(const Scene&, const Scene&) = default;
};

// Two grains collide in free space.
inline bool is_collision(const Scene& s) {
  const auto collide = [](const auto& grains) {
    return grains.file.empty() && grains.arrangement == Arrangement::collision;
  };
  return (s.system == SceneSystem::disks && collide(s.grains)) ||
         (s.system == SceneSystem::triangles && collide(s.triangle_grains));
}

// A scene of this system without keys, with so many stages without keys: the defaults of times and rates go with the
// units of a system.
Scene default_scene(SceneSystem system, std::size_t stages = 0);

}  // namespace isostat
