#include "geometry/overlap_batch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "geometry/base/index.hpp"
#include "geometry/triangle_overlap.hpp"
#include "tests/support/triangle_pairs.hpp"

namespace isostat {
namespace {

using oracle::PairKind;
using oracle::TrianglePair;

constexpr double kUnit = 0x1p-53;

struct Batch {
  std::vector<TrianglePair> pairs;
  std::array<std::vector<double>, 6> out;
};

void run(Batch& batch, Isa isa) {
  const std::size_t n = batch.pairs.size();
  std::array<std::vector<double>, 12> in;
  for (auto& column : in) column.resize(n);
  for (auto& column : batch.out) column.assign(n + 1, 0.125);
  TriangleArrays a, b;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t p = 0; p < n; ++p) {
      in[k][p] = batch.pairs[p].a.corner[k][0], in[k + 3][p] = batch.pairs[p].a.corner[k][1];
      in[k + 6][p] = batch.pairs[p].b.corner[k][0], in[k + 9][p] = batch.pairs[p].b.corner[k][1];
    }
    a.x[k] = in[k].data(), a.y[k] = in[k + 3].data(), b.x[k] = in[k + 6].data(), b.y[k] = in[k + 9].data();
  }
  auto& o = batch.out;
  overlap_batch(isa)(n, a, b, {o[0].data(), o[1].data(), o[2].data(), o[3].data(), o[4].data(), o[5].data()});
  for (const auto& column : o) ASSERT_EQ(column[n], 0.125);  // nothing written past the end
}

struct OverlapBatchOn : testing::TestWithParam<Isa> {
  void SetUp() override {
    if (GetParam() > machine_isa()) GTEST_SKIP() << "not on this machine";
  }
};

double extent(const TrianglePair& p) {
  double m = 0;
  for (const Triangle* t : {&p.a, &p.b})
    for (const Vec2& c : t->corner)
      m = std::max({m, std::abs((c - p.a.corner[0])[0]), std::abs((c - p.a.corner[0])[1])});
  return m;
}

// The smallest sine of the angles between successive sides: how much a rounding moves a corner.
double least_sine(const TriangleOverlap& o) {
  double least = 1;
  const auto sides = o.sides();
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Vec2 u = sides[k].along, v = sides[(k + 1) % sides.size()].along;
    least = std::min(least, std::abs(u[0] * v[1] - u[1] * v[0]) / (norm(u) * norm(v)));
  }
  return least;
}

double perimeter(const TriangleOverlap& o) {
  double sum = 0;
  for (const OverlapSide& s : o.sides()) sum += norm(s.along);
  return sum;
}

Batch pairs_of(const std::vector<PairKind>& kinds, int count, int nudge) {
  std::mt19937_64 random(11);
  Batch batch;
  for (int n = 0; n < count; ++n) {
    TrianglePair p = oracle::triangle_pair(kinds[idx(n) % kinds.size()], nudge, random);
    p.a = oracle::anticlockwise(p.a), p.b = oracle::anticlockwise(p.b);
    if (n / 20 % 4 == 1) p = oracle::scaled(p, n % 101 - 50);
    batch.pairs.push_back(p);
  }
  return batch;
}

TEST_P(OverlapBatchOn, area_is_right_for_every_pair) {
  for (const int nudge : {0, 1, 3}) {
    Batch batch = pairs_of({PairKind::random, PairKind::shallow, PairKind::lattice, PairKind::shared, PairKind::on_edge,
                            PairKind::collinear, PairKind::nested, PairKind::identical, PairKind::sliver},
                           7000, nudge);
    run(batch, GetParam());
    for (std::size_t n = 0; n < batch.pairs.size(); ++n) {
      const TrianglePair& p = batch.pairs[n];
      const double m = extent(p);
      const TriangleOverlap o = triangle_overlap(p.a, p.b);
      ASSERT_NEAR(batch.out[0][n], o.area, 64 * kUnit * m * m) << n << " " << name(o.type);
    }
  }
}

