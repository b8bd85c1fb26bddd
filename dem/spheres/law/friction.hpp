// Axes "friction" and "rolling": springs with a limit proportional to the repulsion N_e. The spring's force is the
// history.
//
// Friction. dT = -k_T du, du the displacement of j relative to i at the contact, normal to n. The spring must not give
// back more than went in: where k_T falls, T falls with it (the elongation stays); where k_T grows, T stays (Thornton,
// Cummins, Cleary 2013 discuss the choices). |T| <= mu N_e by shortening T. The spring is carried with its contact
// (kernel/transport.hpp).
// Rolling. dM = -K_r (w_j - w_i) dt, |M| <= mu_r N_e, isotropic: twisting is resisted like rolling.
#pragma once
#include <string_view>

namespace isostat::spheres::law {

struct FrictionNone {
  static constexpr std::string_view keyword = "none";
  static constexpr bool acts = false;
};
struct FrictionCoulomb {
  static constexpr std::string_view keyword = "coulomb";
  static constexpr bool acts = true;
};

struct RollingNone {
  static constexpr std::string_view keyword = "none";
  static constexpr bool acts = false;
};
struct RollingElastoplastic {
  static constexpr std::string_view keyword = "elastoplastic";
  static constexpr bool acts = true;
};

}  // namespace isostat::spheres::law
