// The interface of the pair force kernels of spheres: what one call needs and gives back, and the table from which a
// kernel is chosen once a run.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "dem/solver/isa.hpp"
#include "dem/spheres/soft_contact.hpp"
#include "dem/spheres/sphere_law.hpp"

namespace isostat::spheres {

inline constexpr std::int32_t kNotSoft = -1;

// Pairs in structure-of-arrays form, in batches of kPairBatch (dem/solver/neighbours.hpp); the rest of a group is
// padded with a pair of two far bodies.
struct PairArrays {
  const std::uint32_t* i = nullptr;  // offset of the body's row: RowOffset
  const std::uint32_t* j = nullptr;
  const std::uint8_t* shift = nullptr;  // image code 0..26 -> offset table; read in image segments only
  const double* radius_sum = nullptr;   // R_i + R_j [a]
  const double* stiffness = nullptr;    // ContactStiffness::normal
  const double* damping = nullptr;      // eta, of Hertz eta / d^(1/4) [F0 T0/a, F0 T0/a^(5/4)], see pairs.hpp
  // Of unlike bodies alone: k_T over `stiffness` at d = 1, mu, and the place of a soft contact among `soft_contacts`.
  const double* tangential_ratio = nullptr;
  const double* friction = nullptr;
  const std::int32_t* soft = nullptr;  // kNotSoft: none
  const SoftContact* soft_contacts = nullptr;
  std::array<double*, 3> tangential{};  // T on j [F0], history
  std::array<double*, 3> moment{};      // M on j [F0 a], history
};

struct PairForceInput {
  const double* rows = nullptr;   // kernel/row.hpp
  const double* spins = nullptr;  // with rolling
  double* loads = nullptr;        // accumulated
  double* moments = nullptr;      // with rolling; accumulated
  PairArrays pairs;
  std::size_t begin = 0, end = 0;
  bool images = false;  // the segment's pairs cross the edge of the cell
  SphereLaw law;
  double tangential_ratio = 0;        // k_T of a pair over its `stiffness`, at d = 1
  double time_step = 0;               // [T0]
  std::array<double, 3> flow_half{};  // Ldot_a / L_a at the half step [1/T0]; the affine part of a velocity is flow * r
  std::array<double, 3> flow_now{};   // the same, predicted to the full step
  double shear_half = 0, shear_now = 0;            // d(v_x)/dy of the flow [1/T0]; of a cell that shears
  std::array<std::array<double, 27>, 3> offset{};  // [a] of the image by its code (s1 + 1) + 3 (s2 + 1) + 9 (s3 + 1)
};

struct PairForceTally {
  std::array<double, 3> virial{};  // sum of F_a r_a over pairs, repulsion positive [F0 a]
  double shear_virial = 0;         // sum of F_1 r_2, of a cell that shears
  PairForceTally& operator+=(const PairForceTally& o) {
    for (std::size_t k = 0; k < 3; ++k) virial[k] += o.virial[k];
    shear_virial += o.shear_virial;
    return *this;
  }
};

// A fixed cell measures no stress.
enum class Tally { nothing, stress };

// How the cell carries its bodies: along its edges, each by itself, or sheared as well. A cell that does not move, and
// measures nothing, is of the first kind.
enum class Flow { stretch, shear };

using PairForceKernel = PairForceTally (*)(const PairForceInput&);

// The composition of axes that a law needs, by keyword.
struct LawComposition {
  std::string_view normal, adhesion, damping, friction, rolling;
  friend bool operator==(const LawComposition&, const LawComposition&) = default;
};
LawComposition composition(const SphereLaw& law, bool unlike = false);

// The kernel for a law, of bodies of one kind or of several; throws InputError with the list of supported compositions
// if there is none. Of a cell that shears it always measures the stress.
PairForceKernel select_kernel(const SphereLaw& law, Tally tally, Isa isa, bool unlike = false,
                              Flow flow = Flow::stretch);
std::string supported_compositions();  // one a line

}  // namespace isostat::spheres
