// What the user asks for: a scene of materials, cell, numerics and stages. Plain data with defaults; every field has a
// unit and a rule in dem/scene/keys.cpp, which is also where the documentation of the scene keys comes from.
//
// Reduced units: a, m, F0; without cohesion the unit of force is a P, so a cohesionless scene has pressure = 1.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isostat {

// [grains]: N disks, diameters uniform in [diameter_min, diameter_max], in random non-overlapping positions
// (the I-state of Gilabert 2007, Sec. III.A).
struct GrainsScene {
  int count = 1400;
  double solid_fraction = 0.36;  // [-] Phi_I, with sum of pi d^2 / 4 over the cell's area
  double diameter_min = 0.5;     // [a]
  double diameter_max = 1.0;     // [a]
  std::string file;              // a state or .net file to start from instead; empty: random
  friend bool operator==(const GrainsScene&, const GrainsScene&) = default;
};

// [law]: the interaction law, Gilabert 2007, Eqs. 4-10 and Table I.
struct LawScene {
  double normal_stiffness = 1e5;               // K_N [F0/a]
  std::optional<double> tangential_stiffness;  // K_T [F0/a], default K_N
  double damping = 0.8;                        // zeta [-], fraction of the critical damping of the pair (Eq. 6)
  double friction = 0.5;                       // mu [-]
  bool rolling = true;                         // rolling resistance on
  std::optional<double> rolling_friction;      // mu_r [a], default 0.01 mu a
  std::optional<double> rolling_stiffness;     // K_r [F0 a], default 1e-4 a^2 K_N
  double attraction = 1.0;                     // F0 [F0]; 0: no cohesion
  double attraction_range = 1e-3;              // D0 [a]
  friend bool operator==(const LawScene&, const LawScene&) = default;
};

// [step]: dt = fraction * sqrt(m_max / K_N).
struct StepScene {
  double fraction = 0.06;  // c [-]
  friend bool operator==(const StepScene&, const StepScene&) = default;
};

// [cell]: periodic cell and its barostat (Eq. 3).
struct CellScene {
  double inertia = 0.3;        // M in units of the sum of grain masses (PHYSICS.md: cell inertia)
  double aspect = 1.0;         // [-] L1 / L2 of the initial cell
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

enum class Finish { none, drag, newton };

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
  std::optional<double> pressure;                      // P* [F0/a] stress applied in both directions
  std::vector<double> pressures;                       // [F0/a] the stage once for each; empty in a resolved scene
  std::optional<double> stress_1, stress_2;            // [F0/a] of one direction, compression positive
  std::optional<double> strain_rate_1, strain_rate_2;  // [1/T0] of one direction, compression positive
  double velocity = 0.0;                    // V0 [V* = sqrt(F0 D0 / m)] rms velocity drawn at the start; 0: keep
  double max_strain_rate = 0.05;            // [1/T0] cap of the cell's strain rate; 0: no cap
  std::optional<double> normal_stiffness;   // K_N [F0/a] that the contacts are brought to; absent: it stays
  double stiffening_time = 200.0;           // [T0] of the exponential change of K_N
  std::string stiffening_keeps = "forces";  // of the springs: "forces" or "elongations"
  std::string until = "equilibrium";        // "aggregated", "time", "strain", "failure"
  double time = 0.0;                        // [T0] length of the stage with until = "time"
  double strain = 0.0;                      // [-] |1 - L/L0| of a driven direction that ends the stage
  double drop = 0.5;                        // [-] part of the peak stress whose loss is failure
  double max_time = 20000.0;                // [T0] give up (exit code 3) after so long
  friend bool operator==(const StageScene&, const StageScene&) = default;
};

// Stress imposed along each edge of the cell [F0/a], compression positive; none: that edge is fixed or driven.
using ImposedStress = std::array<std::optional<double>, 2>;
inline ImposedStress isotropic(std::optional<double> pressure) { return {pressure, pressure}; }
// P [F0/a]: the imposed stress of largest magnitude, with its sign; none if no edge has one.
inline std::optional<double> largest_stress(const ImposedStress& s) {
  if (!s[0] || !s[1]) return s[0] ? s[0] : s[1];
  return std::abs(*s[0]) < std::abs(*s[1]) ? s[1] : s[0];
}

ImposedStress imposed_stress(const StageScene& stage);

// [output]: observers; they read, they never touch the run.
struct OutputScene {
  std::string series;                            // CSV file of the time series; empty: none
  double series_interval = 1.0;                  // [T0]
  bool energies = false;                         // energy ledger in the series (costs a tally kernel)
  bool stages = false;                           // keep the state at the end of each stage but the last
  std::vector<double> snapshot_times;            // [T0]
  std::vector<double> snapshot_solid_fractions;  // [-]
  friend bool operator==(const OutputScene&, const OutputScene&) = default;
};

// [units]: maps the reduced run to SI in reports; absent: reduced.
struct UnitsScene {
  double length = 1.0;   // a [m]
  double density = 1.0;  // mass per area of the disks [kg/m^2] (2D)
  double force = 1.0;    // F0 [N]
  friend bool operator==(const UnitsScene&, const UnitsScene&) = default;
};

struct Scene {
  std::uint64_t seed = 1;
  GrainsScene grains;
  LawScene law;
  StepScene step;
  CellScene cell;
  EquilibriumScene equilibrium;
  FinishScene finish;
  std::vector<StageScene> stages;
  OutputScene output;
  std::optional<UnitsScene> units;
  friend bool operator==(const Scene&, const Scene&) = default;
};

// The law with every default filled in: what kernels and analysis use. A zero means the axis is absent.
struct LawParameters {
  double normal_stiffness = 0;      // K_N [F0/a]
  double tangential_stiffness = 0;  // K_T [F0/a]
  double damping = 0;               // zeta [-]
  double friction = 0;              // mu [-]
  double rolling_friction = 0;      // mu_r [a]; 0: no rolling resistance
  double rolling_stiffness = 0;     // K_r [F0 a]
  double attraction = 0;            // F0 [F0]; 0: no cohesion
  double attraction_range = 0;      // D0 [a]; 0 without cohesion
};
LawParameters resolve(const LawScene& law);

}  // namespace isostat
