#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/ensemble.hpp"
#include "analysis/structure/intensity.hpp"
#include "analysis/structure/scattering_section.hpp"
#include "analysis/structure/sections.hpp"
#include "dem/input_error.hpp"
#include "geometry/pores.hpp"
#include "tests/oracle/union_mesh.hpp"
#include "tests/support/disk_packings.hpp"
#include "tests/support/packing_input.hpp"
#include "tests/support/refusal.hpp"

namespace isostat {
namespace {

using oracle::Disks;
using oracle::input_of;
constexpr double kPi = std::numbers::pi;
const std::string kData = ISOSTAT_DATA "/geometry/";

nlohmann::json read_json(const std::string& name) {
  std::ifstream in(kData + name);
  return nlohmann::json::parse(in);
}

struct IntensityCase : testing::TestWithParam<const char*> {};
TEST_P(IntensityCase, binned_curve_matches_the_checked_case) {
  const auto expected = read_json(std::string("scatter_") + GetParam() + ".json");
  const auto d = oracle::read_disks(kData + expected["packing"].get<std::string>());
  const auto edges = expected["bin_edges"].get<std::vector<double>>();
  const auto curve =
      average_intensity(disk_transform(d.centre, d.radius, d.cell, {.k_max = expected["kmax"].get<double>()}), edges);
  std::size_t row = 0;  // the case leaves empty bins out
  for (std::size_t b = 0; b < curve.modes.size(); ++b) {
    if (curve.modes[b] == 0) {
      EXPECT_TRUE(std::isnan(curve.intensity[b]));
      continue;
    }
    ASSERT_LT(row, expected["k"].size());
    EXPECT_EQ(curve.modes[b], expected["count"][row].get<std::int64_t>());
    EXPECT_NEAR(curve.k[b], expected["k"][row].get<double>(), 1e-12);
    EXPECT_NEAR(curve.intensity[b] / expected["I"][row].get<double>(), 1, 1e-7);
    EXPECT_NEAR(curve.sigma[b] / expected["sem"][row].get<double>(), 1, 1e-6);
    ++row;
  }
  EXPECT_EQ(row, expected["k"].size());
}
INSTANTIATE_TEST_SUITE_P(checked, IntensityCase, testing::Values("rsa60", "foam24"));

TEST(scattering, agrees_with_the_papers_mesh_within_its_error) {
  const auto d = oracle::rsa_disks(60, {10, 9}, 0.25, 0.5, 2);
  const auto mesh = oracle::union_mesh(d.centre, d.radius, d.cell, 0.01);
  const auto t = disk_transform(d.centre, d.radius, d.cell, {.k_max = 8});
  for (const auto& [mx, my] : {std::pair{1, 0}, {2, 3}, {5, -4}, {0, 7}}) {
    std::complex<double> sum = 0;
    for (int y = 0; y < mesh.ny; ++y)
      for (int x = 0; x < mesh.nx; ++x)
        if (mesh.covered[std::size_t(y) * std::size_t(mesh.nx) + std::size_t(x)])
          sum +=
              std::polar(mesh.step[0] * mesh.step[1], -2 * kPi * (mx * (x + 0.5) / mesh.nx + my * (y + 0.5) / mesh.ny));
    EXPECT_NEAR(std::abs(sum - t.at(mx, my)), 0, 5e-3);
  }
}

TEST(scattering, porod_tail) {
  // Separate disks: I(k) k^3 averages to 2 perimeter / A.
  const auto d = oracle::rsa_disks(400, {22, 22}, 0.2, 0.5, 3);
  double perimeter = 0;
  for (const double r : d.radius) perimeter += 2 * kPi * r;
  const auto t = disk_transform(d.centre, d.radius, d.cell, {.k_max = 90});
  const auto curve = average_intensity(t, {60, 90});
  const double tail = curve.intensity[0] * (90.0 * 90 - 60.0 * 60) / 2 / (1 / 60.0 - 1 / 90.0);  // k^-3 over the ring
  EXPECT_NEAR(tail / (2 * perimeter / d.cell.measure()), 1, 0.03);
}

TEST(scattering, section_has_the_keys_of_the_contract) {
  const auto json = scattering_section(input_of(oracle::rsa_disks(300, {22, 17}, 0.25, 0.5, 1)), {});
  const auto bins = json["k_edges"].size() - 1;
  for (const char* key : {"k", "I", "sigma", "modes"}) EXPECT_EQ(json[key].size(), bins) << key;
  EXPECT_LE(json["k_edges"][0].get<double>(), 2 * kPi / 22);
  for (const char* key :
       {"d_F", "d_F_error", "xi", "xi_error", "amplitude", "constant", "chi2_per_dof", "window", "message"})
    EXPECT_TRUE(json["fit"].contains(key)) << key;
  std::int64_t modes = 0;  // all modes below k_max but those in no bin
  for (const auto& m : json["modes"]) modes += m.get<std::int64_t>();
  const double k_max = json["k_edges"].back().get<double>();
  EXPECT_NEAR(double(modes), 22 * 17 * k_max * k_max / 8 / kPi, 0.02 * double(modes));
  AnalysisOptions options;
  options.k_max = 5;
  EXPECT_DOUBLE_EQ(scattering_section(input_of(oracle::rsa_disks(50, {12, 10}, 0.25, 0.5, 1)), options)["k_edges"]
                       .back()
                       .get<double>(),
                   5);
}

TEST(scattering, of_voids_closed_to_rounding_ends) {
  for (const bool hexagonal : {false, true})
    for (const double jitter : {0.0, 1e-14, 1e-9, 1e-6})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const AnalysisInput input = input_of(oracle::closing_lattice(hexagonal, jitter, seed));
        for (const auto& intensity : scattering_section(input, {})["I"])
          EXPECT_TRUE(intensity.is_null() || intensity.get<double>() >= 0);
        const auto dacf = dacf_section(input, {});
        EXPECT_NEAR(dacf["C"][0].get<double>(), dacf["solid_fraction"].get<double>(), 1e-3);
      }
}

TEST(scattering, refuses_what_it_does_not_apply_to) {
  const auto d = oracle::rsa_disks(20, {7, 7}, 0.25, 0.5, 1);
  auto open = input_of(d);
  open.state.packing.cell.reset();
  EXPECT_EQ(oracle::refusal(open, "scattering"), "needs a periodic cell: I(k) lives on its reciprocal lattice");
  EXPECT_EQ(oracle::refusal(open, "dacf"), "needs a periodic cell: C(r) averages over it");
  AnalysisOptions options;
  options.k_max = 1e7;
  EXPECT_THROW(scattering_section(input_of(d), options), InputError);
  options.k_max = 0.1;
  EXPECT_THROW(scattering_section(input_of(d), options), InputError);
  EXPECT_EQ(oracle::refusal(input_of(Disks{{{1, 1}}, {}, {}}), "scattering"), "needs at least one grain");
}

// A foreign packing stays in its own units, also when it is kept as a state.
TEST(scattering, length_a_is_1_in_reduced_units_only) {
  auto input = input_of(oracle::rsa_disks(20, {7, 7}, 0.2, 0.25, 1));
  const double largest =
      2 * *std::max_element(input.packing().bodies.radius.begin(), input.packing().bodies.radius.end());
  EXPECT_EQ(grain_size(input), largest);
  input.state.law.normal_stiffness = 1e5;
  EXPECT_EQ(grain_size(input), 1);
}

// Reports of samples of different size merged as `analyze` merges them.
TEST(scattering, samples_of_different_size_line_up_and_pool) {
  std::vector<Disks> packings;
  std::vector<nlohmann::ordered_json> reports;
  AnalysisOptions options;
  options.k_max = 10;
  std::int64_t modes = 0;
  for (const double side : {15.0, 22.0, 40.0}) {
    auto d = oracle::rsa_disks(std::size_t(side * side / 2), {side, side}, 0.25, 0.5, 1);
    d.radius[0] = 0.5;  // one grain size for all
    packings.push_back(d);
    reports.push_back(analyze(input_of(d), options, {"scattering", "dacf"}));
    for (const auto& m : reports.back()["scattering"]["modes"]) modes += m.get<std::int64_t>();
  }
  const auto longest = reports[2]["scattering"]["k_edges"];
  EXPECT_NE(reports[0]["scattering"]["k_edges"].size(), longest.size());
  const auto merged = merge_reports(reports);
  const auto &s = merged["scattering"], &pooled = s["pooled"];
  EXPECT_EQ(s["k_edges"], longest);
  ASSERT_EQ(s["I"].size(), longest.size() - 1);
  const auto last = s["I"].size() - 1;
  EXPECT_NEAR(s["I"][last]["mean"].get<double>(),
              (reports[0]["scattering"]["I"].back().get<double>() + reports[1]["scattering"]["I"].back().get<double>() +
               reports[2]["scattering"]["I"].back().get<double>()) /
                  3,
              1e-15);
  EXPECT_EQ(merged["dacf"]["C"].size(), reports[2]["dacf"]["C"].size());

  std::vector<IntensityCurve> curves;
  for (const Disks& d : packings)
    curves.push_back(average_intensity(disk_transform(d.centre, d.radius, d.cell, {.k_max = options.k_max}),
                                       longest.get<std::vector<double>>()));
  const IntensityCurve direct = pooled_intensity(curves);
  std::int64_t together = 0;
  for (std::size_t b = 0; b < pooled["I"].size(); ++b) {
    together += pooled["modes"][b].get<std::int64_t>();
    EXPECT_EQ(pooled["modes"][b], direct.modes[b]);
    if (pooled["modes"][b].get<int>() < 2) continue;
    EXPECT_NEAR(pooled["I"][b].get<double>(), direct.intensity[b], 1e-12 * direct.intensity[b]);
    EXPECT_NEAR(pooled["sigma"][b].get<double>(), direct.sigma[b], 1e-9 * direct.intensity[b]);
  }
  EXPECT_EQ(together, modes);

  options.k_max = 9;  // other bins: kept apart
  reports[0] = analyze(input_of(packings[0]), options, {"scattering"});
  EXPECT_FALSE(merge_reports(reports)["scattering"].contains("pooled"));
}

TEST(scattering, windows_and_constant_are_options) {
  const auto input = input_of(oracle::rsa_disks(600, {40, 40}, 0.25, 0.5, 4));
  AnalysisOptions options;
  options.k_window = {{0.5, 4.0}};
  options.fit_constant = FitConstant::zero;
  options.window_scan = true;
  const auto json = scattering_section(input, options);
  EXPECT_EQ(json["fit"]["constant"], 0.0);
  EXPECT_EQ(json["fit"]["constant_is"], "zero");
  EXPECT_EQ(json["fit"]["k_from"], 0.5);
  EXPECT_EQ(json["fit"]["k_limit"], 4.0);
  for (const char* fit : {"fit", "power"}) {
    EXPECT_GE(json[fit]["window"][0].get<double>(), 0.5) << fit;
    EXPECT_LE(json[fit]["window"][1].get<double>(), 4.0) << fit;
  }
  EXPECT_GE(json["windows"].size(), 5u);
  for (const auto& w : json["windows"]) {
    AnalysisOptions one = options;
    one.window_scan = false;
    one.k_window = {{w["from"].get<double>(), w["to"].get<double>()}};
    const auto alone = scattering_section(input, one);
    EXPECT_FALSE(alone.contains("windows"));
    EXPECT_EQ(alone["fit"]["d_F"], w["d_F"]);
    EXPECT_EQ(alone["fit"]["identifiable"], w["identifiable"]);
    EXPECT_EQ(alone["power"]["d_F"], w["power_d_F"]);
  }
  const auto plain = scattering_section(input, {});
  EXPECT_EQ(plain["fit"]["constant_is"], "free");
  EXPECT_EQ(plain["power"]["asked_window"][0].get<double>() * 10, plain["power"]["asked_window"][1].get<double>());
  options.k_window = {{0.5, 1000.0}};
  EXPECT_THROW(scattering_section(input, options), InputError);
}

TEST(scattering, an_ensemble_is_fitted_alike_with_errors_over_samples) {
  std::vector<nlohmann::ordered_json> reports;
  AnalysisOptions options;
  options.k_max = 12, options.k_window = {{0.3, 8.0}}, options.fit_constant = FitConstant::nonnegative;
  options.r_window = {{1.0, 6.0}};
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    auto d = oracle::rsa_disks(500, {30, 30}, 0.25, 0.5, seed);
    d.radius[0] = 0.5;
    reports.push_back(analyze(input_of(d), options, {"scattering", "dacf"}));
  }
  const auto merged = merge_reports(reports);
  const auto& pooled = merged["scattering"]["pooled"];
  EXPECT_EQ(pooled["fit"]["constant_is"], "nonnegative");
  EXPECT_GE(pooled["fit"]["constant"].get<double>(), 0);
  EXPECT_EQ(pooled["fit"]["k_from"], 0.3);
  EXPECT_EQ(pooled["power"]["asked_window"], nlohmann::ordered_json({0.3, 8.0}));
  EXPECT_EQ(pooled["fit"]["bootstrap"]["samples"], 4);
  // C(r): the mean over samples of equal cells, about their own Phi.
  const auto& excess = merged["dacf"]["pooled"]["excess"];
  for (const std::size_t n : {0u, 20u, 40u}) {
    double mean = 0;
    for (const auto& r : reports) {
      const double phi = r["dacf"]["solid_fraction"];
      mean += (r["dacf"]["C"][n].get<double>() - phi * phi) / 4;
    }
    EXPECT_NEAR(excess[n].get<double>(), mean, 1e-14);
  }
  EXPECT_EQ(merged["dacf"]["pooled"]["fit"]["r_from"], 1.0);
  EXPECT_EQ(merged["dacf"]["pooled"]["fit"]["to_first_zero"], false);
  EXPECT_EQ(merged["dacf"]["pooled"]["fit"]["bootstrap"]["samples"], 4);
  // The same for two inputs, which are too few to be drawn from.
  EXPECT_TRUE(merge_reports({reports[0], reports[1]})["scattering"]["pooled"]["fit"]["bootstrap"].is_null());
}

