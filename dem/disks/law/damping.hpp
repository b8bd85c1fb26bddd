// Axis "damping": the viscous part N_v of the normal force.
#pragma once
#include <string_view>

namespace isostat::law {

struct DampingNone {
  static constexpr std::string_view keyword = "none";
  static constexpr bool acts = false;
};

// N_v = -eta dh/dt in contact only; it may pull and is not clipped (Gilabert 2007, Eqs. 5-6). eta [F0 T0/a] is zeta
// times the critical damping of the pair, precomputed when the pair is listed.
struct DampingCritical {
  static constexpr std::string_view keyword = "critical";
  static constexpr bool acts = true;
  template <class Real>
  static Real force(Real coefficient, Real receding_velocity) {
    return -coefficient * receding_velocity;
  }
};

}  // namespace isostat::law
