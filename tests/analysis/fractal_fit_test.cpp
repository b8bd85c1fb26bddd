#include "analysis/structure/fractal_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "analysis/structure/bootstrap.hpp"
#include "analysis/structure/hypergeometric.hpp"
#include "analysis/structure/intensity.hpp"
#include "analysis/structure/power_fit.hpp"

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

TEST(fractal_fit, the_constant_can_be_free_nonnegative_or_zero) {
  for (const double constant : {0.02, 0.0, -0.004}) {
    const auto s = random_field(300, 1.53, 9.3, constant, 5);
    const auto fit = [&](FitConstant c) { return fit_intensity_by_modes(s.k, s.intensity, s.modes, c); };
    const auto free = fit(FitConstant::free), nonnegative = fit(FitConstant::nonnegative),
               zero = fit(FitConstant::zero);
    EXPECT_EQ(zero.constant, 0);
    EXPECT_EQ(zero.error[3], 0);
    EXPECT_EQ(zero.parameters, 3);
    EXPECT_TRUE(zero.constant_held);
    EXPECT_GE(nonnegative.constant, 0);
    if (free.constant >= 0) {
      EXPECT_EQ(nonnegative.d_f, free.d_f);
      EXPECT_FALSE(nonnegative.constant_held);
    } else {
      EXPECT_EQ(nonnegative.d_f, zero.d_f);
      EXPECT_TRUE(nonnegative.constant_held);
      EXPECT_GT(nonnegative.d_f, free.d_f);  // a constant below 0 takes d_F with it
    }
    EXPECT_GE(zero.chi2, free.chi2 * 0.98);  // weights follow each fit
    if (constant == 0) {
      EXPECT_NEAR(zero.d_f, 1.53, 4 * zero.error[0]);
    }
    EXPECT_LT(zero.error[0], free.error[0]);
  }
  const auto low = random_field(300, 1.53, 9.3, -0.004, 5);
  EXPECT_LT(fit_intensity_by_modes(low.k, low.intensity, low.modes).constant, 0);
}

TEST(fractal_fit, a_refit_ends_where_all_starts_end) {
  const auto s = random_field(300, 1.53, 9.3, 0.02, 7), other = random_field(300, 1.53, 9.3, 0.02, 8);
  for (const FitConstant c : {FitConstant::free, FitConstant::zero}) {
    const auto start = fit_intensity_by_modes(other.k, other.intensity, other.modes, c);
    const auto all = fit_intensity_by_modes(s.k, s.intensity, s.modes, c),
               one = refit_intensity_by_modes(s.k, s.intensity, s.modes, c, start);
    EXPECT_NEAR(one.d_f, all.d_f, 0.01 * all.error[0]);
    EXPECT_NEAR(one.xi, all.xi, 0.01 * all.error[1]);
    EXPECT_EQ(one.starts, 1);
    EXPECT_TRUE(one.identifiable);
  }
}

TEST(power_fit, recovers_a_power_law_with_honest_errors) {
  double z2 = 0, change2 = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    auto s = random_field(300, 1.53, 1e9, 0, seed);  // k xi >> 1: k^-1.53
    const auto fit = fit_power(s.k, s.intensity, s.modes, 0.3, 5);
    z2 += std::pow((fit.exponent - 1.53) / fit.error, 2) / 60;
    change2 += std::pow(fit.slope_change / fit.slope_change_error, 2) / 60;
    EXPECT_GE(fit.window[0], 0.3);
    EXPECT_LE(fit.window[1], 5);
  }
  EXPECT_NEAR(z2, 1, 0.4);  // scatter of the mean about .18
  EXPECT_NEAR(change2, 1, 0.4);
}

