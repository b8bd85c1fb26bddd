// Trees, loops and clusters of links: against cutting links one by one, and exact ranks without them.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/network/loops.hpp"
#include "analysis/network/stressed_clusters.hpp"
#include "analysis/report.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/stiffness/bases.hpp"
#include "analysis/stiffness/link_classes.hpp"
#include "dem/files/network_file.hpp"
#include "tests/oracle/network_oracle.hpp"
#include "tests/support/random_network.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

// Parts of the network, all held bodies in one.
std::int64_t components(const Packing<2>& p) {
  const std::size_t n = p.bodies.size();
  std::vector<std::size_t> label(n);
  for (std::size_t k = 0; k < n; ++k) label[k] = is_free(p.part, k) ? k : n;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Link<2>& l : p.links) {
      auto &a = label[static_cast<std::size_t>(l.i)], &b = label[static_cast<std::size_t>(l.j)];
      if (a == b) continue;
      const std::size_t from = std::max(a, b), to = std::min(a, b);
      for (std::size_t& x : label)
        if (x == from) x = to;
      changed = true;
    }
  }
  return std::ssize(std::set(label.begin(), label.end()));
}

TEST(Loops, ALinkIsOnOneIfCuttingItLeavesTheNetworkWhole) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Packing<2> p = oracle::random_packing(seed, 20, 12 + seed / 2, seed % 2 == 0);
    if (seed % 5 == 0) {  // some are walls
      p.part.assign(20, GrainPart::free);
      p.part[18] = p.part[19] = GrainPart::wall;
    }
    const LoopCount count = count_loops(p);
    const std::int64_t parts = components(p);
    std::int64_t nodes = 20;
    if (!p.part.empty()) nodes = 19;
    EXPECT_EQ(count.components, parts) << "seed " << seed;
    EXPECT_EQ(count.independent, std::ssize(p.links) - nodes + parts);
    for (std::size_t l = 0; l < p.links.size(); ++l) {
      Packing<2> cut = p;
      cut.links.erase(cut.links.begin() + static_cast<std::ptrdiff_t>(l));
      EXPECT_EQ(count.on_loop[l] == 0, components(cut) > parts) << "seed " << seed << " link " << l;
    }
  }
}

// A self-stress passes through a link if and only if the network without it has one less.
TEST(LinkClasses, ClustersAreWhatExactRanksSay) {
  int clusters = 0, loops = 0, trees = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    RandomNetwork o;
    o.columns = o.rows = 5, o.seed = seed, o.coordination = 2.4 + 0.12 * static_cast<double>(seed),
    o.periodic = seed % 2 == 0;
    const Packing<2> p = random_network(o);
    const auto classes = link_classes(p, NetworkLaw::rolling, false);
    const std::int64_t h = exact_rank(p, NetworkLaw::friction, false).hyperstatic;
    const LoopCount count = count_loops(p);
    // Each loop leaves three forces undetermined (what Sec. IV.B.4 counts as two); a part that winds around the cell
    // cannot turn, and has one less.
    Packing<2> loaded = p;
    for (Link<2>& l : loaded.links) l.normal_force = 1;
    std::int64_t winding = 0;
    for (const auto& c : stressed_clusters(loaded, ForceMeasure::total, 0.5).clusters) winding += c.any_span();
    EXPECT_EQ(exact_rank(p, NetworkLaw::rolling, false).hyperstatic, 3 * count.independent - winding)
        << "seed " << seed;
    for (std::size_t l = 0; l < p.links.size(); ++l) {
      Packing<2> cut = p;
      cut.links.erase(cut.links.begin() + static_cast<std::ptrdiff_t>(l));
      const bool bears = exact_rank(cut, NetworkLaw::friction, false).hyperstatic < h;
      EXPECT_EQ(classes[l] == LinkClass::cluster, bears) << "seed " << seed << " link " << l;
      EXPECT_EQ(classes[l] == LinkClass::tree, count.on_loop[l] == 0);
      ++(classes[l] == LinkClass::cluster ? clusters : classes[l] == LinkClass::loop ? loops : trees);
    }
  }
  EXPECT_GT(clusters, 50);
  EXPECT_GT(loops, 50);
  EXPECT_GT(trees, 20);
}

