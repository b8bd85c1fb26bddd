#include "analysis/constitutive/soft_law_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dem/solver/random.hpp"

namespace isostat {
namespace {

const std::vector<double> kDelta{0.05, 0.1, 0.15, 0.2, 0.25, 0.3};

std::vector<double> values(const SoftLaw& law) {
  std::vector<double> y;
  for (const double x : kDelta) y.push_back(law(x));
  return y;
}

// The two laws of Table 1 of seed 000, with their thresholds.
TEST(SoftLawFit, GivesBackALawWithoutNoise) {
  for (const SoftLaw& law : {SoftLaw{73.669, 2.799, -0.035, 0.065, 0}, SoftLaw{28.512, 5.003, -0.002, 0.148, 0}}) {
    const SoftLaw fit = fit_soft_law(kDelta, values(law));
    EXPECT_NEAR(fit.a, law.a, 1e-5 * law.a);
    EXPECT_NEAR(fit.b, law.b, 1e-6);
    EXPECT_NEAR(fit.c, law.c, 1e-7);
    EXPECT_NEAR(fit.delta, law.delta, 6e-4);  // printed with three digits
    EXPECT_LT(fit.rms, 1e-8);
  }
}

TEST(SoftLawFit, NeedsThreeLoadedPoints) {
  EXPECT_TRUE(std::isnan(fit_soft_law({0.1, 0.2, 0.3}, {0, 0.1, 0.5}).a));
  EXPECT_TRUE(std::isnan(bootstrap_errors({0.1, 0.2, 0.3}, {{0.1, 0.2, 0.4}}).a));
}

// Table 2: the threshold is that of the normal force, only a and b are free.
TEST(SoftLawFit, GivesBackSlopesFromTheirThreshold) {
  const SoftLaw law{0.740, 2.1, -0.740 * std::pow(0.065, 2.1), 0.065, 0};
  const SoftLaw fit = fit_soft_law_from(0.065, kDelta, values(law));
  EXPECT_NEAR(fit.a, law.a, 1e-6);
  EXPECT_NEAR(fit.b, law.b, 1e-6);
  EXPECT_NEAR(fit.c, -0.0024, 5e-5);
  EXPECT_EQ(fit.delta, 0.065);
  EXPECT_LT(fit.rms, 1e-8);
  EXPECT_TRUE(std::isnan(fit_soft_law_from(0.26, kDelta, values(law)).a));
}

// Packings scatter by a factor of the whole curve: a then has the scatter of the mean, b none.
TEST(SoftLawFit, BootstrapsOverPackings) {
  const SoftLaw law{70, 2.8, 0, 0, 0};
  Random random(5);
  std::vector<std::vector<double>> samples;
  for (int p = 0; p < 40; ++p) {
    samples.push_back(values(law));
    const double factor = 1 + 0.1 * random.normal();
    for (double& y : samples.back()) y *= factor;
  }
  const SoftLawErrors e = bootstrap_errors(kDelta, samples, 400);
  EXPECT_NEAR(e.a, 70 * 0.1 / std::sqrt(40), 0.35 * 70 * 0.1 / std::sqrt(40));
  EXPECT_LT(e.b, 1e-3);
  const std::vector<double> error = standard_error_of(samples), mean = mean_of(samples);
  EXPECT_NEAR(error.back() / mean.back(), 0.1 / std::sqrt(40), 0.3 * 0.1 / std::sqrt(40));
}

}  // namespace
}  // namespace isostat
