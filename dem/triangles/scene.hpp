// What the user asks for of grains of triangles: shapes, sizes, law (dem/scene/scene.hpp has the tables common to all
// systems). Units cm, g, s; Poeschel and Buchholtz 1995.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "dem/scene/arrangement.hpp"

namespace isostat {

// [grains] of triangles.
struct TriangleGrainsScene {
  int count = 100;
  std::string shape = "square";  // names or files of dem/triangles/grain_shape.hpp, separated by commas: in turn
  double size_min = 0.1;         // [cm] S of the shapes (of a file: a factor), uniform between the two
  double size_max = 0.2;
  double density = 1;            // [g/cm^2]
  double solid_fraction = 0.35;  // [-] of the region that the grains are placed in
  Arrangement arrangement = Arrangement::random;
  double speed = 50;    // [cm/s] of the left grain of a collision (Sec. 6.1), along x
  double offset = 0.5;  // [S] by which it is higher
  std::string file;     // a state to start from instead; empty: none
  friend bool operator==(const TriangleGrainsScene&, const TriangleGrainsScene&) = default;
};

enum class ContactLaw { overlap_energy, paper };
inline constexpr std::array<std::string_view, 2> kContactLawNames{"overlap-energy", "paper"};

// What becomes of a beam beyond a threshold.
enum class BeamFailure { none, break_, yield };
inline constexpr std::array<std::string_view, 3> kBeamFailureNames{"none", "break", "yield"};

// [law] of triangles.
struct TriangleLawScene {
  ContactLaw contact = ContactLaw::overlap_energy;
  double modulus = 2e7;               // Y [g/(cm s^2)]
  double overlap_length = 0;          // L_c [cm]; 0: harmonic mean of the roots of the grains' areas, times 2/2
  double friction = 0;                // mu [-]
  double tangential_stiffness = 1e5;  // k_t [g/s^2] of the friction spring of an overlap
  double stiffness = 1e5;             // E [g/s^2] of the beams
  double bending = 10;                // E I [g cm^3/s^2]
  double damping = 9;                 // gamma [g/s] of the beams
  BeamFailure failure = BeamFailure::none;
  std::optional<double> limit_tension;  // [dyn] -N of a beam; absent, as the others: never
  std::optional<double> limit_shear;    // [dyn] |T|
  std::optional<double> limit_bending;  // [dyn cm] the larger |end moment|
  std::optional<double> limit_stretch;  // [-] |L/L0 - 1|
  std::optional<double> limit_angle;    // [rad] the larger |T_a|, |T_b|
  friend bool operator==(const TriangleLawScene&, const TriangleLawScene&) = default;
};

}  // namespace isostat
