// Pairs of bodies of very different sizes against all pairs and images.
#include "dem/solver/size_levels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "dem/solver/random.hpp"

namespace isostat {
namespace {

template <int D>
using Found = std::multiset<std::array<int, D + 2>>;

template <int D>
Found<D> by_levels(const std::optional<PeriodicCell<D>>& cell, const std::vector<Vec<D>>& position,
                   const std::vector<double>& radius, double beyond) {
  Found<D> found;
  const SizeLevels<D> levels(cell, position, radius, beyond);
  levels.for_each_pair([&](std::int32_t i, std::int32_t j, const ImageShift<D>& s) {
    std::array<int, D + 2> pair{std::min(i, j), std::max(i, j)};
    for (std::size_t a = 0; a < D; ++a) pair[a + 2] = i < j ? s[a] : -s[a];
    found.insert(pair);
  });
  return found;
}

template <int D>
Found<D> all_pairs(const std::optional<PeriodicCell<D>>& cell, const std::vector<Vec<D>>& position,
                   const std::vector<double>& radius, double beyond) {
  Found<D> found;
  const int images = D == 2 ? 25 : 125;
  for (std::size_t i = 0; i < position.size(); ++i)
    for (std::size_t j = i + 1; j < position.size(); ++j)
      for (int code = 0; code < images; ++code) {
        const ImageShift<3> s{code % 5 - 2, code / 5 % 5 - 2, D == 2 ? 0 : code / 25 - 2};
        std::array<int, D + 2> pair{static_cast<int>(i), static_cast<int>(j)};
        ImageShift<D> shift;
        for (std::size_t a = 0; a < D; ++a) pair[a + 2] = shift[a] = s[a];
        if (!cell && shift != ImageShift<D>{}) continue;
        const Vec<D> d = position[j] + (cell ? cell->offset(shift) : Vec<D>{}) - position[i];
        if (norm(d) <= radius[i] + radius[j] + beyond) found.insert(pair);
      }
  return found;
}

template <int D>
void compare(double ratio, double length, bool periodic, std::uint64_t seed, double lean = 0) {
  Random random(seed);
  std::optional<PeriodicCell<D>> cell;
  Vec<D> edges;
  for (int a = 0; a < D; ++a) edges[a] = length * (1 + 0.2 * a);
  if (periodic) cell = PeriodicCell<D>{edges, lean * edges[0]};
  std::vector<Vec<D>> position(300);
  std::vector<double> radius(position.size());
  for (std::size_t k = 0; k < position.size(); ++k) {
    radius[k] = 0.5 * std::pow(ratio, -random.uniform());
    for (int a = 0; a < D; ++a) position[k][a] = edges[a] * random.uniform();
    if (k % 10 == 0) position[k][static_cast<int>(k / 10) % D] = 0;  // on an edge
    if (periodic) position[k][0] += cell->slant() * position[k][1];
  }
  const Found<D> expected = all_pairs<D>(cell, position, radius, 0.05);
  EXPECT_GT(expected.size(), 5u);
  EXPECT_EQ(by_levels<D>(cell, position, radius, 0.05), expected)
      << "ratio " << ratio << ", length " << length << ", lean " << lean;
}

TEST(SizeLevels, FindEveryPairOnce) {
  for (const bool periodic : {true, false})
    for (const double ratio : {1.0, 3.0, 10.0, 100.0, 1e4})
      for (const double length : {1.06, 1.5, 2.5, 7.0}) {
        compare<2>(ratio, length, periodic, 1);
        compare<3>(ratio, length, periodic, 2);
      }
}

// Opposite faces are as far apart as the lists ask for; a tilt of half an edge is the most that a run has, and
// restarts may bring more.
TEST(SizeLevels, FindEveryPairOfATiltedCellOnce) {
  for (const double lean : {-0.5, -0.21, 0.04, 0.37, 0.5, 0.8})
    for (const double ratio : {1.0, 3.0, 10.0, 100.0})
      for (const double length : {1.4, 2.5, 7.0}) {
        compare<2>(ratio, length, true, 3, lean);
        compare<3>(ratio, length, true, 4, lean);
      }
}

}  // namespace
}  // namespace isostat
