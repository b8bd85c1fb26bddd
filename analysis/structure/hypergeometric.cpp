#include "analysis/structure/hypergeometric.hpp"

#include <gsl/gsl_sf_gamma.h>

#include <cmath>
#include <numbers>

namespace isostat {
namespace {

// 2F1(a, b; c; z) by its series, |z| <= 1/2.
double series(double a, double b, double c, double z) {
  double term = 1, sum = 1;
  for (int n = 0; n < 200; ++n) {
    term *= (a + n) * (b + n) / ((c + n) * (1.0 + n)) * z;
    sum += term;
    if (std::abs(term) < 1e-17 * std::abs(sum)) break;
  }
  return sum;
}

}  // namespace

double fractal_hypergeometric(double d, double x) {
  const double nu = d - 1, root = std::sqrt(1 + x * x), t = 1 / root;
  double legendre;
  if (std::abs(x) < 1) {
    legendre = series(-nu, nu + 1, 1, x * x / (2 * root * (1 + root)));  // (1 - t)/2 without cancellation
  } else {
    const double root_pi = std::sqrt(std::numbers::pi), t2 = t * t;
    const double even = root_pi * gsl_sf_gammainv(nu / 2 + 1) * gsl_sf_gammainv((1 - nu) / 2);
    const double odd = -2 * root_pi * gsl_sf_gammainv((nu + 1) / 2) * gsl_sf_gammainv(-nu / 2);
    legendre = even * series(-nu / 2, (nu + 1) / 2, 0.5, t2) + odd * t * series((1 - nu) / 2, nu / 2 + 1, 1.5, t2);
  }
  return std::pow(root, -d) * legendre;
}

}  // namespace isostat
