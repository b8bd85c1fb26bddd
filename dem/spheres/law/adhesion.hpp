// Axis "adhesion": the attractive part N_a of the normal force; `none` looks at no pair beyond contact.
#pragma once
#include <string_view>

#include "dem/spheres/sphere_law.hpp"

namespace isostat::spheres::law {

struct AdhesionNone {
  static constexpr std::string_view keyword = "none";
  static constexpr bool acts = false;
};

// N_a = -F0 in contact, -F0 (1 - h/D0) for 0 <= h <= D0 (Gilabert 2007, Eq. 4). F0 [F0], D0 [a].
struct AdhesionLinear {
  static constexpr std::string_view keyword = "linear";
  static constexpr bool acts = true;
  template <class Real>
  [[gnu::always_inline]] static Real force(const SphereLaw& p, Real gap) {
    const Real reach = Real(1.0) - max(gap, Real(0.0)) * Real(1.0 / p.attraction_range);
    return Real(-p.attraction) * max(reach, Real(0.0));
  }
};

}  // namespace isostat::spheres::law