TEST(power_fit, says_when_there_is_none) {
  std::vector<double> k, straight, bent, modes;
  for (int n = 0; n < 20; ++n) {
    k.push_back(0.6 * std::pow(10, n / 20.0)), modes.push_back(1e4);
    straight.push_back(3 * std::pow(k.back(), -1.7)), bent.push_back(fractal_intensity(k.back(), 1.7, 1, 3, 0));
  }
  const auto good = fit_power(k, straight, modes, 0, 10);
  EXPECT_TRUE(good.identifiable) << good.message;
  EXPECT_NEAR(good.exponent, 1.7, 1e-12);
  EXPECT_NEAR(good.amplitude, 3, 1e-11);
  EXPECT_NEAR(good.slope_change, 0, 1e-10);
  EXPECT_EQ(good.points, 20);
  const auto crossover = fit_power(k, bent, modes, 0, 10);
  EXPECT_FALSE(crossover.identifiable);
  EXPECT_EQ(crossover.message.substr(0, 35), "no power law: the slope changes by ");
  EXPECT_FALSE(fit_power(k, straight, modes, 1, 1.7).identifiable);  // less than a factor 2
  EXPECT_FALSE(fit_power(k, straight, modes, 1, 1.2).identifiable);  // fewer than four bins
  EXPECT_TRUE(std::isnan(fit_power(k, straight, modes, 1, 1.2).exponent));
  EXPECT_THROW(fit_power(k, straight, std::span(modes).first(3), 0, 10), std::invalid_argument);
}

// Samples that scatter by their modes alone: the bootstrap gives the error that the modes give. Samples that differ
// from each other: it gives more, the modes do not.
TEST(bootstrap, sees_what_modes_see_and_what_samples_add) {
  for (const bool differ : {false, true}) {
    double ratio = 0;
    const int ensembles = 6, samples = 8;
    for (int e = 0; e < ensembles; ++e) {
      std::vector<Synthetic> fields;
      for (int n = 0; n < samples; ++n)
        fields.push_back(random_field(150, 1.53 + (differ ? 0.15 * (n % 2 ? 1 : -1) : 0), 4, 0,
                                      static_cast<std::uint64_t>(100 * e + n + 1)));
      const auto pooled = [&](const std::vector<std::size_t>& drawn) {
        Synthetic all = fields[0];
        for (std::size_t b = 0; b < all.k.size(); ++b) {
          all.intensity[b] = all.modes[b] = 0;
          for (const std::size_t d : drawn)
            all.modes[b] += fields[d].modes[b], all.intensity[b] += fields[d].modes[b] * fields[d].intensity[b];
          all.intensity[b] /= all.modes[b];
        }
        return all;
      };
      const Synthetic all = pooled({0, 1, 2, 3, 4, 5, 6, 7});
      const auto fit = fit_intensity_by_modes(all.k, all.intensity, all.modes, FitConstant::zero);
      ASSERT_TRUE(fit.identifiable) << fit.message;
      const auto b = bootstrap_fit(samples, [&](const std::vector<std::size_t>& drawn) {
        const Synthetic again = pooled(drawn);
        return refit_intensity_by_modes(again.k, again.intensity, again.modes, FitConstant::zero, fit);
      });
      EXPECT_EQ(b.resamples, kResamples);
      EXPECT_EQ(b.told, kResamples);
      ratio += b.error[0] / fit.error[0] / ensembles;
      EXPECT_EQ(b.error[3], 0);
    }
    if (differ)
      EXPECT_GT(ratio, 1.5);
    else
      EXPECT_NEAR(ratio, 1, 0.25);
  }
}

TEST(bootstrap, says_when_resamples_have_no_optimum) {
  FractalFit fit;
  fit.chi2 = 1, fit.identifiable = true;
  int calls = 0;
  nlohmann::ordered_json json{{"identifiable", true}, {"message", ""}};
  add_bootstrap(json, fit, 4, [&](const std::vector<std::size_t>&) {
    FractalFit f = fit;
    f.identifiable = ++calls % 4 != 0;
    f.d_f = calls;
    return f;
  });
  EXPECT_EQ(json["bootstrap"]["told"], 150);
  EXPECT_EQ(json["identifiable"], false);
  EXPECT_EQ(json["message"].get<std::string>().substr(0, 15), "only 150 of 200");
  json = {{"identifiable", true}, {"message", ""}};
  add_bootstrap(json, fit, 2, [&](const std::vector<std::size_t>&) { return fit; });
  EXPECT_TRUE(json["bootstrap"].is_null());
  EXPECT_EQ(json["identifiable"], true);
}

}  // namespace
}  // namespace isostat
