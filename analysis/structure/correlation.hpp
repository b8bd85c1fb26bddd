// Density autocorrelation C(r) (Gilabert 2007, Eq. 24) averaged over directions, and the mass within r of a solid
// point that follows from it.
#pragma once
#include <span>
#include <vector>

#include "geometry/periodic_cell.hpp"

namespace isostat {

struct CorrelationCurve {
  std::vector<double> r;      // [length]
  std::vector<double> c;      // C(r) [-]
  std::vector<double> mass;   // M(r) = int_0^r 2 pi r' C(r') dr' / Phi: mean solid area within r of a solid point
  double solid_fraction = 0;  // Phi = C(0), of the union
  double k_cut = 0;           // [1/length] where the sum over modes ends
};

// C(r) = autocorrelation of single disks and of pairs that touch or nearly do, in closed form (closed_terms.hpp), plus
// (1/A) sum over the reciprocal lattice up to k_cut of (|chi_hat|^2 - their spectra)/A J0(kr), plus Porod's tail of the
// walls that deep overlaps hide. Error of C at the default cut of 100 / (largest diameter), against exact areas
// (tests/bench/correlation_bench.cpp): 1e-6 for separate and touching disks and for contacts of up to 1e-4 diameters
// deep, at most 5e-5 (near r = 0) for deeper ones. Without the pairs a contact leaves the tail -7.1 sqrt(R_i R_j/(R_i +
// R_j)) k^-7/2 / A in I(k) and errors of 5e-4: so in cells that are not larger than r + 4 radii, where pairs meet their
// images. k_cut 0: the default, or what kMostModes allows. r increasing from 0, below half the shorter edge.
CorrelationCurve density_correlation(std::span<const Vec2> centre, std::span<const double> radius,
                                     const PeriodicCell<2>& cell, std::vector<double> r, double k_cut = 0);

}  // namespace isostat
