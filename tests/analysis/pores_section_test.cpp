#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

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

}  // namespace
}  // namespace isostat
