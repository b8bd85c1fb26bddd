// Networks with beams: counts against rational elimination, clusters, bases, coordination.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "analysis/network/coordination.hpp"
#include "analysis/rigidity/clusters.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/rigid_bodies.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/stiffness/bases.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "dem/files/network_file.hpp"
#include "dem/state/beam.hpp"
#include "dem/state/link_ends.hpp"
#include "tests/oracle/rational_rank.hpp"
#include "tests/support/random_network.hpp"

namespace isostat {
namespace {

constexpr NetworkLaw kLaws[] = {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling};

Packing<2> network(const std::string& text) { return parse_network<2>(text, "beams.net").packing; }

void make_beam(Packing<2>& p, Link<2>& link) {
  link.kind = LinkKind::beam, link.beam = static_cast<std::int32_t>(p.beams.size());
  p.beams.push_back(
      beam_at_rest(norm(branch(p, static_cast<std::size_t>(link.i), static_cast<std::size_t>(link.j), link.shift))));
  link.gap = 0;
}

// Small lattices, isolated and periodic, crystals and jittered; a part of the links are beams, the others contacts of
// all kinds; some pairs have both, some bodies a beam to their own image.
Packing<2> trial_network(int trial) {
  std::mt19937_64 random(static_cast<std::uint64_t>(trial) + 7);
  std::uniform_real_distribution<> unit(0.0, 1.0);
  RandomNetwork o;
  o.columns = 1 + trial % 4, o.rows = 2 + trial % 3;
  o.seed = static_cast<std::uint64_t>(trial);
  o.periodic = trial % 2 == 0;
  o.coordination = 1 + 4 * unit(random);
  o.jitter = trial % 5 < 2 ? 0.0 : 0.3;
  if (trial % 3 != 0) o.distant = o.sliding = o.rolling_yielded = o.both_yielded = 0.1;
  Packing<2> p = random_network(o);
  const auto shorten = [](double x) { return std::ldexp(std::round(std::ldexp(x, 8)), -8); };  // for the fractions
  for (Vec2& r : p.bodies.position) r = {{shorten(r[0]), shorten(r[1])}};
  for (double& r : p.bodies.radius) r = trial % 7 == 0 ? 0.5 : shorten(r);
  if (p.cell) p.cell->length = {{shorten(p.cell->length[0]), shorten(p.cell->length[1])}};
  const double beams = trial % 6 == 0 ? 1.0 : unit(random);
  const std::size_t links = p.links.size();
  for (std::size_t l = 0; l < links; ++l) {
    if (unit(random) > beams) continue;
    Link<2> link = p.links[l];
    make_beam(p, link);
    if (unit(random) < 0.15)
      p.links.push_back(link);  // beside the contact
    else
      p.links[l] = link;
  }
  return p;
}

TEST(BeamNetworks, RankEqualsRationalElimination) {
  int compared = 0, hyperstatic = 0, mixed = 0, images = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const Packing<2> p = trial_network(trial);
    for (const NetworkLaw law : kLaws)
      for (const bool cell_free : {false, true}) {
        if (cell_free && !p.cell) continue;
        const ExactRank r = exact_rank(p, law, cell_free);
        ASSERT_EQ(r.rank, rational_rank(p, law, cell_free)) << "trial " << trial << " law " << static_cast<int>(law);
        EXPECT_EQ(r.hyperstatic - r.floppy, r.rows - r.dofs);
        EXPECT_TRUE(r.certified);
        EXPECT_LE(r.floppy_generic, r.floppy);
        EXPECT_GE(r.mechanisms, 0);
        ++compared, hyperstatic += r.hyperstatic > 0;
        mixed += !p.beams.empty() && p.beams.size() < p.links.size();
      }
    for (const Link<2>& l : p.links) images += l.kind == LinkKind::beam && l.i == l.j;
  }
  EXPECT_GT(compared, 2500);  // the trials must have met what they are for
  EXPECT_GT(hyperstatic, 800);
  EXPECT_GT(mixed, 1500);
  EXPECT_GT(images, 20);
}

// Rings and chains of beams, isolated: H = 3 a loop; and all of one piece.
TEST(BeamNetworks, EachLoopIsThreeTimesHyperstatic) {
  std::mt19937_64 random(11);
  std::normal_distribution<> normal;
  for (int bodies = 2; bodies < 12; ++bodies)
    for (const bool ring : {false, true}) {
      if (ring && bodies < 3) continue;
      std::string text;
      for (int k = 0; k < bodies; ++k)
        text += "grain " + std::to_string(k) + " " + std::to_string(10 * normal(random)) + " " +
                std::to_string(10 * normal(random)) + " .001\n";
      for (int k = 0; k + 1 < bodies + (ring ? 1 : 0); ++k)
        text += "beam " + std::to_string(k) + " " + std::to_string((k + 1) % bodies) + "\n";
      const Packing<2> p = network(text);
      for (const NetworkLaw law : kLaws) {
        const ExactRank r = exact_rank(p, law, false);
        EXPECT_EQ(r.floppy, 3);
        EXPECT_EQ(r.hyperstatic, ring ? 3 : 0);
        EXPECT_EQ(r.bodies, 1);
        const RigidClusters c = rigid_clusters(p, law, false);
        ASSERT_EQ(c.clusters.size(), 1u);
        EXPECT_EQ(c.clusters[0].grains, bodies);
        EXPECT_EQ(c.clusters[0].hyperstatic, ring ? 3 : 0);
      }
    }
}

// Doubles beside the exact numbers: null vectors and self-stress states of mixed networks.
TEST(BeamNetworks, BasesAreNullAndComplete) {
  int states = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Packing<2> p = trial_network(trial);
    for (const NetworkLaw law : kLaws) {
      const ExactRank r = exact_rank(p, law, p.cell.has_value());
      const auto modes = floppy_modes(p, law, p.cell.has_value(), 100);
      const auto stresses = self_stress_states(p, law, p.cell.has_value(), 100);
      EXPECT_EQ(static_cast<std::int64_t>(modes.size()), r.floppy);
      EXPECT_EQ(static_cast<std::int64_t>(stresses.size()), r.hyperstatic);
      for (const auto* list : {&modes, &stresses})
        for (const NullVector& v : *list) EXPECT_LT(v.residual, 1e-8);
      states += static_cast<int>(stresses.size());
    }
  }
  EXPECT_GT(states, 200);
}

