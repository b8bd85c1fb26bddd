#include "geometry/pores.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <random>

#include "tests/oracle/arc_arrangement.hpp"
#include "tests/oracle/union_mesh.hpp"
#include "tests/support/disk_packings.hpp"

namespace isostat {
namespace {

using oracle::Disks;

constexpr double kPi = std::numbers::pi;
const std::string kData = ISOSTAT_DATA "/geometry/";

Pores pores_of(const Disks& d, const PoreOptions& options = {}) {
  return find_pores(d.centre, d.radius, d.cell, options);
}

double total_area(const Pores& p) {
  double sum = p.covered_area;
  for (const auto& pore : p.pores) sum += pore.area;
  return sum;
}

void expect_closed(const Pores& p, const Disks& d) { EXPECT_NEAR(total_area(p) / d.cell.measure(), 1, 1e-12); }

std::size_t percolating(const Pores& p) {
  return static_cast<std::size_t>(
      std::count_if(p.pores.begin(), p.pores.end(), [](const Pore& q) { return q.percolating; }));
}

// Distance between two points on the torus.
double apart(Vec2 a, Vec2 b, const PeriodicCell<2>& cell) {
  const Vec2 s = b - a;
  return norm(s + cell.offset(cell.nearest_image(s)));
}

struct PoreCase : testing::TestWithParam<const char*> {};

TEST_P(PoreCase, matches_the_checked_case) {
  const std::string path = kData + "holes_" + GetParam() + ".json";
  const auto d = oracle::read_disks(path);
  std::ifstream in(path);
  const auto expected = nlohmann::json::parse(in);
  const auto found = pores_of(d, {.with_arcs = true});
  expect_closed(found, d);
  const double area_tolerance = 1e-11 * d.cell.measure();
  std::vector<nlohmann::json> finite, percolating_pores;
  for (const auto& h : expected["holes"]) (h["percolating"].get<bool>() ? percolating_pores : finite).push_back(h);
  ASSERT_EQ(found.pores.size() - percolating(found), finite.size());
  EXPECT_EQ(percolating(found) > 0, !percolating_pores.empty());
  if (!percolating_pores.empty() && !percolating_pores[0]["area"].is_null()) {
    EXPECT_NEAR(found.pores[0].area, percolating_pores[0]["area"].get<double>(), area_tolerance);
  }
  if (!percolating_pores.empty() && percolating(found) == 1) {
    EXPECT_EQ(pore_polygons(found, 0).size(), percolating_pores[0]["nloops"].get<std::size_t>());
  }
  // Equal areas may come in any order: match by centroid.
  for (const auto& h : finite) {
    const Vec2 c{h["cx"].get<double>(), h["cy"].get<double>()};
    const auto best = std::min_element(found.pores.begin(), found.pores.end(), [&](const Pore& a, const Pore& b) {
      return (a.percolating ? 1e9 : apart(a.centroid, c, d.cell)) <
             (b.percolating ? 1e9 : apart(b.centroid, c, d.cell));
    });
    EXPECT_NEAR(best->area, h["area"].get<double>(), area_tolerance);
    EXPECT_NEAR(apart(best->centroid, c, d.cell), 0, 1e-9);
    EXPECT_NEAR(best->equivalent_radius, h["RH"].get<double>(), 1e-9);
    EXPECT_NEAR(best->gyration, h["J"].get<double>(), 1e-9 * std::max(1e-6, h["J"].get<double>()));
    EXPECT_EQ(pore_polygons(found, static_cast<std::size_t>(best - found.pores.begin())).size(),
              h["nloops"].get<std::size_t>());
  }
  if (!expected["mean_weighted"].is_null()) {
    EXPECT_NEAR(mean_radius_weighted(found.pores), expected["mean_weighted"].get<double>(), 1e-9);
  }
}
INSTANTIATE_TEST_SUITE_P(checked, PoreCase,
                         testing::Values("foam24", "one_disk_open", "one_disk_overlap", "one_disk_tangent",
                                         "poisson_311", "poisson_60", "rsa60", "tangent_square", "thin_chains"));

// Random packings against brute force: the loops of the walls, their lengths, areas and windings.
void expect_same_loops(const Disks& d) {
  const auto found = pores_of(d, {.with_arcs = true});
  expect_closed(found, d);
  const auto loops = oracle::wall_loops(d);
  double length = 0, winding_free = 0;
  std::size_t count = 0;
  for (const auto& l : loops) length += l.length;
  EXPECT_NEAR(found.perimeter, length, 1e-11 * length + 1e-13);
  for (std::size_t k = 0; k < found.pores.size(); ++k) count += pore_polygons(found, k).size();
  EXPECT_EQ(count, loops.size());
  for (const auto& p : found.pores)
    if (!p.percolating) winding_free += p.area;
  // Where nothing winds, the void is the sum of its loops (islands' walls included).
  if (percolating(found) == 0) {
    double sum = 0;
    for (const auto& l : loops) sum -= l.signed_area;
    EXPECT_NEAR(winding_free, sum, 1e-11 * d.cell.measure());
  }
  if (percolating(found) == 1 && found.pores[0].along[0] && found.pores[0].along[1]) {
    bool winds = false;
    double covered = 0;
    for (const auto& l : loops) winds |= l.winding != std::array<int, 2>{}, covered += l.signed_area;
    // Nothing winds: the solid is what the loops enclose, pores inside islands taken off.
    if (!winds) {
      EXPECT_NEAR(found.covered_area, covered, 1e-11 * d.cell.measure());
    }
  }
}

TEST(pores, random_overlapping_disks_against_brute_force) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    expect_same_loops(oracle::poisson_disks(20 + 12 * seed, {12, 9}, 0.05, 0.5, seed));
    expect_same_loops(oracle::poisson_disks(3 + seed % 7, {1.5, 1}, 0.1, 0.6, seed));
  }
}

