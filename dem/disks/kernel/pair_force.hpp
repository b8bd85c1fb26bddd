// The interface of the pair force kernels: what one call needs and gives back, and the table from which a kernel is
// chosen once a run.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "dem/disks/disk_law.hpp"
#include "dem/solver/isa.hpp"

namespace isostat {

// What a kernel sums up beside the forces. A fixed cell measures no stress; the energy ledger is paid for on request.
enum class Tally { nothing, stress, energy };

// How the cell carries its bodies: along its edges, each by itself, or sheared as well. A cell that does not move, and
// measures nothing, is of the first kind.
enum class Flow { stretch, shear };

// Pairs in structure-of-arrays form, in batches of kPairBatch (dem/solver/neighbours.hpp); the rest of a group is
// padded with a pair of two far bodies.
struct PairArrays {
  const std::uint32_t* i = nullptr;  // offset of the body's row: kernel::RowOffset
  const std::uint32_t* j = nullptr;
  const std::uint8_t* shift = nullptr;  // image code 0..8 -> offset table; read in image segments only
  const double* damping = nullptr;      // eta [F0 T0/a]
  const double* radius_sum = nullptr;   // R_i + R_j [a]
  double* tangential = nullptr;         // T [F0], history
  double* moment = nullptr;             // M [F0 a], history
};

struct PairForceInput {
  const double* rows = nullptr;  // kernel/row.hpp
  double* loads = nullptr;       // accumulated
  PairArrays pairs;
  std::size_t begin = 0, end = 0;
  bool images = false;  // the segment's pairs cross the edge of the cell
  DiskLaw law;
  double time_step = 0;          // [T0]
  double flow_half[2] = {0, 0};  // Ldot_a / L_a at the half step [1/T0]; the affine part of a velocity is flow * r
  double flow_now[2] = {0, 0};   // the same, predicted to the full step
  double offset_x[16] = {}, offset_y[16] = {};  // [a] of the image by its code (s1 + 1) + 3 (s2 + 1), 9 of them in use
  double shear_half = 0, shear_now = 0;         // [1/T0] d(v_x)/dy of the flow; of a cell that shears
};

struct PairForceTally {
  double virial[2] = {0, 0};  // sum of F_a r_a over pairs, repulsion positive [F0 a]
  double sliding = 0;         // energy dissipated in this step [F0 a]
  double rolling = 0;
  double shear_virial = 0;  // sum of F_1 r_2, of a cell that shears
  PairForceTally& operator+=(const PairForceTally& o) {
    virial[0] += o.virial[0], virial[1] += o.virial[1];
    sliding += o.sliding, rolling += o.rolling;
    shear_virial += o.shear_virial;
    return *this;
  }
};

using PairForceKernel = PairForceTally (*)(const PairForceInput&);

// The composition of axes that a law needs, by keyword.
struct LawComposition {
  std::string_view adhesion, damping, friction, rolling;
  friend bool operator==(const LawComposition&, const LawComposition&) = default;
};
LawComposition composition(const DiskLaw& law);

// The kernel for a law; throws InputError with the list of supported compositions if there is none.
PairForceKernel select_kernel(const DiskLaw& law, Tally tally, Isa isa, Flow flow = Flow::stretch);
std::string supported_compositions();  // one a line

}  // namespace isostat
