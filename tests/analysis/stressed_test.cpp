// Clusters of stressed links: against floods over tiled copies of the cell, closed forms of self-stressed clusters, and
// an outside that a flood of a pixel map finds.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <set>

#include "analysis/network/link_places.hpp"
#include "analysis/network/sections.hpp"
#include "analysis/network/stressed_clusters.hpp"
#include "analysis/report.hpp"
#include "analysis/stiffness/bases.hpp"
#include "dem/files/network_file.hpp"
#include "tests/oracle/network_oracle.hpp"
#include "tests/support/random_network.hpp"
#include "tests/support/refusal.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

AnalysisInput foreign(Packing<2> packing) {
  AnalysisInput input;
  input.path = "test";
  input.state.packing = std::move(packing);
  input.links_given = true;
  return input;
}

// The one self-stress of the double triangle, 1 in the outer contacts: they pull, the shared one pushes with 4.
Packing<2> double_triangle() {
  Packing<2> p = read_network<2>(ISOSTAT_DATA "/clusters/double_triangle.net").packing;
  const auto f = self_stress_states(p, NetworkLaw::friction, false, 1).at(0).value;
  for (std::size_t l = 0; l < 5; ++l)
    p.links[l].normal_force = 4 * f[2 * l] / f[0], p.links[l].tangential_force = 4 * f[2 * l + 1] / f[0];
  return p;
}

// Grains that a flood along links >= threshold reaches from `start`, whatever their image.
std::set<std::int32_t> flood(const Packing<2>& p, double threshold, std::int32_t start) {
  std::set<std::int32_t> seen{start};
  for (bool grown = true; grown;) {
    grown = false;
    for (const Link<2>& l : p.links) {
      if (std::hypot(l.normal_force, l.tangential_force) < threshold || seen.contains(l.i) == seen.contains(l.j))
        continue;
      seen.insert(l.i), seen.insert(l.j), grown = true;
    }
  }
  return seen;
}

TEST(StressedClusters, AreThoseOfAFloodAndSpanWhereTiledCopiesDo) {
  int spanning = 0, finite = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Packing<2> p = oracle::random_packing(seed, 24, 8 + seed / 2, true);
    const double threshold = 0.4;
    const auto found = stressed_clusters(p, ForceMeasure::total, threshold);
    std::int64_t links = 0;
    std::set<std::int32_t> in_clusters;
    for (const auto& c : found.clusters) {
      links += std::ssize(c.links);
      in_clusters.insert(c.grains.begin(), c.grains.end());
      EXPECT_EQ(flood(p, threshold, c.grains[0]), std::set(c.grains.begin(), c.grains.end())) << "seed " << seed;
      Packing<2> alone = p;
      alone.links.clear();
      for (const std::int32_t l : c.links) alone.links.push_back(p.links[static_cast<std::size_t>(l)]);
      EXPECT_EQ(oracle::percolates(alone, threshold, 6), c.spans) << "seed " << seed;
      ++(c.any_span() ? spanning : finite);
    }
    std::int64_t above = 0;
    for (const Link<2>& l : p.links) above += std::hypot(l.normal_force, l.tangential_force) >= threshold;
    EXPECT_EQ(links, above);
    const auto counts = count_clusters_above(p, ForceMeasure::total, threshold);
    EXPECT_EQ(counts.clusters, std::ssize(found.clusters));
    EXPECT_EQ(counts.links, above);
    EXPECT_EQ(counts.largest, found.clusters.empty() ? 0 : std::ssize(found.clusters[0].grains));
    double sum = 0, squares = 0;
    for (const auto& c : found.clusters) {
      const auto n = static_cast<double>(c.grains.size());
      sum += n, squares += n * n;
    }
    EXPECT_EQ(static_cast<double>(in_clusters.size()), sum);
    if (sum > 0) {
      EXPECT_DOUBLE_EQ(counts.mean_size, sum / static_cast<double>(found.clusters.size()));
      EXPECT_DOUBLE_EQ(counts.mean_size_weighted, squares / sum);
    }
  }
  EXPECT_GT(spanning, 20);
  EXPECT_GT(finite, 50);
}