TEST(pores, chains_islands_and_hidden_disks_against_brute_force) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    auto d = oracle::chain_disks(6 + seed, {25, 20}, 1e-6, seed);
    expect_same_loops(d);
    const auto n = d.centre.size();
    for (std::size_t i = 0; i < n; i += 3)
      d.centre.push_back(d.centre[i]), d.radius.push_back(0.7 * d.radius[i]);  // hidden
    expect_same_loops(d);
  }
}

TEST(pores, agree_with_the_mesh_within_its_error) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const auto d = oracle::chain_disks(14, {25, 20}, 0.02, seed);
    const double step = 1.0 / 100;
    const auto mesh = oracle::mesh_pores(oracle::union_mesh(d.centre, d.radius, d.cell, step));
    const auto found = pores_of(d), closed = pores_of(d, {.gap_tolerance = 3 * step});
    // The mesh takes gaps below its step for closed: compare the pores that do not depend on such gaps.
    for (const auto& p : found.pores) {
      const bool robust = std::any_of(closed.pores.begin(), closed.pores.end(),
                                      [&](const Pore& q) { return std::abs(p.area - q.area) < 1e-9; });
      if (p.percolating || !robust || p.area < 0.05) continue;
      const auto same = std::find_if(mesh.begin(), mesh.end(), [&](const oracle::MeshPore& q) {
        return apart(p.centroid, q.centroid, d.cell) < 5 * step && std::abs(q.area - p.area) < 0.1 * p.area;
      });
      ASSERT_NE(same, mesh.end()) << p.area;
      EXPECT_NEAR(same->area, p.area, 3e-3 * std::max(1.0, std::sqrt(p.area)));
      EXPECT_NEAR(same->equivalent_radius, p.equivalent_radius, 3e-3 * std::max(1.0, p.equivalent_radius));
      ++compared;
    }
  }
  EXPECT_GT(compared, 25);
}

// Square of four disks at the corners of a square of side 1 + gap in a large cell.
Disks ring_of_four(double gap) {
  Disks d;
  d.cell.length = {4, 4};
  const double low = 1.25, high = low + 1;
  d.centre = {{low, low}, {high, low}, {high, high + gap}, {low, high + gap}};
  d.radius = {0.5, 0.5, 0.5, 0.5};
  return d;
}

TEST(pores, gaps_of_1e_14_and_exact_tangencies_are_told_apart) {
  for (const double gap : {0.0, 8e-15, 1e-14, 1e-12, -1e-14}) {
    SCOPED_TRACE(gap);
    const double real_gap = (2.25 + gap) - 2.25;
    const auto p = pores_of(ring_of_four(gap));
    EXPECT_EQ(p.pores.size(), real_gap > 0 ? 1u : 2u);
    EXPECT_EQ(percolating(p), 1u);
    EXPECT_NEAR(total_area(p), 16, 1e-13);
  }
}

TEST(pores, gap_tolerance_closes_gaps_and_keeps_areas) {
  const double gap = 0.004;
  const auto d = ring_of_four(gap);
  EXPECT_EQ(pores_of(d).pores.size(), 1u);
  EXPECT_EQ(pores_of(d, {.gap_tolerance = 0.0039}).pores.size(), 1u);
  const auto p = pores_of(d, {.gap_tolerance = 0.0041});
  ASSERT_EQ(p.pores.size(), 2u);
  EXPECT_NEAR(p.pores[1].area, 1 + gap - kPi / 4, 1e-14);  // rectangle of the centres less four quarter disks
  EXPECT_NEAR(total_area(p), 16, 1e-13);
  EXPECT_NEAR(p.covered_area, kPi, 1e-14);
}

