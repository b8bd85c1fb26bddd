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

// C(r) = sum over grains of the autocorrelation of one disk, exactly, plus (1/A) sum over the reciprocal lattice up to
// k_cut of (|chi_hat|^2 - sum of squared form factors)/A J0(kr). The
// second sum converges as k_cut^-5/2 for separate disks (1e-5 at k_cut = 60 / diameter, 1e-6 at 150). Touching pairs
// leave a tail of I, -7.1 sqrt(R_i R_j/(R_i + R_j)) k^-7/2 / A a pair, hence an error of about 0.75 k_cut^-3/2 times
// the sum of those roots over the area: 1e-4 at k_cut = 100 / diameter in a loose packing. Where disks overlap, Porod's
// tail of the missing wall is added. k_cut 0: 100 / (largest diameter), or what kMostModes allows. r increasing from 0,
// below half the shorter edge.
CorrelationCurve density_correlation(std::span<const Vec2> centre, std::span<const double> radius,
                                     const PeriodicCell<2>& cell, std::vector<double> r, double k_cut = 0);

}  // namespace isostat
