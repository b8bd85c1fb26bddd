// Axis "normal": the elastic repulsion of two bodies in contact.
//
// A law is a stateless type, evaluated for one pair or for a batch of pairs (Real is double-like or a SIMD vector).
// What an axis says to the others is named: `repulsion` is the elastic repulsive force N_e >= 0, the reference of the
// Coulomb and rolling limits; `contact` is the mask of pairs with h < 0.
#pragma once
#include <experimental/simd>

#include "dem/disks/disk_law.hpp"

namespace isostat::law {
namespace stdx = std::experimental;

// N_e = -K_N h for h < 0 (Gilabert 2007, Sec. II.B). K_N [F0/a].
struct NormalLinear {
  template <class Real>
  static Real repulsion(const DiskLaw& p, Real gap) {
    return max(Real(-p.normal_stiffness) * gap, Real(0.0));
  }
};

}  // namespace isostat::law
