// The constitutive laws of soft-particles fitted (seed 000, Eqs. 7, 8): with x the scaled deformation h_n/R_s
//   Eq. 7  F(x)   = 0 below delta, a x^b + c above it, delta = (-c/a)^(1/b)
//   Eq. 8  k_t(x) the same with c = -a delta^b, delta that of Eq. 7: two parameters
// Unweighted least squares over the means of the packings, errors by bootstrap over packings.
#pragma once
#include <cstdint>
#include <vector>

namespace isostat {

struct SoftLaw {
  double a = 0, b = 0, c = 0;  // [force], [-], [force]
  double delta = 0;            // [-] threshold; 0 if c > 0
  double rms = 0;              // [force] of the residuals
  double operator()(double x) const;
};

// Three points at least that carry a force (greater than 0); else all NaN. x > 0 ascending.
SoftLaw fit_soft_law(const std::vector<double>& x, const std::vector<double>& y);

// Eq. 8 for a given threshold. Two points at least above it with y > 0; else all NaN.
SoftLaw fit_soft_law_from(double delta, const std::vector<double>& x, const std::vector<double>& y);

// Standard errors of a, b, c, delta: of fits to the means of packings drawn with replacement. samples[p][k] is packing
// p at x[k]; fits that fail are left out; NaN with one packing.
struct SoftLawErrors {
  double a = 0, b = 0, c = 0, delta = 0;
};
SoftLawErrors bootstrap_errors(const std::vector<double>& x, const std::vector<std::vector<double>>& samples,
                               int draws = 200, std::uint64_t seed = 1);
// Of Eq. 8: each draw has the threshold of its own packings' Eq. 7.
SoftLawErrors bootstrap_errors(const std::vector<double>& x, const std::vector<std::vector<double>>& normal,
                               const std::vector<std::vector<double>>& tangential, int draws = 200,
                               std::uint64_t seed = 1);

std::vector<double> mean_of(const std::vector<std::vector<double>>& samples);
std::vector<double> standard_error_of(const std::vector<std::vector<double>>& samples);  // NaN of one sample

}  // namespace isostat