// In a bed: relative error by depth, as TRIANGLES.md measures it.
TEST_P(OverlapBatchOn, small_overlaps_keep_their_digits) {
  std::mt19937_64 random(12);
  for (const double depth : {1e-1, 1e-2, 1e-3, 1e-6}) {
    Batch batch;
    for (int n = 0; n < 4000; ++n)
      batch.pairs.push_back(oracle::moved(oracle::corner_into_edge(depth, random), n % 2 ? 45.0 : 0, n % 2 ? 5.0 : 0));
    run(batch, GetParam());
    for (std::size_t n = 0; n < batch.pairs.size(); ++n) {
      const TriangleOverlap o = triangle_overlap(batch.pairs[n].a, batch.pairs[n].b);
      ASSERT_NEAR(batch.out[0][n] / o.area, 1, 100 * kUnit / depth) << depth;
      ASSERT_NEAR(batch.out[0][n], o.area, 16 * kUnit * perimeter(o) * extent(batch.pairs[n])) << depth;
      ASSERT_NEAR(batch.out[5][n] / o.chords()[0].length, 1, 100 * kUnit / depth) << depth;
    }
  }
}

TEST_P(OverlapBatchOn, gradients_are_those_of_the_exact_path) {
  Batch batch = pairs_of({PairKind::random, PairKind::shallow, PairKind::sliver}, 9000, 0);
  run(batch, GetParam());
  std::array<int, 8> seen{};
  for (std::size_t n = 0; n < batch.pairs.size(); ++n) {
    const TrianglePair& p = batch.pairs[n];
    const TriangleOverlap o = triangle_overlap(p.a, p.b);
    ++seen[static_cast<std::size_t>(o.type)];
    if (o.type < OverlapType::degenerate) continue;
    const double m = extent(p), error = 64 * kUnit * m / least_sine(o);
    if (error > 0.01 * m) continue;  // edges parallel within rounding
    ASSERT_NEAR(batch.out[1][n], o.gradient_a.translation[0], error) << n << " " << name(o.type);
    ASSERT_NEAR(batch.out[2][n], o.gradient_a.translation[1], error) << n << " " << name(o.type);
    ASSERT_NEAR(batch.out[3][n], o.gradient_a.rotation, m * error) << n << " " << name(o.type);
    ASSERT_NEAR(batch.out[4][n], o.gradient_b.rotation, m * error) << n << " " << name(o.type);
    ASSERT_NEAR(batch.out[5][n], norm(o.gradient_a.translation), error) << n << " " << name(o.type);
  }
  for (const OverlapType t : {OverlapType::i, OverlapType::ii, OverlapType::iii, OverlapType::iv, OverlapType::v})
    EXPECT_GT(seen[static_cast<std::size_t>(t)], 10) << name(t);
}

// Squares of four triangles in an exact lattice, turned as a whole: flat on flat, corners on corners, shared edges.
TEST_P(OverlapBatchOn, neighbours_in_a_lattice_have_no_area) {
  for (const double angle : {0.0, 0.3, 0.7853981633974483}) {
    const double c = std::cos(angle), s = std::sin(angle);
    const auto at = [&](double x, double y) { return Vec2{c * x - s * y, s * x + c * y}; };
    std::vector<Triangle> triangles;
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j)
        for (int k = 0; k < 4; ++k) {
          constexpr double x[] = {0, 1, 1, 0, 0}, y[] = {0, 0, 1, 1, 0};
          triangles.push_back({{at((i + x[k]) / 7.0, (j + y[k]) / 7.0), at((i + x[k + 1]) / 7.0, (j + y[k + 1]) / 7.0),
                                at((i + 0.5) / 7.0, (j + 0.5) / 7.0)}});
        }
    Batch batch;
    for (const Triangle& t : triangles)
      for (const Triangle& u : triangles)
        if (&t != &u) batch.pairs.push_back({t, u});
    run(batch, GetParam());
    for (std::size_t n = 0; n < batch.pairs.size(); ++n) ASSERT_LE(batch.out[0][n], 64 * kUnit) << angle << " " << n;
  }
}

TEST_P(OverlapBatchOn, a_pair_is_the_same_wherever_it_stands) {
  Batch batch = pairs_of({PairKind::random, PairKind::shallow}, 61, 0);
  run(batch, GetParam());
  for (std::size_t first = 0; first < 61; first += 7)
    for (const std::size_t count : {1u, 3u, 9u}) {
      Batch part;
      for (std::size_t n = first; n < std::min<std::size_t>(61, first + count); ++n)
        part.pairs.push_back(batch.pairs[n]);
      run(part, GetParam());
      for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t n = 0; n < part.pairs.size(); ++n) ASSERT_EQ(part.out[k][n], batch.out[k][first + n]);
    }
  Batch none;
  run(none, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Isas, OverlapBatchOn, testing::Values(Isa::scalar, Isa::avx2, Isa::avx512),
                         [](const auto& each) { return std::string(name(each.param)); });

}  // namespace
}  // namespace isostat
