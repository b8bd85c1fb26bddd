// Axes "friction" and "rolling": an elastic spring with a yield limit proportional to the repulsion N_e.
//
// The spring's force is the history (K_T u or K_r theta): clamping it every step is the elastic-perfectly-plastic law
// of Gilabert 2007, Eqs. 8 and 10. The printed Heaviside function never unloads and misses a falling N_e.
#pragma once
#include <experimental/simd>
#include <string_view>

#include "dem/disks/disk_law.hpp"
#include "dem/state/link.hpp"

namespace isostat::law {
namespace stdx = std::experimental;

struct FrictionNone {
  static constexpr std::string_view keyword = "none";
  static constexpr bool acts = false;
};

// |T| <= mu N_e, dT = -K_T du with du the displacement of j relative to i along t. K_T [F0/a], mu [-]. No viscous part.
struct FrictionCoulomb {
  static constexpr std::string_view keyword = "coulomb";
  static constexpr bool acts = true;
  static double stiffness(const DiskLaw& p) { return p.tangential_stiffness; }
  static double coefficient(const DiskLaw& p) { return p.friction; }
};

struct RollingNone {
  static constexpr std::string_view keyword = "none";
  static constexpr bool acts = false;
};

// |M| <= mu_r N_e, dM = -K_r (w_j - w_i) dt. K_r [F0 a], mu_r [a].
struct RollingElastoplastic {
  static constexpr std::string_view keyword = "elastoplastic";
  static constexpr bool acts = true;
  static double stiffness(const DiskLaw& p) { return p.rolling_stiffness; }
  static double coefficient(const DiskLaw& p) { return p.rolling_friction; }
};

// The spring after a displacement: trial force, clamped to the limit. `slipped` is the work done on the slip, times 2K:
// the mean force over the step times the part of the displacement that the spring did not take. (The elastic energy
// that the clamp takes away, (trial^2 - clamped^2) / 2K, exceeds it by a term of first order in the step.)
template <class Axis, class Real>
Real spring(const DiskLaw& p, Real force, Real displacement, Real repulsion, Real* slipped = nullptr) {
  const Real limit = Real(Axis::coefficient(p)) * repulsion;
  const Real trial = mul_add<Real>(Real(-Axis::stiffness(p)), displacement, force);
  const Real clamped = min(max(trial, -limit), limit);
  if (slipped) *slipped = (trial - clamped) * (force + clamped);
  return clamped;
}

}  // namespace isostat::law
