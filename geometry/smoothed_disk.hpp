// A disk convolved with a radial kernel of compact support, as a table in the distance from its centre and its radius.
//
// The kernel is psi(r) = exp(beta (sqrt(1 - (r/a)^2) - 1)) for r < a (the "exponential of semicircle" of Barnett,
// Magland, af Klinteberg 2019, here as a radial function). A grid that samples disks blurred by it has the Fourier
// transform of the sharp disks times psi_hat(k), up to aliases of relative size exp(-beta); so one FFT serves all
// radii.
#pragma once
#include <span>
#include <vector>

namespace isostat {

class RadialKernel {
 public:
  // support a [length]; beta: decay; k_max [1/length]: largest wave number that will be asked for.
  RadialKernel(double support, double beta, double k_max);
  double support() const { return support_; }
  double beta() const { return beta_; }
  double transform(double k) const;           // psi_hat(k) by quadrature, any k [length^2]
  double inverse_transform(double k2) const;  // 1 / psi_hat at k^2 <= k_max^2, from a table

 private:
  double support_, beta_, k_max2_;
  std::vector<double> node_, weight_;  // radial quadrature
  std::vector<double> log_inverse_;    // Chebyshev coefficients in k^2
};

// F(r; R) = integral of psi over the disk of radius R whose centre is r away; R = 0 stands for a point of unit weight
// (F = psi). One table serves radii between the two given (their difference at most about two grid steps).
class SmoothedDiskTable {
 public:
  SmoothedDiskTable(const RadialKernel& kernel, double radius_min, double radius_max, double grid_step);

  // The polynomial pieces in r of one radius.
  class Profile {
   public:
    double reach() const { return reach_; }  // F = 0 beyond
    double operator()(double r) const;       // 0 <= r <= reach
    friend class SmoothedDiskTable;

   private:
    static constexpr int kTerms = 9;
    std::vector<double> piece_;  // kTerms coefficients a piece
    double inverse_step_ = 0, reach_ = 0;
  };
  void set_profile(double radius, Profile& profile) const;  // the profile's memory is reused

 private:
  static constexpr int kTerms = Profile::kTerms;
  double radius_min_, radius_max_, support_, step_;
  int pieces_;
  std::vector<std::vector<double>> chebyshev_;  // [term in radius][piece * kTerms + power]
};

inline double SmoothedDiskTable::Profile::operator()(double r) const {
  const double u = r * inverse_step_;
  const int s = static_cast<int>(u);
  const double t = 2 * (u - s) - 1;
  const double* c = piece_.data() + kTerms * s;
  double sum = c[kTerms - 1];
  for (int p = kTerms - 2; p >= 0; --p) sum = sum * t + c[p];
  return sum;
}

}  // namespace isostat
