// Packings of hierarchical insertion: what must hold of each one exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "dem/input_error.hpp"
#include "dem/sample/insertion_report.hpp"
#include "dem/sample/placement.hpp"
#include "tests/oracle/blind_insertion.hpp"

namespace isostat {
namespace {

struct Case {
  const char* name;
  int dimension;
  InsertionScene scene;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const int dimension : {2, 3}) {
    InsertionScene s;
    s.radius_min = 0.08, s.trials = 3000;
    all.push_back({"shell", dimension, s});
    s.room = InsertionRoom::box;
    s.box = {2, 1.3, 1};  // one edge is as short as the largest grain
    all.push_back({"box", dimension, s});
    s.box = {1, 6, 1};
    s.exponent = 0;
    all.push_back({"long box, uniform", dimension, s});
    s.room = InsertionRoom::shell;
    s.shell_radius = s.radius_max;  // a first grain may fill it
    s.radius_min = 0.1, s.exponent = 2;
    all.push_back({"tight shell", dimension, s});
  }
  return all;
}

template <int D>
void expect_exact(const InsertionScene& scene, const char* name) {
  const InsertedGrains<D> g = insert_grains<D>(scene, 5);
  SCOPED_TRACE(name + std::to_string(D));
  ASSERT_GT(g.radius.size(), 0u);
  EXPECT_TRUE(std::is_sorted(g.drawn_radius.begin(), g.drawn_radius.end(), std::greater<>()));
  double volume = 0;
  for (std::size_t k = 0; k < g.radius.size(); ++k) {
    EXPECT_GE(g.drawn_radius[k], scene.radius_min);
    EXPECT_GE(g.radius[k], g.drawn_radius[k]);
    EXPECT_LE(g.radius[k], scene.radius_max);
    const double gap = oracle::nearest_gap(g.enclosure, g.position, g.radius, k);
    EXPECT_GE(gap, -1e-14);
    EXPECT_TRUE(gap <= 1e-14 || g.radius[k] == scene.radius_max) << k;  // it touches
    EXPECT_TRUE(!g.enclosure.cell || g.enclosure.cell->wrap(g.position[k]) == g.position[k]);
    volume += ball_measure<D>(g.radius[k]);
  }
  EXPECT_NEAR(g.solid_fraction, volume / g.enclosure.measure(), 1e-14);
  const std::vector<double> slow = oracle::grow_blind(g.enclosure, g.position, g.drawn_radius, scene.radius_max);
  for (std::size_t k = 0; k < slow.size(); ++k) EXPECT_NEAR(g.radius[k], slow[k], 1e-15);
}

TEST(Insertion, GrainsTouchAndDoNotOverlap) {
  for (const Case& c : cases())
    if (c.dimension == 2)
      expect_exact<2>(c.scene, c.name);
    else
      expect_exact<3>(c.scene, c.name);
}

TEST(Insertion, IsAFunctionOfSceneAndSeed) {
  for (const Case& c : cases()) {
    if (c.dimension == 2) continue;
    const auto a = insert_grains<3>(c.scene, 9), b = insert_grains<3>(c.scene, 9),
               other = insert_grains<3>(c.scene, 10);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_NE(a.radius, other.radius);
  }
}

TEST(Insertion, ListHasBetaTimesTheVolume) {
  InsertionScene s;
  for (const double beta : {1.0, 2.5}) {
    s.volume_factor = beta;
    Random random(4);
    const std::vector<double> radii = listed_radii(s, 3, 7.0, random);
    double volume = 0;
    for (const double r : radii) volume += ball_measure<3>(r);
    EXPECT_GT(volume, beta * 7);
    EXPECT_LE(volume - ball_measure<3>(s.radius_max), beta * 7);
    EXPECT_EQ(random.counter(), radii.size());
    EXPECT_TRUE(std::is_sorted(radii.begin(), radii.end(), std::greater<>()));
  }
}

// PHYSICS.md 3: density .715, 407 +- 25 grains, exponent 3.2-3.6.
TEST(Insertion, DefaultsGiveThePackingOfThePaper) {
  double density = 0, grains = 0, exponent = 0;
  constexpr int n = 4;
  for (int seed = 1; seed <= n; ++seed) {
    const InsertionScene s;
    const InsertionReport r = insertion_report(insert_grains<3>(s, static_cast<std::uint64_t>(seed)), s);
    density += r.solid_fraction / n, grains += static_cast<double>(r.grains) / n, exponent += r.exponent.value / n;
    EXPECT_NEAR(r.exponent.value, r.fit.exponent, 4 * r.exponent.error);
    EXPECT_EQ(r.trials, 3e4);
  }
  EXPECT_NEAR(density, 0.715, 0.01);
  EXPECT_NEAR(grains, 407, 40);
  EXPECT_GT(exponent, 3.2);
  EXPECT_LT(exponent, 3.6);
}

TEST(Insertion, ReachesASolidFractionByTheLastGrain) {
  InsertionScene s;
  s.radius_min = 0.1;
  for (const double wanted : {0.45, 0.6}) {
    s.solid_fraction = wanted;
    const auto g = insert_grains<3>(s, 3);
    EXPECT_TRUE(g.reached);
    EXPECT_GE(g.solid_fraction, wanted);
    EXPECT_LT(g.solid_fraction, wanted + 0.01);
    EXPECT_EQ(insert_grains<3>(s, 3).position, g.position);
  }
  s.solid_fraction = 0.95, s.volume_factor = 1;
  const auto all = insert_grains<3>(s, 3);
  EXPECT_FALSE(all.reached);
  EXPECT_LT(all.solid_fraction, 0.95);
}

TEST(InsertionScene, EveryBrokenRuleIsTold) {
  const auto keys = [](const auto& change, int dimension = 3) {
    InsertionScene s;
    change(s);
    std::vector<std::string> found;
    for (const SceneConflict& c : insertion_conflicts(s, dimension)) found.push_back(c.key.substr(10));
    return found;
  };
  using Keys = std::vector<std::string>;
  const double nan = std::nan("");
  EXPECT_EQ(keys([](InsertionScene&) {}), Keys{});
  EXPECT_EQ(keys([](InsertionScene& s) { s.radius_min = 0; }), Keys{"radius_min"});
  EXPECT_EQ(keys([](InsertionScene& s) { s.radius_min = 0.6; }), Keys{"radius_min"});
  EXPECT_EQ(keys([](InsertionScene& s) { s.radius_min = s.radius_max; }), Keys{});
  EXPECT_EQ(keys([](InsertionScene& s) { s.shell_radius = 0.4; }), Keys{"shell_radius"});
  EXPECT_EQ(keys([&](InsertionScene& s) { s.exponent = nan; }), Keys{"exponent"});
  EXPECT_EQ(keys([](InsertionScene& s) { s.exponent = INFINITY; }), Keys{"exponent"});
  EXPECT_EQ(keys([](InsertionScene& s) { s.volume_factor = 0.99; }), Keys{"volume_factor"});
  EXPECT_EQ(keys([](InsertionScene& s) { s.trials = 0.5; }), Keys{"trials"});
  EXPECT_EQ(keys([&](InsertionScene& s) { s.trials = nan; }), Keys{"trials"});
  EXPECT_EQ(keys([](InsertionScene& s) { s.solid_fraction = 1; }), Keys{"solid_fraction"});
  EXPECT_EQ(keys([](InsertionScene& s) { s.radius_min = 1e-5; }), Keys{"radius_min"});  // a list without end
  EXPECT_EQ(keys([](InsertionScene& s) { s.radius_min = 1e-7, s.exponent = 0; }), Keys{"radius_min"});
  const auto flat = [](InsertionScene& s) { s.room = InsertionRoom::box, s.box = {2, 2, 0.5}; };
  EXPECT_EQ(keys(flat, 3), Keys{"box_3"});
  EXPECT_EQ(keys(flat, 2), Keys{});
  EXPECT_EQ(keys([&](InsertionScene& s) { s.radius_min = -1, s.exponent = nan, s.trials = 0, s.shell_radius = nan; }),
            (Keys{"radius_min", "exponent", "trials", "shell_radius"}));
  InsertionScene bad;
  bad.radius_min = 0, bad.trials = 0;
  try {
    insert_grains<2>(bad, 1);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.faults().size(), 2u);
  }
}

TEST(InsertionScene, RadiiOutsideTheLawAreTold) {
  EXPECT_EQ(radius_conflicts({0.1, 0.5, 0.05}, 0.05, 0.5).size(), 0u);
  const auto found = radius_conflicts({0.1, 0.6, std::nan(""), 0.01}, 0.05, 0.5);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].key, "radius 2");
}

}  // namespace
}  // namespace isostat
