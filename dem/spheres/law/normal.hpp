// Axis "normal": the elastic repulsion N_e of two bodies whose overlap is d >= 0, and what follows from its stiffness.
//
// A law is a stateless type, evaluated for one pair or for a batch of pairs (Real is double-like or a SIMD vector).
// What an axis says to the others is named: `repulsion` is the reference of the Coulomb and rolling limits, `root` the
// factor by which the stiffnesses of a pair grow with its overlap, `damping_root` its square root (critical damping
// goes with the root of the stiffness).
#pragma once
#include <string_view>

#include "dem/spheres/sphere_law.hpp"

namespace isostat::spheres::law {

template <class Real>
struct Repulsion {
  Real repulsion;  // N_e [F0]
  Real root;       // k_N and k_T are proportional to it
};

// N_e = K_N d. K_N [F0/a].
struct NormalLinear {
  static constexpr std::string_view keyword = "linear";
  static constexpr bool stiffens = false;  // stiffnesses depend on the overlap
  static constexpr bool unlike = false;    // pairs have constants of their own, and some are soft
  template <class Real>
  [[gnu::always_inline]] static Repulsion<Real> force(Real stiffness, Real overlap) {
    return {stiffness * overlap, Real(1.0)};
  }
  template <class Real>
  [[gnu::always_inline]] static Real damping_root(Real root) {
    return root;
  }
};

// N_e = 4/3 E* sqrt(R*) d^(3/2) (Hertz); the stiffness of the pair is 4/3 E* sqrt(R*) [F0/a^(3/2)].
struct NormalHertz {
  static constexpr std::string_view keyword = "hertz";
  static constexpr bool stiffens = true;
  static constexpr bool unlike = false;
  template <class Real>
  [[gnu::always_inline]] static Repulsion<Real> force(Real stiffness, Real overlap) {
    const Real root = sqrt(overlap);
    return {stiffness * overlap * root, root};
  }
  template <class Real>
  [[gnu::always_inline]] static Real damping_root(Real root) {
    return sqrt(root);
  }
};

// Hertz's law of bodies of several kinds: materials, shells (radii below zero: distances to them count as negative),
// and soft-particles, whose contacts the kernel puts in lane by lane (kernel/soft_lanes.hpp).
struct NormalUnlike : NormalHertz {
  static constexpr std::string_view keyword = "hertz of unlike bodies";
  static constexpr bool unlike = true;
};

}  // namespace isostat::spheres::law
