#include "analysis/structure/correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/structure/mean_overlap.hpp"
#include "analysis/structure/sections.hpp"
#include "geometry/pores.hpp"
#include "tests/oracle/exact_correlation.hpp"
#include "tests/support/disk_packings.hpp"
#include "tests/support/packing_input.hpp"

namespace isostat {
namespace {

using oracle::Disks;
using oracle::input_of;
constexpr double kPi = std::numbers::pi;

nlohmann::json read_json(const std::string& name) {
  std::ifstream in(ISOSTAT_DATA "/geometry/" + name);
  return nlohmann::json::parse(in);
}

TEST(dacf, matches_the_checked_case) {
  const auto expected = read_json("dacf_rsa60.json");
  const auto d = oracle::read_disks(ISOSTAT_DATA "/geometry/" + expected["packing"].get<std::string>());
  const auto r = expected["r"].get<std::vector<double>>();
  const auto curve = density_correlation(d.centre, d.radius, d.cell, r, 250);
  EXPECT_NEAR(curve.solid_fraction, expected["phi"].get<double>(), 1e-7);
  for (std::size_t n = 0; n < r.size(); ++n) EXPECT_NEAR(curve.c[n], expected["C"][n].get<double>(), 1e-6) << r[n];
  const auto coarse = density_correlation(d.centre, d.radius, d.cell, r);
  for (std::size_t n = 0; n < r.size(); ++n) EXPECT_NEAR(coarse.c[n], expected["C"][n].get<double>(), 2e-6) << r[n];
}

TEST(dacf, exact_invariants) {
  for (const auto& d : {oracle::rsa_disks(300, {20, 18}, 0.25, 0.5, 4), oracle::chain_disks(8, {25, 20}, 1e-5, 2)}) {
    const double h = 1e-3;
    const auto curve = density_correlation(d.centre, d.radius, d.cell, {0, h, 2 * h});
    const auto pores = find_pores(d.centre, d.radius, d.cell);
    EXPECT_NEAR(curve.c[0], pores.covered_area / d.cell.measure(), 3e-6);
    const double slope = -pores.perimeter / (kPi * d.cell.measure());
    EXPECT_NEAR((curve.c[1] - curve.c[0]) / h, slope, 0.02 * std::abs(slope));
  }
}

TEST(dacf, mean_overlap_of_two_disks_is_the_mean_over_directions) {
  const int directions = 20000;
  for (const auto& [r, q] : {std::pair{0.5, 0.5}, {0.5, 0.3}, {0.2, 0.9}})
    for (const double d : {0.05, 0.7, r + q, 1.01 * (r + q), 2.5})
      for (const double x : {0.0, 1e-3, 0.04, 0.3, 0.8, 1.9}) {
        double sum = 0;
        for (int n = 0; n < directions; ++n) {
          const double phi = kPi * (n + 0.5) / directions;
          sum += lens_area(r, q, std::hypot(d - x * std::cos(phi), x * std::sin(phi)));
        }
        EXPECT_NEAR(mean_overlap(r, q, d, x), sum / directions, 2e-5 * std::min(r, q) * std::min(r, q))
            << r << ' ' << q << ' ' << d << ' ' << x;
      }
}

// Against areas of unions, which know nothing of transforms.
void expect_exact_areas(const Disks& d, const std::vector<double>& r, double k_cut, double tolerance) {
  const auto curve = density_correlation(d.centre, d.radius, d.cell, r, k_cut);
  for (std::size_t n = 0; n < r.size(); ++n)
    EXPECT_NEAR(curve.c[n], oracle::exact_correlation(d, r[n], 100), tolerance) << r[n];
}
TEST(dacf, separate_touching_and_overlapping_disks_against_areas) {
  const std::vector<double> r{0, 0.02, 0.4, 1.7};
  expect_exact_areas(oracle::rsa_disks(60, {9, 8}, 0.25, 0.5, 1), r, 100, 5e-6);
  expect_exact_areas(oracle::chain_disks(2, {12, 11}, 1e-9, 1), r, 100, 5e-6);
  expect_exact_areas(oracle::chain_disks(2, {12, 11}, 1e-5, 1), r, 100, 5e-6);
  expect_exact_areas(oracle::chain_disks(2, {12, 11}, 4e-3, 1), r, 100, 5e-5);
  expect_exact_areas(oracle::poisson_disks(60, {8, 7}, 0.25, 0.5, 1), r, 100, 5e-5);
}
// Disks meet their own images; contacts are not split off here (5e-4 at a cut of 100), hence none.
TEST(dacf, a_cell_hardly_larger_than_its_disks) {
  const std::vector<double> r{0, 0.1, 0.3, 0.5, 0.62};
  expect_exact_areas({{{1.3, 1.4}}, {{0.2, 0.1}}, {0.5}}, r, 200, 2e-5);
  expect_exact_areas({{{1.3, 1.6}}, {{0.2, 0.1}, {0.2, 0.87}}, {0.4, 0.3}}, r, 200, 2e-5);
}

TEST(dacf, mass_is_the_integral_of_the_correlation) {
  const auto d = oracle::rsa_disks(200, {16, 15}, 0.25, 0.5, 5);
  std::vector<double> r;
  for (int n = 0; n <= 700; ++n) r.push_back(0.01 * n);
  const auto curve = density_correlation(d.centre, d.radius, d.cell, r);
  double sum = 0;
  for (std::size_t n = 1; n < r.size(); ++n) sum += 0.01 * kPi * (r[n] * curve.c[n] + r[n - 1] * curve.c[n - 1]);
  EXPECT_NEAR(curve.mass.back(), sum / curve.solid_fraction, 1e-4 * curve.mass.back());
}

TEST(dacf, section_has_its_keys) {
  const auto json = dacf_section(input_of(oracle::chain_disks(8, {25, 20}, 1e-4, 2)), {});
  EXPECT_EQ(json["r"].size(), json["C"].size());
  EXPECT_EQ(json["r"][0], 0.0);
  EXPECT_LT(json["r"].back().get<double>(), 10);
  EXPECT_TRUE(json["fit"].contains("d_F"));
  EXPECT_EQ(json["mass_radius"]["local_dimension"].size(), json["r"].size());
  EXPECT_NEAR(json["mass_radius"]["local_dimension"][1].get<double>(), 2, 0.1);
}

}  // namespace
}  // namespace isostat
