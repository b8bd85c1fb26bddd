// The kernels of the triangle engine: what they are given, and how one is chosen for a law and an instruction set.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "dem/solver/isa.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

// ---- overlaps
// --------------------------------------------------------------------------------------------------------

// Near pairs of triangles, packed: a pack is eight pairs of grains, a lane each; its rows are the pairs of triangles of
// the lane's grains that may touch. Areas of a pair of grains so add up within a lane, and one pressure serves them
// all.
struct OverlapPack {
  std::uint32_t first = 0;  // row r of lane l is the pair a[first + 8 r + l], b[...]
  std::uint32_t rows = 0;
  std::uint32_t first_seen = 0;  // its triangles that no pack before it in its group has: from here on in `seen`
};

struct OverlapInput {
  const OverlapPack* packs = nullptr;  // begin .. end, and one more
  std::size_t begin = 0, end = 0;
  const std::uint32_t *a = nullptr, *b = nullptr;         // slots
  const std::uint32_t* seen = nullptr;                    // slots, each as a pack is the first of its group to have it
  const double* stiffness = nullptr;                      // [8 pack + lane] Y/L_c [g/(cm s)^2 ...]: pressure per area
  const double *offset_x = nullptr, *offset_y = nullptr;  // [cm] of grain b's image
  double* spring = nullptr;                               // [dyn] T of the lane; friction only
  const double* rows = nullptr;                           // corners of slots (kernel/rows.hpp)
  double* loads = nullptr;
  const double *px = nullptr, *py = nullptr, *pw = nullptr, *x = nullptr,
               *y = nullptr;  // predicted velocities; friction
  double* work = nullptr;     // of kOverlapWork doubles a row of the longest pack
  double modulus = 0, friction = 0, spring_stiffness = 0, time_step = 0;
};
inline constexpr std::size_t kOverlapWork = 8 * 8;

struct OverlapTally {
  double virial[2] = {0, 0};  // sum over pairs of triangles of F_a r_a, F on the second
  double slipped = 0;         // [erg] work of sliding
  OverlapTally& operator+=(const OverlapTally& o) {
    for (int k = 0; k < 2; ++k) virial[k] += o.virial[k];
    slipped += o.slipped;
    return *this;
  }
};

struct OverlapNeeds {
  ContactLaw law = ContactLaw::overlap_energy;
  bool friction = false, virial = false;
};
using OverlapKernel = OverlapTally (*)(const OverlapInput&);

// ---- grains: beams and motion
// ------------------------------------------------------------------------------------------

// Eight grains of one topology, a lane each: triangle t of lane l is slot begin + 8 t + l, beam b of lane l place
// beam_begin + 8 b + l of the arrays over beams.
struct GrainBlock {
  std::uint32_t begin = 0, beam_begin = 0;
  std::uint16_t triangles = 0, beams = 0;
  const std::array<std::uint16_t, 2>* joined = nullptr;  // of each beam: its two triangles within the grain
};

// Arrays over slots and over beams. Constants of a beam: rest directions in both body frames, EI/L0, gamma (EI/E)/L0.
struct GrainArrays {
  double *x, *y, *angle, *cosine, *sine;                // [cm], [rad]
  double *ux, *uy, *uw;                                 // velocity at the half step [cm/s], [rad/s]
  double *px, *py, *pw;                                 // predicted for the full step
  double *fx, *fy, *torque;                             // total load [dyn, dyn cm], weight left out
  const double *mass, *inverse_mass, *inverse_inertia;  // inverse: 0 for what is driven and for padding
  const double *reach, *heavy;  // of the circle about the centroid [cm]; 1, or 0 for what has no weight
  const double* corner[6];      // x0 y0 x1 y1 x2 y2 in the body frame [cm]
  double *rows, *loads;
  double *length, *xi, *yi, *xj, *yj;                        // of beams: L0, rest directions
  double *stretching, *bending, *damping, *bending_damping;  // E, EI/L0, gamma, gamma I/L0
};

struct BeamInput {
  const GrainBlock* blocks = nullptr;
  std::size_t begin = 0, end = 0;
  GrainArrays arrays{};
  double half_step = 0;     // dt/2 [s]: of the spin that the dampers see; 0: it is known
  double flow[2] = {0, 0};  // [1/s] velocity gradient of the cell, along its edges
  double* work = nullptr;   // 8 (4 triangles + 2 beams) doubles
};
struct BeamTally {
  double virial[2] = {0, 0};
  BeamTally& operator+=(const BeamTally& o) {
    virial[0] += o.virial[0], virial[1] += o.virial[1];
    return *this;
  }
};
struct BeamNeeds {
  bool damping = true, virial = false;
};
using BeamKernel = BeamTally (*)(const BeamInput&);

struct DriftInput {
  std::size_t begin = 0, end = 0;  // slots; multiples of 8
  GrainArrays arrays{};
  double time_step = 0;
  double scale[2] = {1, 1}, drift[2] = {0, 0}, keep[2] = {1, 1}, keep_spin = 1;  // see MotionStep<2>
  double weight = 0;                                                             // [cm/s^2] downward acceleration
};
struct DriftTally {
  double speed_squared = 0, surface_speed = 0;  // largest |v|^2 and largest reach |w|
  double kinetic[2] = {0, 0};                   // sum of m v_a^2
};
using DriftKernel = DriftTally (*)(const DriftInput&);
// Corners of slots begin .. end from positions and angles.
using CornerKernel = void (*)(std::size_t begin, std::size_t end, const GrainArrays&);

// Pairs (a, b) of slots whose triangles are nearer than `skin` by the largest separation over the six edge normals,
// which is a lower bound of the distance: near[k] is set to 1 or 0.
struct SeparationInput {
  std::size_t count = 0;  // a multiple of 8
  const std::uint32_t *a = nullptr, *b = nullptr;
  const double *offset_x = nullptr, *offset_y = nullptr;
  const double* rows = nullptr;
  double skin = 0;
  std::uint8_t* near = nullptr;
};
using SeparationKernel = void (*)(const SeparationInput&);

struct TriangleKernels {
  OverlapKernel overlap;
  BeamKernel beams;
  DriftKernel drift;
  CornerKernel corners;
  SeparationKernel separation;
};
namespace kernel {  // of one instruction set
TriangleKernels triangle_kernels_scalar(const OverlapNeeds& overlap, const BeamNeeds& beams, bool kinetic);
TriangleKernels triangle_kernels_avx2(const OverlapNeeds& overlap, const BeamNeeds& beams, bool kinetic);
TriangleKernels triangle_kernels_avx512(const OverlapNeeds& overlap, const BeamNeeds& beams, bool kinetic);
}  // namespace kernel
TriangleKernels triangle_kernels(const OverlapNeeds& overlap, const BeamNeeds& beams, bool kinetic, Isa isa);

}  // namespace isostat
