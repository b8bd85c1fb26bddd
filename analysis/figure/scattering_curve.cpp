#include "analysis/figure/scattering_curve.hpp"

#include <cmath>

namespace isostat {

// 2F1[(1 + d)/2, d/2; 1; -x^2] = (1 + x^2)^(-d/2) P_{d-1}(z) with z = 1/sqrt(1 + x^2) and the Legendre function
// P_nu(z) = 2F1[-nu, nu + 1; 1; (1 - z)/2], whose argument is at most 1/2: 53 terms reach the last bit.
double scattering_curve(double k, const ScatteringParameters& p) {
  const double x = p.blob_size * k, z = 1 / std::hypot(1, x), nu = p.fractal_dimension - 1;
  const double argument = x * x * z * z / (2 * (1 + z));  // (1 - z)/2 without cancellation at small x
  double term = 1, legendre = 1;
  for (int n = 0; n < 60; ++n) {
    term *= (n - nu) * (n + nu + 1) / ((n + 1.0) * (n + 1.0)) * argument;
    legendre += term;
  }
  return p.constant +
         p.amplitude * std::tgamma(p.fractal_dimension) * std::pow(p.blob_size * z, p.fractal_dimension) * legendre;
}

}  // namespace isostat
