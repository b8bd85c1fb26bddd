// Tilted cells. Two exact references: cells whose tilts differ by a multiple of L1 are the same, and a cell with a tilt
// of L1 p / q holds as much as the q-th part of an upright one, q times as high, with q copies of every disk.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/cell_grid.hpp"
#include "geometry/disk_signs.hpp"
#include "geometry/disk_transform.hpp"
#include "geometry/periodic_cell.hpp"
#include "geometry/pores.hpp"
#include "tests/support/disk_packings.hpp"

namespace isostat {
namespace {

using oracle::Disks;

Disks tilted(Disks d, double tilt) {
  d.cell.tilt = tilt;
  return d;
}

// The upright cell of q copies; (tilt, L2) q = (p L1, q L2).
Disks upright(const Disks& d, int q) {
  Disks all;
  all.cell.length = {{d.cell.length[0], q * d.cell.length[1]}};
  for (int copy = 0; copy < q; ++copy)
    for (std::size_t k = 0; k < d.centre.size(); ++k) {
      all.centre.push_back(d.centre[k] + d.cell.offset({0, copy}));
      all.radius.push_back(d.radius[k]);
    }
  return all;
}

TEST(PeriodicCell, FractionsPointsAndImagesOfATiltedCell) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> anywhere(-9, 9), edge(0.5, 4);
  for (int k = 0; k < 2000; ++k) {
    const PeriodicCell<2> cell{{{edge(random), edge(random)}}, k % 4 == 0 ? 0.0 : anywhere(random)};
    const Vec2 r{{anywhere(random), anywhere(random)}}, f = cell.fractions(r);
    EXPECT_LT(norm(cell.point(f) - r), 1e-13 * (9 + std::abs(cell.tilt)));
    const Vec2 home = cell.wrap(r), g = cell.fractions(home);
    for (int a = 0; a < 2; ++a) {
      EXPECT_GE(g[a], -1e-15);
      EXPECT_LT(g[a], 1);
      EXPECT_NEAR(f[a] - g[a], std::round(f[a] - g[a]), 1e-12) << "home is an image";
    }
    // The nearest image, among all that can be.
    double best = INFINITY;
    for (int n = -25; n <= 25; ++n) {
      const double x = r[0] + n * cell.tilt, m = -std::round(x / cell.length[0]);
      best = std::min(best, std::hypot(x + m * cell.length[0], r[1] + n * cell.length[1]));
    }
    EXPECT_NEAR(norm(r + cell.offset(cell.nearest_image(r))), best, 1e-12);
    // A tilt lowered by `turns` edges: the same images by other names, and none of larger tilt than half an edge.
    const int turns = cell.turns();
    const PeriodicCell<2> lower{cell.length, cell.tilt - turns * cell.length[0]};
    EXPECT_LE(std::abs(lower.tilt), 0.5 * cell.length[0] * (1 + 1e-14));
    EXPECT_LT(norm(cell.offset({2, -3}) - lower.offset({2 + turns * -3, -3})), 1e-13 * (9 + std::abs(cell.tilt) * 3));
    // Distances of opposite edges.
    EXPECT_NEAR(cell.spacing()[0] * std::hypot(cell.tilt, cell.length[1]), cell.measure(), 1e-12 * cell.measure());
    EXPECT_EQ(cell.spacing()[1], cell.length[1]);
  }
}

// In space the third edge stands upright: nothing but its own coordinate sees it.
TEST(PeriodicCell, OfATiltedCellInSpace) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> anywhere(-9, 9), edge(0.5, 4);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 length{{edge(random), edge(random), edge(random)}};
    const PeriodicCell<3> cell{length, anywhere(random)};
    const PeriodicCell<2> base{{{length[0], length[1]}}, cell.tilt};
    const Vec3 r{{anywhere(random), anywhere(random), anywhere(random)}};
    const Vec2 flat{{r[0], r[1]}};
    EXPECT_LT(norm(cell.point(cell.fractions(r)) - r), 1e-13 * (9 + std::abs(cell.tilt)));
    const Vec3 home = cell.wrap(r);
    EXPECT_EQ((Vec2{{home[0], home[1]}}), base.wrap(flat));
    EXPECT_TRUE(home[2] >= 0 && home[2] < length[2]);
    const Vec3 near = r + cell.offset(cell.nearest_image(r));
    double best = INFINITY;  // among all that can be
    const Vec2 nearest = flat + base.offset(base.nearest_image(flat));
    for (int n = -25; n <= 25; ++n) best = std::min(best, std::hypot(norm(nearest), r[2] + n * length[2]));
    EXPECT_NEAR(norm(near), best, 1e-12);
    EXPECT_EQ(cell.spacing()[0], base.spacing()[0]);
    for (int a = 1; a < 3; ++a) EXPECT_EQ(cell.spacing()[a], length[a]);
    EXPECT_EQ(cell.measure(), length[0] * length[1] * length[2]);
  }
}