// A ring of six with a self-stress by moments, a double triangle with one by forces, a tail.
TEST(LoopsSection, ClassesOfCanonicalClusters) {
  AnalysisInput input;
  input.path = "test";
  input.links_given = true;
  Packing<2>& p = input.state.packing;
  p = read_network<2>(ISOSTAT_DATA "/clusters/ring6.net").packing;
  const auto ring = self_stress_states(p, NetworkLaw::rolling, false, 10);
  ASSERT_EQ(ring.size(), 3u);
  for (std::size_t l = 0; l < 6; ++l)
    p.links[l].normal_force = ring[0].value[3 * l], p.links[l].tangential_force = ring[0].value[3 * l + 1],
    p.links[l].moment = ring[0].value[3 * l + 2];
  const double in_ring = std::hypot(p.links[0].normal_force, p.links[0].tangential_force);
  for (const Link<2>& l : p.links)  // one constant force goes around, Sec. IV.B.4
    EXPECT_NEAR(std::hypot(l.normal_force, l.tangential_force), in_ring, 1e-12);
  Link<2> tail;
  tail.i = 0, tail.j = 6;
  p.bodies.resize(7);
  p.bodies.id[6] = 600, p.bodies.radius[6] = 0.5;
  p.bodies.position[6] = 2.0 * p.bodies.position[0] - p.bodies.position[3];
  p.links.push_back(tail);
  AnalysisOptions options;
  options.law = NetworkLaw::rolling;
  const Json json = analyze(input, options, {"loops"})["loops"];
  EXPECT_EQ(json["independent"], 1);
  EXPECT_EQ(json["components"], 1);
  EXPECT_EQ(json["loops"]["links"], 6);
  EXPECT_EQ(json["trees"]["links"], 1);
  EXPECT_EQ(json["clusters"]["links"], 0);
  EXPECT_NEAR(json["loops"]["mean"].get<double>(), in_ring, 1e-12);
  EXPECT_NEAR(json["loops"]["rms"].get<double>(), in_ring, 1e-12);
  EXPECT_EQ(json["trees"]["largest"], 0.0);
  EXPECT_TRUE(json["scale"].is_null());

  // With a law: forces against mu_r F0/a, moments against mu_r N_e.
  input.state.law.normal_stiffness = 1e3, input.state.law.friction = 0.5, input.state.law.attraction = 1;
  input.state.law.rolling_friction = 0.01, input.state.law.rolling_stiffness = 1;
  for (Link<2>& l : p.links) l.gap = -2e-3;
  const Json known = analyze(input, {}, {"loops"})["loops"];
  EXPECT_DOUBLE_EQ(known["scale"], 0.01);
  EXPECT_NEAR(known["loops"]["mean_over_scale"].get<double>(), 100 * in_ring, 1e-9);
  double moments = 0;
  for (std::size_t l = 0; l < 6; ++l) moments += std::abs(p.links[l].moment) / (0.01 * 2) / 6;
  EXPECT_NEAR(known["loops"]["mean_mobilisation"].get<double>(), moments, 1e-12);

  input = AnalysisInput();
  input.path = "test", input.links_given = true;
  input.state.packing = read_network<2>(ISOSTAT_DATA "/clusters/double_triangle.net").packing;
  const Json two = analyze(input, options, {"loops"})["loops"];  // no forces: only numbers of links
  EXPECT_EQ(two["clusters"]["links"], 5);
  EXPECT_EQ(two["loops"]["links"], 0);
  EXPECT_TRUE(two["clusters"]["mean"].is_null());
  EXPECT_TRUE(two["histograms"].empty());
}

}  // namespace
}  // namespace isostat
