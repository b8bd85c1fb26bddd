#include "geometry/disk_transform.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "geometry/pores.hpp"
#include "geometry/wall_points.hpp"
#include "tests/oracle/direct_transform.hpp"

namespace isostat {
namespace {

using oracle::Disks;
constexpr double kPi = std::numbers::pi;

DiskTransform transform_of(const Disks& d, const TransformOptions& options) {
  return disk_transform(d.centre, d.radius, d.cell, options);
}
Vec2 wave(const Disks& d, std::int64_t mx, std::int64_t my) {
  return {2 * kPi * double(mx) / d.cell.length[0], 2 * kPi * double(my) / d.cell.length[1]};
}
double solid(const Disks& d) {
  double sum = 0;
  for (const double r : d.radius) sum += kPi * r * r;
  return sum;
}

// Largest deviation over some modes, in units of the rms of a transform of independent disks.
template <class Reference>
double deviation(const Disks& d, const DiskTransform& t, Reference&& reference, std::int64_t stride = 1) {
  double rms = 0, worst = 0;
  for (const double r : d.radius) rms += std::pow(kPi * r * r, 2);
  for (std::int64_t mx = 0; mx <= t.mx_max; mx += stride)
    for (std::int64_t my = -t.my_max; my <= t.my_max; my += stride) {
      const Vec2 k = wave(d, mx, my);
      if (norm(k) > t.k_max || norm(k) == 0) continue;
      worst = std::max(worst, std::abs(t.at(mx, my) - reference(d, k)));
    }
  return worst / std::sqrt(rms);
}

struct ScatterCase : testing::TestWithParam<const char*> {};
TEST_P(ScatterCase, modes_match_the_checked_case) {
  const std::string data = ISOSTAT_DATA "/geometry/";
  std::ifstream in(data + "scatter_" + GetParam() + ".json");
  const auto expected = nlohmann::json::parse(in);
  const auto d = oracle::read_disks(data + expected["packing"].get<std::string>());
  const auto t = transform_of(d, {.k_max = 13});
  ASSERT_EQ(expected["modes"].size(), 40u);
  for (const auto& m : expected["modes"]) {
    const auto chi = t.at(m[0].get<std::int64_t>(), m[1].get<std::int64_t>());
    EXPECT_NEAR(chi.real(), m[2].get<double>(), 1e-8) << m;
    EXPECT_NEAR(chi.imag(), m[3].get<double>(), 1e-8) << m;
  }
}
INSTANTIATE_TEST_SUITE_P(checked, ScatterCase, testing::Values("rsa60", "foam24"));

TEST(disk_transform, equals_the_direct_sum_for_separate_disks) {
  const auto d = oracle::rsa_disks(200, {17, 13}, 0.25, 0.5, 3);
  const auto t = transform_of(d, {.k_max = 4 * kPi});
  EXPECT_LT(deviation(d, t, oracle::sum_over_disks), 2e-8);
  EXPECT_NEAR(std::abs(t.at(0, 0)), solid(d), 1e-7 * solid(d));
}

TEST(disk_transform, error_falls_with_the_kernel_width) {
  const auto d = oracle::rsa_disks(100, {12, 12}, 0.25, 0.5, 4);
  double before = 1;
  for (const int width : {3, 5, 7, 9, 11}) {
    const double error =
        deviation(d, transform_of(d, {.k_max = 4 * kPi, .kernel_width = width}), oracle::sum_over_disks);
    EXPECT_LT(error, 10 * std::pow(10.0, 1.5 - width)) << width;
    EXPECT_LT(error, 0.2 * before) << width;
    before = error;
  }
  for (const double sigma : {1.5, 2.0, 3.0})
    EXPECT_LT(deviation(d, transform_of(d, {.k_max = 4 * kPi, .kernel_width = 12, .oversampling = sigma}),
                        oracle::sum_over_disks),
              1e-7);
}

TEST(disk_transform, very_unequal_disks) {
  auto d = oracle::poisson_disks(60, {23, 31}, 0.002, 0.4, 5);
  d.centre.push_back({5, 7}), d.radius.push_back(4);
  const auto t = transform_of(d, {.k_max = 20, .correct_overlaps = false});
  EXPECT_LT(deviation(d, t, oracle::sum_over_disks, 3), 2e-8);
}

TEST(disk_transform, lenses_of_dem_like_overlaps) {
  for (const double overlap : {1e-6, 1e-4, 3e-3, 0.03}) {
    SCOPED_TRACE(overlap);
    Disks d{{{9, 9.5}}, {}, {}};  // a wavy line of disks across the cell, no triple overlaps
    for (int k = 0; k < 10; ++k) d.centre.push_back({0.9 * k, 4 + std::sin(0.698131700797732 * k)});
    for (std::size_t k = 0; k < 10; ++k) {
      Vec2 s = d.centre[(k + 1) % 10] - d.centre[k];
      s += d.cell.offset(d.cell.nearest_image(s));
      d.radius.push_back(norm(s) / 2 * (1 + overlap));
    }
    const auto t = transform_of(d, {.k_max = 4 * kPi});
    EXPECT_LT(deviation(d, t, oracle::boundary_integral, 4), 3e-8);
    EXPECT_NEAR(t.at(0, 0).real(), find_pores(d.centre, d.radius, d.cell).covered_area, 1e-8);
  }
}

TEST(disk_transform, any_overlaps_at_all) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const auto d = oracle::poisson_disks(10 + 25 * seed, {6, 5}, 0.05, 0.6, seed);
    const auto t = transform_of(d, {.k_max = 12});
    EXPECT_LT(deviation(d, t, oracle::boundary_integral, 5), 1e-7);
    EXPECT_NEAR(t.at(0, 0).real(), find_pores(d.centre, d.radius, d.cell).covered_area, 1e-7);
  }
}

