// The truncated power law of radii and what is read off a sample of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "dem/sample/size_distribution.hpp"
#include "dem/sample/size_statistics.hpp"

namespace isostat {
namespace {

// Simpson's rule in ln r.
template <class F>
double integral(double from, double to, const F& f) {
  constexpr int n = 2000;
  const double h = std::log(to / from) / n;
  double sum = 0;
  for (int k = 0; k <= n; ++k) {
    const double r = from * std::exp(k * h);
    sum += (k == 0 || k == n ? 1 : k % 2 ? 4 : 2) * f(r) * r;
  }
  return sum * h / 3;
}

TEST(SizeDistribution, QuantileMomentsAndDensityAreOneLaw) {
  for (const double b : {-20.0, -3.0, 0.0, 0.5, 1.0, 1 + 1e-12, 1.001, 2.5, 3.5, 4.0, 60.0}) {
    const SizeDistribution d{0.03, 0.5, b};
    EXPECT_NEAR(d.quantile(0), 0.03, 1e-15) << b;
    EXPECT_NEAR(d.quantile(1), 0.5, 1e-15) << b;
    for (const double u : {0.01, 0.3, 0.5, 0.99})
      EXPECT_NEAR(integral(0.03, d.quantile(u), [&](double r) { return d.density(r); }), u, 1e-6) << b;
    for (const int k : {0, 1, 2, 3}) {
      const double direct = integral(0.03, 0.5, [&](double r) { return std::pow(r, k) * d.density(r); });
      EXPECT_NEAR(d.moment(k) / direct, 1, 1e-6) << b << " " << k;
    }
  }
}

TEST(SizeDistribution, ClosedFormsOfUniformAndLogUniform) {
  EXPECT_NEAR((SizeDistribution{1, 3, 0}.quantile(0.25)), 1.5, 1e-15);
  EXPECT_NEAR((SizeDistribution{1, 100, 1}.quantile(0.5)), 10, 1e-13);
  EXPECT_NEAR((SizeDistribution{1, 2, 0}.moment(3)), 15.0 / 4, 1e-14);
  EXPECT_EQ((SizeDistribution{2, 2, 3.5}.quantile(0.7)), 2);
  EXPECT_EQ((SizeDistribution{2, 2, 3.5}.moment(3)), 8);
}

std::vector<double> sample(const SizeDistribution& d, std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> radii(n);
  for (double& r : radii) r = d.draw(random);
  return radii;
}

TEST(LikelyExponent, MaximisesTheLikelihood) {
  for (const double b : {-2.0, 0.0, 1.0, 3.5, 8.0}) {
    const std::vector<double> radii = sample({0.05, 0.5, b}, 300, 7);
    const auto likelihood = [&](double at) {
      double sum = 0;
      for (const double r : radii) sum += std::log(SizeDistribution{0.05, 0.5, at}.density(r));
      return sum;
    };
    const Exponent e = likely_exponent(radii, 0.05, 0.5);
    const double h = e.error, top = likelihood(e.value), below = likelihood(e.value - h),
                 above = likelihood(e.value + h);
    EXPECT_GT(top, below);
    EXPECT_GT(top, above);
    EXPECT_NEAR(std::sqrt(-h * h / (below - 2 * top + above)) / e.error, 1, 0.02) << b;  // error from the curvature
    const double near = 1e-3 * e.error;
    EXPECT_NEAR((likelihood(e.value + near) - likelihood(e.value - near)) / (2 * near) * e.error, 0, 1e-6) << b;
  }
}

TEST(LikelyExponent, ErrorIsTheSpreadOfSamples) {
  for (const double b : {1.0, 3.5}) {
    constexpr int n = 1000;
    double sum = 0, squares = 0;
    for (int k = 0; k < n; ++k) {
      const Exponent e = likely_exponent(sample({0.05, 0.5, b}, 200, 1000 + static_cast<std::uint64_t>(k)), 0.05, 0.5);
      const double z = (e.value - b) / e.error;
      sum += z, squares += z * z;
    }
    EXPECT_NEAR(sum / n, 0, 0.15) << b;  // 4 standard errors, and a bias of order 1/sqrt(200)
    EXPECT_NEAR(squares / n, 1, 0.2) << b;
  }
}

TEST(LikelyExponent, OfNothingAndOfOneBound) {
  EXPECT_TRUE(std::isnan(likely_exponent({}, 0.1, 1).value));
  EXPECT_TRUE(std::isnan(likely_exponent({1, 1}, 1, 1).value));
  EXPECT_EQ(likely_exponent({0.1, 0.1}, 0.1, 1).value, INFINITY);
  EXPECT_EQ(likely_exponent({1, 1}, 0.1, 1).value, -INFINITY);
}

TEST(SizeHistogram, CountsEachRadiusOnce) {
  const std::vector<double> radii{0.1, 0.1, 0.2, 0.5, 0.99, 1};
  const SizeHistogram h = size_histogram(radii, 0.1, 1, 2);
  EXPECT_EQ(h.count, (std::vector<std::size_t>{3, 3}));
  EXPECT_NEAR(h.edge[1], std::sqrt(0.1), 1e-15);
  double sum = 0;
  for (std::size_t k = 0; k < 2; ++k) sum += h.density[k] * (h.edge[k + 1] - h.edge[k]);
  EXPECT_NEAR(sum, 1, 1e-14);
}

TEST(PowerFit, FindsALawAndItsError) {
  SizeHistogram h = size_histogram({}, 0.05, 0.5, 12);
  for (std::size_t k = 0; k < 12; ++k) h.count[k] = 1, h.density[k] = 0.7 * std::pow(h.middle[k], -2.25);
  h.count[5] = 0, h.density[5] = 0;
  const PowerFit exact = fit_power_law(h);
  EXPECT_NEAR(exact.exponent, 2.25, 1e-12);
  EXPECT_NEAR(exact.prefactor, 0.7, 1e-12);
  EXPECT_NEAR(exact.exponent_error, 0, 1e-10);
  EXPECT_EQ(exact.bins, 11u);

  const PowerFit f = fit_power_law(size_histogram(sample({0.05, 0.5, 3.5}, 100000, 3), 0.05, 0.5, 10));
  EXPECT_NEAR(f.exponent, 3.5, 0.1);
  EXPECT_TRUE(std::isnan(fit_power_law(size_histogram({0.1, 0.2}, 0.05, 0.5, 10)).exponent));
}

}  // namespace
}  // namespace isostat
