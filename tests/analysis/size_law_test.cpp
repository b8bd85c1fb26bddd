// Laws of sizes: exact quantiles of known laws, a search for the maximum of the likelihood, scatter over samples.
#include "analysis/network/size_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace isostat {
namespace {

double uniform(std::mt19937_64& engine) { return (static_cast<double>(engine() >> 11) + 0.5) * std::ldexp(1.0, -53); }

// Quantile u of x^-q in [a, b).
double power_quantile(double u, double q, double a, double b) {
  const double e = 1 - q;
  if (std::isinf(b)) return a * std::pow(1 - u, 1 / e);
  return std::abs(e) < 1e-12 ? a * std::pow(b / a, u)
                             : std::pow(std::pow(a, e) + u * (std::pow(b, e) - std::pow(a, e)), 1 / e);
}

TEST(SizeLawFit, ContinuousPowerLawsAreRecovered) {
  for (const double q : {1.0, 1.7, 2.5, 4.0})
    for (const double end : {20.0, std::numeric_limits<double>::infinity()}) {
      if (std::isinf(end) && q <= 1) continue;  // no such law
      std::vector<double> sizes;
      for (int k = 0; k < 4000; ++k) sizes.push_back(power_quantile((k + 0.5) / 4000, q, 0.5, end));
      sizes.push_back(0.4);  // below the window
      const SizeLawFit law = continuous_size_law(sizes, 0.5, end);
      EXPECT_EQ(law.count, 4000);
      EXPECT_NEAR(law.exponent, q, 5e-3 * q) << q << ' ' << end;
      EXPECT_TRUE(law.identifiable) << law.message;
      EXPECT_GT(law.log_ratio, 0);
    }
}

TEST(SizeLawFit, AnExponentialIsNoPowerLaw) {
  std::mt19937_64 engine(1);
  std::vector<double> sizes;
  std::vector<std::int64_t> whole;
  for (int k = 0; k < 2000; ++k) {
    sizes.push_back(1 - 3 * std::log(uniform(engine)));
    whole.push_back(4 + static_cast<std::int64_t>(-5 * std::log(uniform(engine))));
  }
  const SizeLawFit law = continuous_size_law(sizes, 1), discrete = discrete_size_law(whole, 4, 100000);
  EXPECT_NEAR(law.scale, 3, 4 * law.scale_error);
  EXPECT_NEAR(discrete.scale, 5, 4 * discrete.scale_error);
  for (const SizeLawFit& l : {law, discrete}) {
    EXPECT_FALSE(l.identifiable);
    EXPECT_EQ(l.message, "no power law: an exponential is significantly more likely");
    EXPECT_LT(l.log_ratio, -2 * l.log_ratio_error);
  }
}

// Of all exponents and scales on a grid none is more likely than what is found, and ln L there gives the ratio.
TEST(SizeLawFit, IsTheMaximumOfTheLikelihood) {
  std::mt19937_64 engine(4);
  std::vector<std::int64_t> sizes;
  for (int k = 0; k < 60; ++k)
    sizes.push_back(4 + static_cast<std::int64_t>(power_quantile(uniform(engine), 2.2, 1, 300)));
  const std::int64_t to = 400;
  const auto likelihood = [&](auto&& weight) {
    double norm = 0, sum = 0;
    for (std::int64_t n = 4; n <= to; ++n) norm += weight(static_cast<double>(n));
    for (const std::int64_t n : sizes) sum += std::log(weight(static_cast<double>(n)) / norm);
    return sum;
  };
  double best_power = -1e300, best_exponential = -1e300, tau = 0, scale = 0;
  for (double t = 0.5; t < 5; t += 0.001)
    if (const double l = likelihood([&](double n) { return std::pow(n, -t); }); l > best_power) best_power = l, tau = t;
  for (double s = 1; s < 200; s += 0.01)
    if (const double l = likelihood([&](double n) { return std::exp(-(n - 4) / s); }); l > best_exponential)
      best_exponential = l, scale = s;
  const SizeLawFit law = discrete_size_law(sizes, 4, to);
  EXPECT_NEAR(law.exponent, tau, 1e-3);
  EXPECT_NEAR(law.scale, scale, 1e-2);
  EXPECT_NEAR(law.log_ratio, best_power - best_exponential, 1e-3);
  // Fisher information: the curvature of ln L.
  const double h = 0.01, bend = likelihood([&](double n) { return std::pow(n, -tau - h); }) +
                                likelihood([&](double n) { return std::pow(n, -tau + h); }) - 2 * best_power;
  EXPECT_NEAR(law.exponent_error, h / std::sqrt(-bend), 2e-3);
}

TEST(SizeLawFit, ErrorsAreTheScatterOverSamples) {
  std::mt19937_64 engine(2);
  for (const bool discrete : {false, true}) {
    double sum = 0, squares = 0, error = 0;
    const int samples = 300;
    for (int s = 0; s < samples; ++s) {
      std::vector<double> x;
      std::vector<std::int64_t> n;
      for (int k = 0; k < 100; ++k) {
        x.push_back(power_quantile(uniform(engine), 2.5, 0.5, std::numeric_limits<double>::infinity()));
        // n^-2.5, n >= 4, by rejection of a continuous law from 3.5 on.
        for (bool taken = false; !taken;) {
          const double at = power_quantile(uniform(engine), 2.5, 3.5, std::numeric_limits<double>::infinity());
          const double whole = std::floor(at + 0.5),
                       mass = (std::pow(whole - .5, -1.5) - std::pow(whole + .5, -1.5)) / 1.5;
          taken = uniform(engine) < std::pow(whole, -2.5) / mass;
          if (taken) n.push_back(static_cast<std::int64_t>(std::min(whole, 1e6)));
        }
      }
      const SizeLawFit law = discrete ? discrete_size_law(n, 4, 1000) : continuous_size_law(x, 0.5);
      sum += law.exponent, squares += law.exponent * law.exponent, error += law.exponent_error;
    }
    const double mean = sum / samples, scatter = std::sqrt(squares / samples - mean * mean);
    EXPECT_NEAR(mean, 2.5, 0.06) << discrete;
    EXPECT_NEAR(scatter / (error / samples), 1, 0.15) << discrete;
  }
}

TEST(SizeLawFit, SaysWhenThereIsNothingToFit) {
  EXPECT_FALSE(continuous_size_law(std::vector<double>(19, 1.0), 0.5).identifiable);
  EXPECT_TRUE(std::isnan(continuous_size_law({}, 0.5).exponent));
  const SizeLawFit equal = discrete_size_law(std::vector<std::int64_t>(50, 4), 4, 100);
  EXPECT_FALSE(equal.identifiable);
  EXPECT_EQ(equal.message, "all sizes at one end: no exponent");
}

}  // namespace
}  // namespace isostat