TEST(pores, gap_tolerance_on_random_packings_closes_the_area_too) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto d = oracle::rsa_disks(300, {16, 14}, 0.25, 0.5, seed);
    std::size_t before = 0;
    for (const double tolerance : {0.0, 0.01, 0.05, 0.1, 0.3}) {
      const auto p = pores_of(d, {.gap_tolerance = tolerance});
      expect_closed(p, d);
      EXPECT_GE(p.pores.size(), before);
      before = p.pores.size();
    }
    EXPECT_GT(before, 20u);
  }
}

TEST(pores, stripes_percolate_in_one_direction_each) {
  Disks d;  // two horizontal rows of overlapping disks: two pores, both winding along x only
  d.cell.length = {4, 8};
  for (int k = 0; k < 8; ++k)
    for (const double y : {1.0, 4.0}) d.centre.push_back({0.5 * k + 0.1, y}), d.radius.push_back(0.5);
  auto p = pores_of(d);
  ASSERT_EQ(p.pores.size(), 2u);
  for (const auto& pore : p.pores) {
    EXPECT_TRUE(pore.percolating && pore.along[0] && !pore.along[1]);
  }
  EXPECT_GT(p.pores[0].area, p.pores[1].area);
  expect_closed(p, d);
  EXPECT_TRUE(std::isnan(mean_radius_weighted(p.pores)));
  for (auto& c : d.centre) std::swap(c[0], c[1]);
  std::swap(d.cell.length[0], d.cell.length[1]);
  p = pores_of(d);
  ASSERT_EQ(p.pores.size(), 2u);
  EXPECT_TRUE(p.pores[0].along[1] && !p.pores[0].along[0]);
}

TEST(pores, a_diagonal_wall_leaves_a_pore_that_winds_both_ways_at_once) {
  Disks d;
  d.cell.length = {6, 6};
  for (int k = 0; k < 12; ++k) d.centre.push_back({0.5 * k, 0.5 * k}), d.radius.push_back(0.5);
  const auto p = pores_of(d);
  ASSERT_EQ(p.pores.size(), 1u);
  EXPECT_TRUE(p.pores[0].percolating && p.pores[0].along[0] && p.pores[0].along[1]);
  expect_closed(p, d);
}

TEST(pores, no_disk_is_one_percolating_void_and_full_cover_is_none) {
  const PeriodicCell<2> cell{{3, 5}};
  const auto empty = find_pores({}, {}, cell);
  ASSERT_EQ(empty.pores.size(), 1u);
  EXPECT_TRUE(empty.pores[0].percolating);
  EXPECT_DOUBLE_EQ(empty.pores[0].area, 15);
  Disks d{{{1, 1}}, {{0.3, 0.9}}, {0.8}};  // > 1/sqrt(2): covers the cell
  auto p = pores_of(d);
  EXPECT_TRUE(p.pores.empty());
  EXPECT_NEAR(p.covered_area, 1, 1e-13);
  EXPECT_EQ(p.perimeter, 0);
  d.radius = {40};
  p = pores_of(d);
  EXPECT_TRUE(p.pores.empty());
  EXPECT_NEAR(p.covered_area, 1, 1e-12);
}

TEST(pores, one_small_disk_and_points) {
  Disks d{{{1, 1}}, {{0, 0}}, {1e-3}};
  auto p = pores_of(d);
  ASSERT_EQ(p.pores.size(), 1u);
  EXPECT_NEAR(p.covered_area, kPi * 1e-6, 1e-18);
  expect_closed(p, d);
  d.radius = {0};
  p = pores_of(d);
  ASSERT_EQ(p.pores.size(), 1u);
  EXPECT_EQ(p.covered_area, 0);
}

TEST(pores, cells_of_aspect_ratio_100) {
  for (const Vec2 length : {Vec2{100, 1}, Vec2{1, 100}, Vec2{200, 2}}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(seed);
      expect_same_loops(oracle::poisson_disks(150, length, 0.05, 0.5, seed));
      expect_same_loops(oracle::poisson_disks(2, length, 0.05, 0.5, seed));
    }
  }
}

TEST(pores, coordinates_on_edges_and_in_other_images_change_nothing) {
  Disks d{{{3, 3}}, {}, {}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) d.centre.push_back({double(i), double(j)}), d.radius.push_back(0.5);
  const auto reference = pores_of(d);
  ASSERT_EQ(reference.pores.size(), 9u);
  for (std::size_t k = 0; k < d.centre.size(); ++k) d.centre[k] += Vec2{3.0 * (int(k) % 5 - 2), -3.0 * (int(k) % 3)};
  const auto moved = pores_of(d);
  ASSERT_EQ(moved.pores.size(), 9u);
  for (const auto& p : moved.pores) EXPECT_NEAR(p.area, 1 - kPi / 4, 1e-15);
}