// Two bars that touch: without friction each is a cluster and the contact a third, by the rule that links at a grain
// that turn alike are one body; with friction they are two bodies on a hinge; with rolling resistance one.
TEST(BeamNetworks, ClustersOfTwoBars) {
  const Packing<2> p = read_network<2>(ISOSTAT_DATA "/clusters/beam_bars.net").packing;
  const RigidClusters points = rigid_clusters(p, NetworkLaw::frictionless, false);
  ASSERT_EQ(points.clusters.size(), 3u);
  for (const RigidCluster& c : points.clusters) EXPECT_EQ(c.grains, 2);
  const RigidClusters hinged = rigid_clusters(p, NetworkLaw::friction, false);
  ASSERT_EQ(hinged.clusters.size(), 2u);
  EXPECT_EQ(hinged.cluster_of_link, (std::vector<std::int32_t>{0, 1, -1}));
  const RigidClusters stuck = rigid_clusters(p, NetworkLaw::rolling, false);
  ASSERT_EQ(stuck.clusters.size(), 1u);
  EXPECT_EQ(stuck.clusters[0].grains, 4);
  EXPECT_EQ(stuck.clusters[0].hyperstatic, 0);
}

// A frictionless grain that touches both ends of a beam sits fast and belongs to their cluster; its spin stays free.
TEST(BeamNetworks, AGrainOnTwoContactsJoinsThePiece) {
  const Packing<2> p = network(
      "grain 0 0 0 .5\ngrain 1 1.25 0 .5\ngrain 2 .625 .75 .5\ngrain 3 3 0 .5\nbeam 0 1\ncontact 0 2 c\ncontact 1 2 "
      "c\n");
  const RigidClusters c = rigid_clusters(p, NetworkLaw::frictionless, false);
  ASSERT_EQ(c.clusters.size(), 1u);
  EXPECT_EQ(c.clusters[0].grains, 3);
  EXPECT_EQ(exact_rank(p, NetworkLaw::frictionless, false).mechanisms, 1);  // the spin of the free grain 2
}

TEST(BeamNetworks, BeamsAreNoContactsAndHoldTheirGrains) {
  const Packing<2> p =
      network("grain 0 0 0 .5\ngrain 1 1 0 .5\ngrain 2 2 0 .5\ngrain 3 5 0 .5\nbeam 0 1\ncontact 1 2 c\n");
  Coordination c = coordination(p, ForceReading{});
  EXPECT_EQ(c.contacts, 1);
  EXPECT_EQ(c.beams, 1);
  EXPECT_EQ(c.degree, (std::vector<int>{0, 1, 1, 0}));
  EXPECT_EQ(c.rattler, (std::vector<char>{0, 0, 0, 1}));
  ForceReading loaded;  // cohesionless, and nothing pushes
  loaded.known = true, loaded.cohesive = false, loaded.threshold = 1;
  c = coordination(p, loaded);
  EXPECT_EQ(c.rattler, (std::vector<char>{0, 0, 1, 1}));
  EXPECT_EQ(c.rattlers, 2);
}

// A pair at rest length: stretching E (1/m1 + 1/m2), and the antisymmetric bending of PHYSICS 2.
TEST(BeamNetworks, ModesOfAPair) {
  const Packing<2> p = network("grain 0 0 0 .5\ngrain 1 3 0 .5\nbeam 0 1\n");  // m = 1, I = 1/8
  const double length = 3, inertia = 0.125, bend = 10 / length;
  const VibrationModes modes = vibration_modes(p, NetworkLaw::frictionless, default_network_law(), 20, false);
  EXPECT_EQ(modes.zero_modes, 3);
  ASSERT_EQ(modes.omega.size(), 3u);
  // M alone: spins opposed. T: both spins w, centres +-L w/2 less the chord's turn; reduced mass of the sideways
  // motion.
  EXPECT_NEAR(modes.omega[0], std::sqrt(2 * bend / inertia), 1e-6 * modes.omega[0]);
  EXPECT_NEAR(modes.omega[1], std::sqrt(12 * bend / (length * length) * (2 + length * length / (2 * inertia))),
              1e-6 * modes.omega[1]);
  EXPECT_NEAR(modes.omega[2], std::sqrt(2 * 1e5), 1e-6 * modes.omega[2]);
}

}  // namespace
}  // namespace isostat
