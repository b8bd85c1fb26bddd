// The constitutive laws of soft-particles, measured (seed 000, Sec. 4): a random polydisperse packing in a rigid shell
// is pressed against a wall or against another one, relaxed, and the force on the partner is taken; then it is rotated
// about its centre, relaxed again, and the force along the slip is taken. Units of length, mass and time are those of
// the material: SI with the defaults.
#pragma once
#include <cstdint>
#include <vector>

#include "dem/sample/insertion_scene.hpp"
#include "dem/spheres/spheres.hpp"

namespace isostat {

//   none   one solid sphere of the shell's radius against the wall
//   ball   a solid sphere that nothing moves, in place of the wall
//   cage   six walls, the faces of a cube, that close in together: as it is pressed in a packing
enum class SoftPartner { wall, soft, none, ball, cage };
inline constexpr std::array<std::string_view, 5> kSoftPartnerNames{"wall", "soft", "none", "ball", "cage"};

// How a deformation is relaxed before a force is taken:
//   paper        the approach at .05 m/s, six waits of .3 s after each of which all velocities are set to zero, one
//   more quasistatic  an approach sixteen times slower, two waits of .02 s with one stop between fire         the
//   approach of the paper, a stop, then a relaxation without dashpots that keeps the springs (FIRE,
//                Bitzek et al. 2006) to a residual of 1e-3 or 3000 steps
enum class SoftProtocol { paper, quasistatic, fire };
inline constexpr std::array<std::string_view, 3> kSoftProtocolNames{"paper", "quasistatic", "fire"};

struct Relaxation {
  double speed = 0.05;     // [m/s] of the approach, and of the surface in a rotation
  int waits = 7;           // with a stop between
  double wait = 0.3;       // [s]
  bool fire = false;       // in place of the waits
  double residual = 1e-3;  // |net forces|_2 / (sqrt(2) |contact forces|_2) that ends it
  int most_iterations = 3000;
  double step = 2;  // [dt1], see time_step_unit()
};
Relaxation relaxation_of(SoftProtocol protocol);

// What blows up is tried again with smaller steps, so often: a grain wedged between two large ones is stiffer than the
// step allows for in one of some thirty packings at step 3.
inline constexpr int kFinerSteps = 3;
inline constexpr double kFinerStep = 2.0 / 3;

struct SoftParticleTest {
  SoftPartner partner = SoftPartner::wall;
  double partner_radius = 0;  // of a ball, which stands for a solid grain that nothing moves
  Relaxation relaxation;
  InsertionScene insertion;  // of the shell: its radius is R_s
  SphereLaw law;
  double density = 2500;      // of the grains
  double soft_density = 0;    // of the soft-particles of the next decade that the insertion puts among them
  std::vector<double> delta;  // [R_s] ascending, h_n / R_s
  std::vector<double> alpha;  // [degrees] rotations from each state; empty: no tangential measurement
};
// R_s = .016 m, r_max/R_s = .5, Pi = 10, b = 3.5, beta = 3, I = 3e4; E = 5e5 N/m^2, nu = .3, mu = .3, zeta = .3
// (PHYSICS.md 3: what the paper does not give).
SoftParticleTest soft_particle_defaults(SoftPartner partner, SoftProtocol protocol);

struct NormalPoint {
  double delta = 0;            // [R_s]
  double force = 0;            // F_n on the partner; of a cage on each of its walls in the mean
  double residual = 0;         // at the measurement
  double largest_overlap = 0;  // [smaller radius] of any contact: Hertz's law wants it small
};
struct TangentialPoint {
  double delta = 0, alpha = 0;  // [R_s], [degrees]
  double normal = 0;            // F_n
  double along = 0;             // force on the partner along the slip of the contact
  double perpendicular = 0;     // and across it
};
struct SoftMeasurement {
  std::uint64_t seed = 0;
  std::size_t grains = 0;     // of one particle, with the soft-particles in it
  std::size_t softs = 0;      // these
  double solid_fraction = 0;  // volume of its grains, soft-particles among them, over that of the shell
  double density = 0;         // mass of its grains over the volume of the shell
  double exponent = 0;        // of its sizes, maximum likelihood
  double step = 0;            // [dt1] that was stable
  std::vector<NormalPoint> normal;
  std::vector<TangentialPoint> tangential;  // alpha = 0 first, the state before the rotation
};

// The stable step of the smallest grain, .35 / sqrt(4 k/m), k the stiffness of two of them at an overlap of .3 radii.
double time_step_unit(const SphereLaw& law, double density, double smallest_radius);

// One packing (two with a soft partner, the other of the next seed's stream). A pure function of test and seed. Where
// it blows up it is measured again with smaller steps. Throws InputError if the packing cannot be made, RunError if it
// blows up with the smallest.
SoftMeasurement measure_soft_particle(const SoftParticleTest& test, std::uint64_t seed);

}  // namespace isostat
