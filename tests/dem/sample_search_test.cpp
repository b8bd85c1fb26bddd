// The two searches under insertion against looking at everything.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "dem/sample/grain_index.hpp"
#include "dem/sample/threshold_queue.hpp"
#include "dem/solver/random.hpp"
#include "tests/oracle/blind_insertion.hpp"

namespace isostat {
namespace {

template <int D>
void expect_all_found(const Enclosure<D>& room) {
  Random random(8);
  GrainIndex<D> index(room, 0.5, {20, 20, 20, 100, 100});
  for (int k = 0; k < 150; ++k) index.add(oracle::random_point(room, random), 0.5 * std::pow(0.04, random.uniform()));
  index.grow(149, 0.3);
  for (int k = 0; k < 400; ++k) {
    const Vec<D> x = oracle::random_point(room, random);
    const double reach = 0.5 * random.uniform() * random.uniform();
    std::vector<std::size_t> found, all;
    index.any_within(x, reach, [&](std::size_t i, double distance) {
      EXPECT_NEAR(distance, oracle::image_distance(room, x, index.grains()[i].centre), 1e-15);
      found.push_back(i);
      return false;
    });
    double deepest = reach;
    for (std::size_t i = 0; i < index.grains().size(); ++i) {
      const double gap = oracle::image_distance(room, x, index.grains()[i].centre) - index.grains()[i].radius;
      if (gap < reach) all.push_back(i);
      deepest = std::min(deepest, gap);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, all);
    const auto* g = index.overlapping(x, reach);
    ASSERT_EQ(g != nullptr, !all.empty());
    if (g) {
      EXPECT_NEAR(oracle::image_distance(room, x, g->centre) - g->radius, deepest, 1e-15);
    }
  }
}

TEST(GrainIndex, FindsAllThatAreNear) {
  expect_all_found<2>(Enclosure<2>::shell(1));
  expect_all_found<3>(Enclosure<3>::shell(1));
  expect_all_found<2>(Enclosure<2>::box({{1, 2.3}}));
  expect_all_found<3>(Enclosure<3>::box({{2.1, 1, 1.3}}));
}

TEST(ThresholdQueue, LetsGoWhatIsPassedAndNothingElse) {
  Random random(2);
  ThresholdQueue<int> queue(1, 0.1);
  std::vector<double> threshold;
  std::vector<bool> waits;
  for (double now = 1; now > 0.1; now -= 0.001 * random.uniform()) {
    for (int value; queue.pop(now, value);) {
      const auto v = static_cast<std::size_t>(value);
      EXPECT_TRUE(waits[v]);
      EXPECT_GE(threshold[v], now);
      waits[v] = false;
    }
    std::size_t waiting = 0;
    for (std::size_t v = 0; v < threshold.size(); ++v) {
      EXPECT_FALSE(waits[v] && threshold[v] >= now);
      waiting += waits[v];
    }
    ASSERT_EQ(queue.size(), waiting);
    threshold.push_back(0.1 + (now - 0.1) * random.uniform());
    waits.push_back(true);
    queue.push(threshold.back(), static_cast<int>(threshold.size()) - 1);
  }
}

}  // namespace
}  // namespace isostat