TEST(StressedClusters, TheThresholdMayBeOfTheNormalForce) {
  Packing<2> p = double_triangle();
  p.links[3].normal_force = 1e-6;  // T = sqrt(3) stays
  EXPECT_EQ(stressed_clusters(p, ForceMeasure::total, 0.5).clusters.at(0).links.size(), 5u);
  EXPECT_EQ(stressed_clusters(p, ForceMeasure::normal, 0.5).clusters.at(0).links.size(), 4u);
}

// Fig. 18: peripheral tension compensates radial compression.
TEST(StressedSection, OfTheDoubleTriangleIsCompensatedRimAgainstInside) {
  const Packing<2> p = double_triangle();
  ASSERT_NEAR(p.links[0].normal_force, 4, 1e-12);
  AnalysisOptions options;
  options.threshold = 0.1;
  const Json json = stressed_section(foreign(p), options);
  EXPECT_EQ(json["count"], 1);
  EXPECT_EQ(json["largest"], 4);
  EXPECT_EQ(json["links"], 5);
  EXPECT_EQ(json["spanning"], 0);
  const Json& c = json["compensation"];
  EXPECT_NEAR(c["value"].get<double>(), 1, 1e-12);
  EXPECT_EQ(c["tensile_rim"], 1);
  EXPECT_EQ(c["rim"]["links"], 4);
  EXPECT_EQ(c["inside"]["links"], 1);
  EXPECT_DOUBLE_EQ(c["rim"]["tensile_share"], 1);
  EXPECT_DOUBLE_EQ(c["inside"]["tensile_share"], 0);
  const double area = std::numbers::pi;  // of four disks of radius 1/2; sum N r = 4 over the rim
  EXPECT_NEAR(c["rim"]["pressure"].get<double>(), -4 / (2 * area), 1e-12);
  EXPECT_NEAR(c["inside"]["pressure"].get<double>(), 4 / (2 * area), 1e-12);
  EXPECT_NEAR(json["list"][0]["pressure"].get<double>(), 0, 1e-12);
  for (int a : {0, 1})
    for (int b : {0, 1}) EXPECT_NEAR(json["list"][0]["stress"][a][b].get<double>(), 0, 1e-12);
  EXPECT_EQ(json["list"][0]["loops"], 2);
  // Five values that sum to 0 in one cluster do so in any order.
  EXPECT_NEAR(c["if_shuffled"].get<double>(), 1, 1e-12);
}

// Two clusters, one pulls and one pushes: nothing is compensated, and shuffling would compensate much.
TEST(StressedSection, ShufflingShowsWhatIsLocal) {
  Packing<2> p = double_triangle();
  const std::size_t n = p.bodies.size(), m = p.links.size();
  const Packing<2> one = p;
  p.bodies.resize(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    p.bodies.id[n + k] = static_cast<std::int64_t>(n + k), p.bodies.radius[n + k] = 0.5;
    p.bodies.position[n + k] = one.bodies.position[k] + Vec2{{10, 0}};
  }
  for (Link<2> l : one.links) {
    l.i += static_cast<std::int32_t>(n), l.j += static_cast<std::int32_t>(n);
    p.links.push_back(l);
  }
  const auto with = [&](double first, double second) {
    for (std::size_t l = 0; l < 2 * m; ++l)
      p.links[l].normal_force = l < m ? first : second, p.links[l].tangential_force = 0;
    return stressed_section(foreign(p), {})["compensation"];
  };
  const Json apart = with(1, -1);
  EXPECT_NEAR(apart["value"].get<double>(), 0, 1e-12);
  EXPECT_GT(apart["if_shuffled"].get<double>(), 0.6);  // mean of |5 - 2 k| over hypergeometric k: 1 - 1.59 / 5 = .683
  EXPECT_LT(apart["if_shuffled"].get<double>(), 0.75);
  EXPECT_GT(apart["if_shuffled_sd"].get<double>(), 0.1);
}

