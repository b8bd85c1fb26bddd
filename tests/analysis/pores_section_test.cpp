#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/load_input.hpp"
#include "analysis/report.hpp"
#include "analysis/structure/sections.hpp"
#include "dem/input_error.hpp"
#include "tests/support/disk_packings.hpp"
#include "tests/support/packing_input.hpp"
#include "tests/support/refusal.hpp"

namespace isostat {
namespace {

using oracle::input_of;

TEST(pores_section, has_the_keys_of_the_contract) {
  const auto d = oracle::read_disks(ISOSTAT_DATA "/geometry/holes_thin_chains.json");
  const auto json = pores_section(input_of(d), {});
  EXPECT_EQ(json["count"], 15);
  EXPECT_EQ(json["percolating"], 0);
  EXPECT_NEAR(json["mean_radius_weighted"].get<double>(), 6.163304155179889, 1e-9);
  ASSERT_EQ(json["list"].size(), 15u);
  for (const auto& p : json["list"]) {
    EXPECT_FALSE(p["percolating"].get<bool>());
    EXPECT_NEAR(p["R"].get<double>(), std::sqrt(2 * p["gyration"].get<double>() / p["area"].get<double>()), 1e-12);
    EXPECT_TRUE(p["x"].get<double>() >= 0 && p["x"].get<double>() < 24);
  }
  double sum = 0;  // densities integrate to 1
  const auto& h = json["histograms"]["log10_R_by_area"];
  for (std::size_t k = 0; k < h["density"].size(); ++k)
    sum += h["density"][k].get<double>() * (h["edges"][k + 1].get<double>() - h["edges"][k].get<double>());
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(pores_section, a_percolating_pore_is_listed_without_area) {
  const auto d = oracle::read_disks(ISOSTAT_DATA "/geometry/holes_rsa60.json");
  const auto json = pores_section(input_of(d), {});
  EXPECT_EQ(json["count"], 1);
  EXPECT_EQ(json["percolating"], 1);
  EXPECT_TRUE(json["mean_radius_weighted"].is_null());
  EXPECT_EQ(json["list"][0]["percolating"], true);
  EXPECT_FALSE(json["list"][0].contains("area"));
}

TEST(pores_section, takes_the_gap_tolerance_and_works_without_a_cell) {
  auto d = oracle::read_disks(ISOSTAT_DATA "/geometry/holes_tangent_square.json");
  for (auto& r : d.radius) r -= 1e-4;
  EXPECT_EQ(pores_section(input_of(d), {})["count"], 1);
  AnalysisOptions options;
  options.gap_tolerance = 3e-4;
  EXPECT_EQ(pores_section(input_of(d), options)["count"], 9);
  auto open = input_of(d);
  open.state.packing.cell.reset();  // 3 x 3 disks in the plane enclose four pores
  EXPECT_EQ(pores_section(open, options)["count"], 4);
  EXPECT_EQ(pores_section(open, options)["percolating"], 0);
}

TEST(pores_section, refuses_3d) {
  AnalysisInput input;
  input.packing_3d.emplace();
  EXPECT_EQ(oracle::refusal(input, "pores"), "is defined for packings in the plane; this one is in 3D");
}

TEST(pores_section, share_of_small_pores_and_size_law_follow_from_the_list) {
  const auto d = oracle::read_disks(ISOSTAT_DATA "/geometry/holes_thin_chains.json");
  const auto input = input_of(d);
  for (const double size : {0.2, 1.0, 5.0, 100.0}) {
    AnalysisOptions options;
    options.pore_size = size;
    const auto json = pores_section(input, options);
    double small = 0, all = 0;
    std::int64_t count = 0;
    for (const auto& p : json["list"]) {
      all += p["area"].get<double>();
      if (p["R"].get<double>() < size) small += p["area"].get<double>(), ++count;
    }
    EXPECT_EQ(json["small"]["size"], size);
    EXPECT_EQ(json["small"]["count"], count);
    EXPECT_NEAR(json["small"]["share"].get<double>(), small / all, 1e-12);
    const double cell = d.cell.measure(), void_area = cell - json["covered_area"].get<double>();
    EXPECT_NEAR(json["small"]["share_of_void"].get<double>(), small / void_area, 1e-9);
    EXPECT_NEAR(all, void_area, 1e-6 * cell);  // none percolates
  }
  const auto json = pores_section(input, {});
  EXPECT_EQ(json["small"]["size"], 2 * *std::max_element(d.radius.begin(), d.radius.end()));
  EXPECT_FALSE(json["size_law"]["identifiable"].get<bool>());  // 15 pores
  EXPECT_EQ(json["size_law"]["to"], nullptr);
}

TEST(pores_section, exponent_of_many_pores_in_a_window) {
  AnalysisOptions options;
  options.pore_window = {{0.01, 0.3}};
  const auto json = pores_section(load_input(ISOSTAT_DATA "/clusters/dense_1400.net", {}), options);
  std::vector<double> radii;
  double logs = 0;
  for (const auto& p : json["list"])
    if (p["R"].is_number() && p["R"].get<double>() >= 0.01 && p["R"].get<double>() < 0.3)
      radii.push_back(p["R"].get<double>()), logs += std::log(radii.back());
  ASSERT_GE(radii.size(), 100u);
  EXPECT_EQ(json["size_law"]["count"], radii.size());
  // By a search: the exponent that makes ln L = -q sum ln R - n ln int R^-q largest.
  double best = -1e300, exponent = 0;
  for (double q = -3; q < 5; q += 1e-3) {
    const double e = 1 - q, norm = std::abs(e) < 1e-9 ? std::log(30.0) : (std::pow(0.3, e) - std::pow(0.01, e)) / e;
    const double l = -q * logs - static_cast<double>(radii.size()) * std::log(norm);
    if (l > best) best = l, exponent = q;
  }
  EXPECT_NEAR(json["size_law"]["exponent"].get<double>(), exponent, 1e-3);
}

}  // namespace
}  // namespace isostat
