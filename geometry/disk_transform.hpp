// Fourier transform of the indicator chi of a union of disks on the reciprocal lattice of its periodic cell
// (Gilabert 2007, Eq. 25: I(k) = |chi_hat(k)|^2 / A), by one FFT instead of the paper's fine mesh.
#pragma once
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/periodic_cell.hpp"

namespace isostat {

struct TransformOptions {
  double k_max = 0;              // [1/length] modes with |k| <= k_max
  int kernel_width = 9;          // [grid steps] accuracy: relative error of the transform about 10^-(width - 1.5)
  double oversampling = 0;       // grid points per shortest wanted half wave; 0: 2, or 1.5 where memory counts
  bool correct_overlaps = true;  // false: overlaps count twice (a plain sum over disks)
};

// chi_hat(k) = integral of chi exp(-i k.r) [length^2] at k = 2 pi (mx / L1, (my - mx tilt / L1) / L2).
struct DiskTransform {
  PeriodicCell<2> cell;
  double k_max = 0;
  std::int64_t mx_max = 0, my_max = 0;      // largest mode numbers kept
  std::vector<std::complex<double>> value;  // [mx][my + my_max], mx = 0 .. mx_max; zero where |k| > k_max

  std::complex<double> at(std::int64_t mx, std::int64_t my) const {  // any sign
    if (mx < 0) return std::conj(at(-mx, -my));
    return value[static_cast<std::size_t>(mx * (2 * my_max + 1) + my + my_max)];
  }
  Vec2 k(std::int64_t mx, std::int64_t my) const;     // [1/length]
  double k2(std::int64_t mx, std::int64_t my) const;  // |k|^2 [1/length^2]
};

// centre in any image [length]. Throws std::invalid_argument for bad numbers, std::length_error when k_max asks for a
// grid beyond kMostGridPoints.
inline constexpr double kMostGridPoints = 0x1p29;  // 4 GiB
DiskTransform disk_transform(std::span<const Vec2> centre, std::span<const double> radius, const PeriodicCell<2>& cell,
                             const TransformOptions& options);

}  // namespace isostat
