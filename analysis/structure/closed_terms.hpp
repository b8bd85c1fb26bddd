// The part of the density autocorrelation that is known in closed form: single disks and pairs of neighbours.
#pragma once
#include <span>
#include <vector>

#include "geometry/disk_complex.hpp"

namespace isostat {

// Disks by themselves, and the pairs that touch or nearly do: these leave the slowest tail in Fourier space, k^-7/2
// without oscillation for a touching pair. Any set of pairs may be split off, since the same terms are taken off the
// modes and added in real space.
class ClosedTerms {
 public:
  // Pairs of the complex (its gap tolerance says how near) that overlap by at most `deepest` [length]; r_max: largest
  // distance asked for. Pairs whose images would come within r_max are left to the modes.
  ClosedTerms(const DiskComplex& complex, std::span<const double> radius, double deepest, double r_max);

  // Sum over disks of the squared form factor F_i^2, F = 2 pi R J1(kR)/k, and over pairs of 2 F_i F_j J0(k d), by
  // interpolation up to k_max [length^4].
  void tabulate(double k_max);
  double spectrum(double k) const;

  // Its counterpart in real space: sum of the areas common to the disks and themselves moved by r, averaged over
  // directions [length^2].
  double overlap(double r) const;
  double reach() const { return reach_; }             // overlap(r) without images vanishes beyond
  double walls_within() const { return walls_; }      // [length] of the disks' circles inside the other disk of a pair
  std::size_t pairs() const { return pair_.size(); }  // split off

 private:
  struct Pair {
    std::size_t i, j;
    double distance;
  };
  std::vector<double> radius_;
  std::vector<Pair> pair_;
  std::vector<double> image_;  // [length] distances of a disk to its own images within reach
  double reach_ = 0, walls_ = 0;

  static constexpr int kNodes = 12;  // of Chebyshev, a piece of kPhase radians: good to 4e-9
  static constexpr double kPhase = 4;
  int pieces_ = 0;
  double step_ = 0;
  std::vector<double> value_;
};

}  // namespace isostat
