#include "analysis/structure/fractal_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "analysis/structure/hypergeometric.hpp"
#include "analysis/structure/intensity.hpp"

namespace isostat {
namespace {

nlohmann::json read_json(const std::string& name) {
  std::ifstream in(ISOSTAT_DATA "/geometry/" + name);
  return nlohmann::json::parse(in);
}

TEST(hypergeometric, matches_the_table) {
  const auto table = read_json("hyp2f1_table.json");
  ASSERT_EQ(table["rows"].size(), 104u);
  for (const auto& row : table["rows"]) {
    const double expected = row[2].get<double>();
    EXPECT_NEAR(fractal_hypergeometric(row[0].get<double>(), row[1].get<double>()) / expected, 1, 1e-14) << row;
  }
}

TEST(hypergeometric, closed_forms) {
  for (const double x : {0.0, 0.3, 0.9999999, 1.0, 1.0000001, 4.0, 300.0}) {
    EXPECT_NEAR(fractal_hypergeometric(1, x) * std::sqrt(1 + x * x), 1, 3e-15);      // d = 1: P_0 = 1
    EXPECT_NEAR(fractal_hypergeometric(2, x) * std::pow(1 + x * x, 1.5), 1, 5e-15);  // d = 2: P_1 = t
  }
}

TEST(fractal_fit, reaches_the_optimum_of_the_checked_cases) {
  for (const auto& c : read_json("fit_cases.json")) {
    const auto k = c["k"].get<std::vector<double>>(), y = c["I"].get<std::vector<double>>(),
               s = c["sigma"].get<std::vector<double>>();
    const auto fit = fit_intensity(k, y, s);
    const auto& e = c["fit"];
    EXPECT_TRUE(fit.identifiable) << fit.message;
    const double value[] = {fit.d_f, fit.xi, fit.amplitude, fit.constant};
    const char* names[] = {"dF", "xi", "amp", "cst"};
    for (std::size_t n = 0; n < 4; ++n) {
      const double scale = std::max(std::abs(e[names[n]].get<double>()), 0.01);
      EXPECT_NEAR(value[n], e[names[n]].get<double>(), 1e-6 * scale) << names[n];
      EXPECT_NEAR(fit.error[n], e["err"][names[n]].get<double>(), 1e-6 * std::max(1.0, fit.error[n])) << names[n];
      for (std::size_t m = 0; m < 4; ++m) EXPECT_NEAR(fit.correlation[n][m], e["corr"][n][m].get<double>(), 1e-5);
    }
    EXPECT_NEAR(fit.chi2_per_dof(), e["chi2_dof"].get<double>(), 1e-6);
  }
}

// I(k) of a random field: each mode exponential about the model, so bins scatter by model / sqrt(modes).
struct Synthetic {
  std::vector<double> k, intensity, modes;
};
Synthetic random_field(double side, double d_f, double xi, double constant, std::uint64_t seed) {
  std::mt19937_64 g(seed);
  Synthetic s;
  const auto edges = anchored_edges(6.2831853 / side, 6.2831853);
  for (std::size_t b = 0; b + 1 < edges.size(); ++b) {
    const double k = std::sqrt(edges[b] * edges[b + 1]);
    const int n = static_cast<int>((edges[b + 1] * edges[b + 1] - edges[b] * edges[b]) * side * side / 8 / 3.14159265);
    if (n == 0) continue;
    double sum = 0;
    for (int m = 0; m < n; ++m) sum -= std::log(1 - std::ldexp(double(g() >> 11), -53));
    s.k.push_back(k), s.modes.push_back(n);
    s.intensity.push_back(fractal_intensity(k, d_f, xi, 2.4, constant) * sum / n);
  }
  return s;
}

TEST(fractal_fit, errors_are_honest_on_random_fields) {
  double z2 = 0, chi2 = 0;
  int n = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    const auto s = random_field(300, 1.53, 9.3, 0.02, seed);
    const auto fit = fit_intensity_by_modes(s.k, s.intensity, s.modes);
    ASSERT_TRUE(fit.identifiable) << fit.message;
    EXPECT_EQ(fit.agreeing, fit.starts);
    z2 += std::pow((fit.d_f - 1.53) / fit.error[0], 2) + std::pow((fit.xi - 9.3) / fit.error[1], 2);
    chi2 += fit.chi2_per_dof();
    n += 2;
  }
  EXPECT_NEAR(z2 / n, 1, 0.5);  // two parameters, 16 fields: scatter of the mean about .25
  EXPECT_NEAR(chi2 / 16, 1, 0.2);
}

TEST(fractal_fit, says_when_xi_cannot_be_told) {
  // No fractal at all: a constant. And a xi far beyond the window.
  std::vector<double> k, flat, far, sigma;
  for (int n = 0; n < 30; ++n) {
    k.push_back(0.5 * std::pow(1.1, n));
    flat.push_back(0.3 * (1 + 0.01 * ((n * 37) % 11 - 5)));
    far.push_back(fractal_intensity(k.back(), 1.5, 1e6, 2, 0));
    sigma.push_back(0.01);
  }
  const auto a = fit_intensity(k, flat, sigma);
  EXPECT_FALSE(a.identifiable);
  EXPECT_FALSE(a.message.empty());
  for (std::size_t n = 0; n < far.size(); ++n) sigma[n] = 0.05 * far[n];
  const auto b = fit_intensity(k, far, sigma);
  EXPECT_FALSE(b.identifiable);
  EXPECT_FALSE(fit_intensity(std::span(k).first(4), std::span(flat).first(4), std::span(sigma).first(4)).identifiable);
  EXPECT_THROW(fit_intensity(k, flat, std::span(sigma).first(4)), std::invalid_argument);
}

TEST(fractal_fit, real_space_law) {
  std::vector<double> r, c;
  for (int n = 0; n < 60; ++n) r.push_back(1 + 0.2 * n), c.push_back(fractal_correlation(r.back(), 1.6, 5, 0.2));
  const auto fit = fit_correlation(r, c);
  EXPECT_TRUE(fit.identifiable) << fit.message;
  EXPECT_NEAR(fit.d_f, 1.6, 1e-7);
  EXPECT_NEAR(fit.xi, 5, 1e-6);
  EXPECT_NEAR(fit.amplitude, 0.2, 1e-7);
}

}  // namespace
}  // namespace isostat