TEST(StressedSection, PartsOfTheStressAddUp) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    RandomNetwork o;
    o.columns = o.rows = 12, o.seed = seed, o.coordination = 3;
    Packing<2> p = random_network(o);
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> force(-1, 1);
    for (Link<2>& l : p.links) l.normal_force = force(engine), l.tangential_force = force(engine);
    AnalysisOptions options;
    options.threshold = 0.8;
    const Json json = stressed_section(foreign(p), options);
    int placed = 0;
    for (const Json& c : json["list"]) {
      EXPECT_NEAR(c["pressure"].get<double>(),
                  0.5 * (c["stress"][0][0].get<double>() + c["stress"][1][1].get<double>()), 1e-12);
      if (c["spans"] != "" || std::isnan(c["rim_pressure"].get<double>())) continue;
      ++placed;
      EXPECT_NEAR(
          c["pressure"].get<double>(),
          c["rim_pressure"].get<double>() + c["inside_pressure"].get<double>() + c["bridge_pressure"].get<double>(),
          1e-12);
    }
    EXPECT_GT(placed, 3) << "seed " << seed;
  }
}

// A pixel map of the cluster's links; what a flood from the corner reaches is outside.
class PixelOutside {
 public:
  explicit PixelOutside(const Packing<2>& p) {
    Vec2 low{{1e9, 1e9}}, high{{-1e9, -1e9}};
    for (const Vec2& x : p.bodies.position)
      for (int k : {0, 1}) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
    origin_ = low - Vec2{{0.5, 0.5}};
    nx_ = static_cast<int>((high[0] - low[0] + 1) / kStep), ny_ = static_cast<int>((high[1] - low[1] + 1) / kStep);
    map_.assign(static_cast<std::size_t>(nx_ * ny_), 0);
    for (const Link<2>& l : p.links) {
      const Vec2 a = p.bodies.position[static_cast<std::size_t>(l.i)],
                 b = p.bodies.position[static_cast<std::size_t>(l.j)];
      for (double t = 0; t <= 1; t += 0.2 * kStep)
        for (const Vec2& off : {Vec2{}, Vec2{{kStep, 0}}, Vec2{{0, kStep}}}) at(a + t * (b - a) + off) = 1;
    }
    std::vector<std::pair<int, int>> front{{0, 0}};
    map_[0] = 2;
    while (!front.empty()) {
      const auto [x, y] = front.back();
      front.pop_back();
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const int u = x + dx, v = y + dy;
        if (u < 0 || v < 0 || u >= nx_ || v >= ny_ || map_[static_cast<std::size_t>(v * nx_ + u)] != 0) continue;
        map_[static_cast<std::size_t>(v * nx_ + u)] = 2;
        front.emplace_back(u, v);
      }
    }
  }
  bool is_outside(const Vec2& x) { return at(x) == 2; }

 private:
  static constexpr double kStep = 0.01;
  char& at(const Vec2& x) {
    const auto u = static_cast<int>((x[0] - origin_[0]) / kStep), v = static_cast<int>((x[1] - origin_[1]) / kStep);
    return map_[static_cast<std::size_t>(v * nx_ + u)];
  }
  Vec2 origin_{};
  int nx_ = 0, ny_ = 0;
  std::vector<char> map_;
};

bool cuts(const Packing<2>& p, const std::vector<std::int32_t>& links, std::size_t without) {
  Packing<2> rest = p;
  rest.links.clear();
  for (std::size_t k = 0; k < links.size(); ++k) {
    rest.links.push_back(p.links[static_cast<std::size_t>(links[k])]);
    rest.links.back().normal_force = k == without ? 0 : 1;
    rest.links.back().tangential_force = 0;
  }
  return !flood(rest, 0.5, rest.links[without].i).contains(rest.links[without].j);
}