TEST(CellGrid, NeighboursOfATiltedCellLieInAdjacentColumns) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double tilt : {-3.0, -1.2, 0.7, 2.5, 9.0}) {
    const PeriodicCell<2> cell{{{7, 5}}, tilt};
    constexpr double kCutoff = 0.8;
    const CellGrid<2> grid(frame_of<2>(cell, {}), kCutoff, 400);
    EXPECT_GT(grid.size(), 4u);
    for (int k = 0; k < 2000; ++k) {
      const Vec2 a = cell.point({{unit(random), unit(random)}});
      const double angle = 6.3 * unit(random), distance = kCutoff * unit(random);
      const Vec2 b = a + Vec2{{distance * std::cos(angle), distance * std::sin(angle)}};
      const auto at = grid.columns(a), to = grid.columns(cell.wrap(b));
      const Vec2 f = cell.fractions(b);
      for (int axis = 0; axis < 2; ++axis) {
        const auto u = static_cast<std::size_t>(axis);
        const int unwrapped = to[u] + static_cast<int>(std::floor(f[axis])) * grid.count(axis);
        EXPECT_LE(std::abs(unwrapped - at[u]), 1);
        EXPECT_GE(grid.width(axis), kCutoff);
      }
    }
  }
}

std::vector<double> finite_areas(const Pores& pores, int copies) {
  std::vector<double> areas;
  for (const Pore& p : pores.pores)
    for (int k = 0; k < (p.percolating ? 0 : copies); ++k) areas.push_back(p.area);
  std::sort(areas.begin(), areas.end());
  return areas;
}
std::size_t percolating(const Pores& pores) {
  return static_cast<std::size_t>(
      std::count_if(pores.pores.begin(), pores.pores.end(), [](const Pore& p) { return p.percolating; }));
}

TEST(pores, of_tilted_cells_are_those_of_the_upright_cell_of_copies) {
  std::size_t finite = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Vec2 length{{8, seed % 3 == 0 ? 3.0 : 6.0}};
    const Disks base =
        seed % 2 ? oracle::poisson_disks(60, length, 0.2, 0.6, seed) : oracle::chain_disks(5, length, 1e-3, seed);
    for (const auto& [p, q] : {std::pair(1, 2), std::pair(-1, 3), std::pair(2, 5), std::pair(3, 1), std::pair(7, 2)}) {
      const Disks d = tilted(base, base.cell.length[0] * p / q), copies = upright(d, q);
      const Pores found = find_pores(d.centre, d.radius, d.cell),
                  expected = find_pores(copies.centre, copies.radius, copies.cell);
      EXPECT_NEAR(q * found.covered_area, expected.covered_area, 1e-9 * expected.covered_area);
      EXPECT_NEAR(q * found.perimeter, expected.perimeter, 1e-9 * (1 + expected.perimeter));
      EXPECT_EQ(percolating(found) > 0, percolating(expected) > 0);
      const auto have = finite_areas(found, q), want = finite_areas(expected, 1);
      ASSERT_EQ(have.size(), want.size()) << "seed " << seed << " tilt " << p << "/" << q;
      for (std::size_t k = 0; k < want.size(); ++k) EXPECT_NEAR(have[k], want[k], 1e-9 * d.cell.measure());
      finite += want.size();
    }
  }
  EXPECT_GT(finite, 100u);
}

// chi_hat of the cell at one of its wave vectors is the q-th part of that of the q copies at the same one.
TEST(disk_transform, of_tilted_cells_is_that_of_the_upright_cell_of_copies) {
  for (const bool overlapping : {false, true})
    for (const auto& [p, q] : {std::pair(1, 2), std::pair(-1, 3), std::pair(1, 1), std::pair(2, 5)}) {
      const Disks base = overlapping ? oracle::poisson_disks(50, {{6, 5}}, 0.2, 0.6, 8)
                                     : oracle::rsa_disks(40, {{6, 5}}, 0.15, 0.4, 9);
      const Disks d = tilted(base, base.cell.length[0] * p / q), copies = upright(d, q);
      const TransformOptions options{.k_max = 25, .kernel_width = 9};
      const DiskTransform found = disk_transform(d.centre, d.radius, d.cell, options),
                          expected = disk_transform(copies.centre, copies.radius, copies.cell, options);
      std::size_t modes = 0;
      for (std::int64_t mx = 0; mx <= found.mx_max; ++mx)
        for (std::int64_t my = -found.my_max; my <= found.my_max; ++my) {
          if (found.k2(mx, my) > 24.9 * 24.9) continue;
          const std::int64_t same = q * my - p * mx;  // k_y = 2 pi (my - mx p/q) / L2
          ASSERT_NEAR(found.k(mx, my)[1], expected.k(mx, same)[1], 1e-11);
          EXPECT_LT(std::abs(static_cast<double>(q) * found.at(mx, my) - expected.at(mx, same)), 3e-7)
              << mx << " " << my;
          ++modes;
        }
      // Every reciprocal vector of the half plane is there: one per (2 pi)^2 / A.
      const double all = 0.5 * 3.14159265 * 24.9 * 24.9 * d.cell.measure() / (4 * 9.8696);
      EXPECT_NEAR(static_cast<double>(modes), all, 0.05 * all);
    }
}

TEST(DiskSigns, AGapAcrossTheTiltedEdgeIsExact) {
  // The image of q along the second edge touches p exactly: 3-4-5 in units without rounding.
  const PeriodicCell<2> cell{{{64, 16}}, 3};
  const Vec2 p{{8, 12}}, q{{8, 0}};  // q + (3, 16) - p = (3, 4)
  EXPECT_EQ(gap_sign(p, q, 0, 1, cell, 2.5, 2.5, 0), 0);
  EXPECT_EQ(gap_sign(p, q, 0, 1, cell, 2.5, std::nextafter(2.5, 3), 0), -1);
  EXPECT_EQ(gap_sign(p, q, 0, 1, cell, 2.5, std::nextafter(2.5, 2), 0), 1);
}

}  // namespace
}  // namespace isostat