// Hexagonal, square and kagome-like lattices of tangent disks: all degenerate at once.
TEST(pores, degenerate_lattices_at_all_sizes) {
  for (int n = 1; n <= 12; ++n) {
    Disks d{{{double(n), double(n)}}, {}, {}};
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) d.centre.push_back({double(i), double(j)}), d.radius.push_back(0.5);
    EXPECT_EQ(pores_of(d).pores.size(), std::size_t(n * n));
    for (auto& r : d.radius) r = 0.5 - 0x1p-50;
    const auto p = pores_of(d);
    ASSERT_EQ(p.pores.size(), 1u);
    EXPECT_TRUE(p.pores[0].percolating);
    for (auto& r : d.radius) r = 0.71;  // > 1/sqrt 2: closed at the centres
    EXPECT_TRUE(pores_of(d).pores.empty());
  }
}

TEST(pores, results_do_not_depend_on_the_order_of_disks) {
  const auto d = oracle::chain_disks(12, {25, 20}, 1e-5, 3);
  auto e = d;
  std::vector<std::size_t> order(d.centre.size());
  std::iota(order.begin(), order.end(), 0u);
  std::mt19937_64 g(5);
  std::shuffle(order.begin(), order.end(), g);
  for (std::size_t k = 0; k < order.size(); ++k) e.centre[k] = d.centre[order[k]], e.radius[k] = d.radius[order[k]];
  const auto p = pores_of(d), q = pores_of(e);
  ASSERT_EQ(p.pores.size(), q.pores.size());
  for (std::size_t k = 0; k < p.pores.size(); ++k) EXPECT_NEAR(p.pores[k].area, q.pores[k].area, 1e-12);
}

TEST(pores, enclosed_in_the_plane) {
  Disks d;  // ring of 12 touching disks with one inside
  const double ring = 0.5 / std::sin(kPi / 12);
  for (int k = 0; k < 12; ++k)
    d.centre.push_back({100 + ring * std::cos(kPi * k / 6), -40 + ring * std::sin(kPi * k / 6)}),
        d.radius.push_back(0.5 + 1e-9);
  d.centre.push_back({100.2, -40.1}), d.radius.push_back(0.5);
  const auto p = find_enclosed_pores(d.centre, d.radius);
  ASSERT_EQ(p.pores.size(), 1u);
  // Polygon of the centres, less the inner sectors (sum of interior angles 10 pi), less the disk inside.
  const double polygon = 12 * 0.25 / std::tan(kPi / 12);
  EXPECT_NEAR(p.pores[0].area, polygon - 0.5 * 0.25 * 10 * kPi - kPi * 0.25, 1e-7);
  EXPECT_TRUE(find_enclosed_pores({}, {}).pores.empty());
}

TEST(pores, polygons_reproduce_areas) {
  const auto d = oracle::chain_disks(10, {25, 20}, 1e-3, 7);
  const auto p = pores_of(d, {.with_arcs = true});
  for (std::size_t k = 0; k < p.pores.size(); ++k) {
    if (p.pores[k].percolating) continue;
    double area = 0;
    for (const auto& loop : pore_polygons(p, k, 0.01))
      for (std::size_t m = 0; m < loop.size(); ++m) {
        const Vec2 a = loop[m], b = loop[(m + 1) % loop.size()];
        area -= 0.5 * (a[0] * b[1] - a[1] * b[0]);
      }
    double bound = 1e-12;  // each circular segment of angle s that a chord cuts off has area r^2 s^3 / 12
    for (std::uint32_t n = 0; n < p.pores[k].arcs; ++n) {
      const auto& arc = p.arcs[p.pores[k].first_arc + n];
      bound += arc.radius * arc.radius * arc.sweep * 1e-4 / 12;
    }
    EXPECT_NEAR(area, p.pores[k].area, bound);
  }
}

TEST(pores, refuses_bad_numbers) {
  const PeriodicCell<2> cell{{1, 1}};
  const std::vector<Vec2> one{{0, 0}};
  const std::vector<double> good{0.1}, negative{-0.1}, nan{std::nan("")};
  EXPECT_THROW(find_pores(one, negative, cell), std::invalid_argument);
  EXPECT_THROW(find_pores(one, nan, cell), std::invalid_argument);
  EXPECT_THROW(find_pores(one, {}, cell), std::invalid_argument);
  EXPECT_THROW(find_pores(one, good, {{0, 1}}), std::invalid_argument);
  EXPECT_THROW(find_pores(one, good, cell, {.gap_tolerance = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace isostat
