// Axis "damping": the viscous parts of the contact force, in contact only.
#pragma once
#include <string_view>

namespace isostat::spheres::law {

struct DampingNone {
  static constexpr std::string_view keyword = "none";
  static constexpr bool acts = false;
};

// N_v = -eta dh/dt with eta = 2 zeta sqrt(m_r k_N(d)) [F0 T0/a], zeta of the critical damping at the overlap (Tsuji,
// Tanaka, Ishida 1992: of a Hertz contact eta ~ d^(1/4), and restitution does not depend on the speed). It may pull and
// is not clipped. With friction, -tangential_damping eta v_T beside the spring; the sum of both has the Coulomb limit.
struct DampingCritical {
  static constexpr std::string_view keyword = "critical";
  static constexpr bool acts = true;
};

}  // namespace isostat::spheres::law