TEST(wall_points, of_voids_closed_to_rounding_are_few_and_finite) {
  std::size_t closed = 0;
  for (const bool hexagonal : {false, true})
    for (const double jitter : {0.0, 1e-15, 1e-14, 1e-12, 1e-9, 1e-6, 1e-3})
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Disks d = oracle::closing_lattice(hexagonal, jitter, seed);
        for (const auto& arc : find_pores(d.centre, d.radius, d.cell, {.with_arcs = true}).arcs)
          closed += arc.sweep < 0;
        const auto walls = wall_points(d.centre, d.radius, d.cell, 40, 1e-10);
        ASSERT_LT(walls.at.size(), 50u * 6 * d.centre.size());
        double sum_x = 0, sum_y = 0;
        for (std::size_t n = 0; n < walls.at.size(); ++n) {
          ASSERT_TRUE(std::isfinite(walls.at[n][0] + walls.at[n][1]));
          sum_x += walls.normal_x[n], sum_y += walls.normal_y[n];
        }
        EXPECT_NEAR(sum_x, 0, 1e-13);  // walls are closed
        EXPECT_NEAR(sum_y, 0, 1e-13);
      }
  EXPECT_GT(closed, 100u) << "no wall of the kind that the test is for";
}

TEST(disk_transform, voids_that_nearly_close) {
  for (const double jitter : {1e-9, 1e-6, 1e-2}) {
    const Disks d = oracle::closing_lattice(false, jitter, 2);
    EXPECT_LT(deviation(d, transform_of(d, {.k_max = 40}), oracle::boundary_integral, 7), 1e-7) << jitter;
  }
}

TEST(disk_transform, many_waves_along_one_arc) {  // a phase of +-1500: the series behind the number of points overflows
  const Disks d{{{1.7, 1.7}}, {{1, 1}, {1.3, 1.1}, {1.1, 1.3}}, {0.8, 0.4, 0.4}};
  const auto t = transform_of(d, {.k_max = 1200});
  EXPECT_LT(deviation(d, t, oracle::boundary_integral, 97), 1e-7);
}

TEST(disk_transform, cells_of_aspect_ratio_100_and_one_disk) {
  for (const Vec2 length : {Vec2{100, 1.3}, Vec2{1.3, 100}}) {
    const auto d = oracle::rsa_disks(30, length, 0.1, 0.3, 6);
    EXPECT_LT(deviation(d, transform_of(d, {.k_max = 15}), oracle::sum_over_disks), 3e-8);
  }
  const Disks one{{{1, 1}}, {{-3.3, 12.1}}, {0.4}};
  EXPECT_LT(deviation(one, transform_of(one, {.k_max = 100}), oracle::sum_over_disks), 3e-8);
  const Disks covered{{{1, 1}}, {{0.3, 0.9}}, {0.8}};
  const auto t = transform_of(covered, {.k_max = 20});
  EXPECT_NEAR(t.at(0, 0).real(), 1, 1e-7);
  EXPECT_LT(std::abs(t.at(1, 2)), 1e-7);
}

TEST(disk_transform, no_disk_is_zero_and_bad_numbers_are_refused) {
  const PeriodicCell<2> cell{{2, 3}};
  EXPECT_EQ(disk_transform({}, {}, cell, {.k_max = 10}).at(1, 1), 0.0);
  const std::vector<Vec2> one{{0, 0}};
  const std::vector<double> radius{0.1};
  EXPECT_THROW(disk_transform(one, radius, cell, {.k_max = 0}), std::invalid_argument);
  EXPECT_THROW(disk_transform(one, {}, cell, {.k_max = 1}), std::invalid_argument);
  EXPECT_THROW(disk_transform(one, radius, cell, {.k_max = 1e9}), std::length_error);
}

}  // namespace
}  // namespace isostat