TEST(LinkPlaces, AreThoseOfAFloodOfPixels) {
  int rim = 0, inside = 0, bridges = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    RandomNetwork o;
    o.columns = 7, o.rows = 6, o.seed = seed, o.coordination = 2.6 + 0.15 * static_cast<double>(seed);
    o.periodic = false, o.jitter = 0.1;
    Packing<2> p = random_network(o);
    for (Link<2>& l : p.links) l.normal_force = 1;
    const auto found = stressed_clusters(p, ForceMeasure::total, 0.5);
    for (const auto& c : found.clusters) {
      ASSERT_TRUE(c.has_places) << "seed " << seed;
      Packing<2> alone = p;
      alone.links.clear();
      for (const std::int32_t l : c.links) alone.links.push_back(p.links[static_cast<std::size_t>(l)]);
      PixelOutside outside(alone);
      for (std::size_t k = 0; k < c.links.size(); ++k) {
        const Link<2>& l = alone.links[k];
        const Vec2 a = p.bodies.position[static_cast<std::size_t>(l.i)],
                   r = p.bodies.position[static_cast<std::size_t>(l.j)] - a, n = Vec2{{-r[1], r[0]}} / norm(r);
        const int sides = outside.is_outside(a + 0.5 * r + 0.05 * n) + outside.is_outside(a + 0.5 * r - 0.05 * n);
        const LinkPlace place = found.place[static_cast<std::size_t>(c.links[k])];
        const bool bridge = cuts(p, c.links, k);
        EXPECT_EQ(place == LinkPlace::bridge, bridge) << "seed " << seed;
        if (!bridge) {
          EXPECT_EQ(place == LinkPlace::rim, sides == 1) << "seed " << seed << " link " << k;
          EXPECT_NE(sides, 2);
        }
        ++(bridge ? bridges : place == LinkPlace::rim ? rim : inside);
      }
    }
  }
  EXPECT_GT(rim, 100);
  EXPECT_GT(inside, 100);
  EXPECT_GT(bridges, 30);
}

TEST(LinkPlaces, CrossingLinksHaveNone) {
  Packing<2> p = read_network<2>(ISOSTAT_DATA "/clusters/ring4_square.net").packing;  // a square and both diagonals
  Link<2> diagonal = p.links[0];
  diagonal.i = 0, diagonal.j = 2, p.links.push_back(diagonal);
  diagonal.i = 1, diagonal.j = 3, p.links.push_back(diagonal);
  std::vector<std::int32_t> all;
  for (std::size_t l = 0; l < p.links.size(); ++l) all.push_back(static_cast<std::int32_t>(l));
  EXPECT_FALSE(link_places(p, all).has_value());
  all.pop_back();
  EXPECT_TRUE(link_places(p, all).has_value());
}

TEST(StressedSection, InSpaceHasNoRim) {
  AnalysisInput input;
  input.path = "test";
  input.packing_3d.emplace();
  Packing<3>& p = *input.packing_3d;
  p.bodies.resize(3);
  p.bodies.position = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 0, 2}}};
  p.bodies.radius = {0.5, 0.5, 0.5};
  Link<3> l;
  l.i = 0, l.j = 1, l.normal_force = 2;
  p.links = {l};
  const Json json = analyze(input, {}, {"stressed"})["stressed"];
  EXPECT_EQ(json["count"], 1);
  EXPECT_EQ(json["grains"], 2);
  EXPECT_FALSE(json["compensation"].contains("rim"));
  EXPECT_NEAR(json["list"][0]["pressure"].get<double>(), 2 / (3 * std::numbers::pi / 3), 1e-12);
  EXPECT_NEAR(json["compensation"]["value"].get<double>(), 0, 1e-12);
}

TEST(StressedSection, NeedsForces) {
  EXPECT_EQ(oracle::refusal(foreign(read_network<2>(ISOSTAT_DATA "/clusters/k23.net").packing), "stressed"),
            "needs forces: this input has none");
}

}  // namespace
}  // namespace isostat
