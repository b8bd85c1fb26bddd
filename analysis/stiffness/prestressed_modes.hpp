// Vibration modes of the full tangent, stiffness and prestress: T u = omega^2 M u in a fixed cell. T is not symmetric
// under tangential forces (T does not follow from an energy), so omega^2 may be complex: flutter.
#pragma once
#include <complex>
#include <vector>

#include "analysis/input.hpp"
#include "dem/scene/scene.hpp"

namespace isostat {

struct PrestressedModes {
  std::int64_t pieces = 0;         // connected components of the graph of links with at least two grains or a loop;
                                   // the two translations of each are null on both sides and are left out exactly,
                                   // unless it holds on to a wall
  std::int64_t unlinked_dofs = 0;  // of grains without any link, left out too
  std::vector<std::complex<double>> omega_squared;  // [1/T0^2] ascending magnitude; conjugates both stand here
  std::vector<double> residual;                     // |T u - omega^2 M u| of each, in units of mass, for unit u,
                                                    // over the largest diagonal entry of M^-1/2 T M^-1/2
  double shift = 0;                                 // sigma of (T - sigma M)^-1 [1/T0^2]; 0: only dense pieces
  double antisymmetric_part = 0;                    // |T - T^T| / |T + T^T|, Frobenius
  bool converged = true;                            // false: Arnoldi stopped before all were found
};

// The `count` of smallest |omega^2|, one more if that would part a complex pair. Mechanisms of G are among them:
// prestress stiffens them or makes them unstable (negative omega^2); what it leaves alone comes out as rounding, near
// 0. Pieces up to kDensePiece dofs by dense QR, larger ones by Arnoldi (Spectra) on the inverse about `shift`
// (UMFPACK). Throws InputError for grains without mass, FactorisationFailed if T - shift M is singular.
PrestressedModes prestressed_modes(const LinkNetwork& network, NetworkLaw network_law, const DiskLaw& law, int count);
inline constexpr std::size_t kDensePiece = 120;

}  // namespace isostat