TEST(dacf, windows_are_an_option) {
  const auto input = input_of(oracle::rsa_disks(600, {40, 40}, 0.25, 0.5, 4));
  AnalysisOptions options;
  options.r_window = {{2.0, 7.0}};
  options.window_scan = true;
  const auto json = dacf_section(input, options);
  EXPECT_GE(json["fit"]["window"][0].get<double>(), 2);
  EXPECT_LE(json["fit"]["window"][1].get<double>(), 7);
  EXPECT_GT(json["fit"]["window"][1].get<double>(), 6.8);
  EXPECT_EQ(json["mass_radius"]["window"], nlohmann::ordered_json({2.0, 7.0}));
  double low = 0, high = 0, n = 0, xx = 0, xy = 0;  // the slope of ln M, by hand
  for (std::size_t k = 0; k < json["r"].size(); ++k)
    if (const double r = json["r"][k]; r >= 2 && r <= 7)
      low += std::log(r), high += std::log(json["mass_radius"]["M"][k].get<double>()), n += 1;
  for (std::size_t k = 0; k < json["r"].size(); ++k)
    if (const double r = json["r"][k]; r >= 2 && r <= 7) {
      const double x = std::log(r) - low / n;
      xx += x * x, xy += x * (std::log(json["mass_radius"]["M"][k].get<double>()) - high / n);
    }
  EXPECT_NEAR(json["mass_radius"]["dimension"].get<double>(), xy / xx, 1e-12);
  EXPECT_EQ(json["windows"].size(), 4u);  // a quarter of 7 is below 2, four times 2 above 7
  options.r_window = {{1.0, 20.5}};
  EXPECT_THROW(dacf_section(input, options), InputError);
}

}  // namespace
}  // namespace isostat
