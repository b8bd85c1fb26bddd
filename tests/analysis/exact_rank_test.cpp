#include "analysis/rigidity/exact_rank.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "analysis/rigidity/rigid_bodies.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "dem/files/network_file.hpp"
#include "dem/input_error.hpp"
#include "tests/oracle/rational_rank.hpp"
#include "tests/support/random_network.hpp"

namespace isostat {
namespace {

// data/clusters/expected.tsv: exact integers, checked by independent rational arithmetic.
TEST(ExactRank, CanonicalClusters) {
  std::ifstream table(ISOSTAT_DATA "/clusters/expected.tsv");
  ASSERT_TRUE(table);
  std::string line;
  std::getline(table, line);
  int cases = 0;
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    std::string name, law_name, strain, k3n;
    std::int64_t n, nc, nd, dofs, rows, rank, floppy, hyperstatic;
    fields >> name >> law_name >> strain >> n >> nc >> nd >> dofs >> rows >> rank >> floppy >> hyperstatic >> k3n;
    const NetworkLaw law = law_name == "frictionless" ? NetworkLaw::frictionless
                           : law_name == "friction"   ? NetworkLaw::friction
                                                      : NetworkLaw::rolling;
    const auto file = read_network<2>(ISOSTAT_DATA "/clusters/" + name + ".net");
    const ExactRank r = exact_rank(file.packing, law, strain == "2");
    SCOPED_TRACE(line);
    EXPECT_EQ(r.dofs, dofs);
    EXPECT_EQ(r.rows, rows);
    EXPECT_EQ(r.rank, rank);
    EXPECT_EQ(r.floppy, floppy);
    EXPECT_EQ(r.hyperstatic, hyperstatic);
    EXPECT_TRUE(r.certified);
    EXPECT_LE(r.floppy_generic, r.floppy);
    EXPECT_GE(r.mechanisms, 0);
    if (k3n != "-") {
      EXPECT_EQ(r.floppy + n, std::stoll(k3n));
    }
    ++cases;
  }
  EXPECT_EQ(cases, 84);
}

constexpr NetworkLaw kLaws[] = {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling};

// A random network that runs through isolated and periodic, crystals and jittered, all kinds of links.
Packing<2> trial_network(int trial, int columns, int rows) {
  std::mt19937_64 random(static_cast<std::uint64_t>(trial) + 100);
  RandomNetwork o;
  o.columns = columns, o.rows = rows;
  o.seed = static_cast<std::uint64_t>(trial);
  o.periodic = trial % 2 == 0;
  o.coordination = std::uniform_real_distribution<>(1.5, 5.5)(random);
  o.jitter = trial % 5 < 2 ? 0.0 : 0.3;
  if (trial % 3 != 0) o.distant = o.sliding = o.rolling_yielded = o.both_yielded = 0.08;
  Packing<2> p = random_network(o);
  // Short mantissas keep the fractions of the oracle small.
  const auto shorten = [](double x) { return std::ldexp(std::round(std::ldexp(x, 10)), -10); };
  for (Vec2& r : p.bodies.position) r = {{shorten(r[0]), shorten(r[1])}};
  for (double& r : p.bodies.radius) r = trial % 7 == 0 ? 0.5 : shorten(r);
  if (p.cell) p.cell->length = {{shorten(p.cell->length[0]), shorten(p.cell->length[1])}};
  return p;
}

TEST(ExactRank, EqualsRationalElimination) {
  int gears = 0, special = 0;
  for (int trial = 0; trial < 240; ++trial) {
    const Packing<2> p = trial_network(trial, 2 + trial % 4, 2 + trial % 3);
    for (const NetworkLaw law : kLaws)
      for (const bool cell_free : {false, true}) {
        if (cell_free && !p.cell) continue;
        const ExactRank r = exact_rank(p, law, cell_free);
        ASSERT_EQ(r.rank, rational_rank(p, law, cell_free)) << "trial " << trial << " law " << static_cast<int>(law);
        EXPECT_TRUE(r.certified);
        EXPECT_LE(r.floppy_generic, r.floppy);
        EXPECT_GE(r.mechanisms, 0);
        gears += r.gear_modes > 0, special += !r.bounds_meet;
      }
  }
  // The trials must have met what they are for.
  EXPECT_GT(gears, 5);
  EXPECT_GT(special, 20);
}

TEST(ExactRank, EqualsDenseSingularValues) {
  int undecided = 0, compared = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Packing<2> p = trial_network(trial, 5 + trial % 4, 6);
    for (const NetworkLaw law : kLaws) {
      const bool cell_free = p.cell && trial % 4 == 0;
      const RigidityMatrix g = rigidity_matrix(p, law, cell_free);
      Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(g.rows(), g.columns());
      for (Eigen::Index r = 0; r < g.rows(); ++r)
        for (auto e = g.row_start[static_cast<std::size_t>(r)]; e < g.row_start[static_cast<std::size_t>(r) + 1]; ++e)
          dense(r, g.column[static_cast<std::size_t>(e)]) = g.value[static_cast<std::size_t>(e)];
      const Eigen::VectorXd sigma = Eigen::BDCSVD<Eigen::MatrixXd>(dense).singularValues();
      const double top = sigma[0];
      const auto above = (sigma.array() > 1e-9 * top).count();
      if ((sigma.array() > 1e-13 * top && sigma.array() < 1e-6 * top).any() &&
          above != (sigma.array() > 1e-13 * top).count()) {
        ++undecided;  // no clear gap: the reference does not know
        continue;
      }
      ++compared;
      EXPECT_EQ(exact_rank(p, law, cell_free).rank, above) << "trial " << trial;
    }
  }
  EXPECT_LT(undecided, 10);
  EXPECT_GT(compared, 150);
}

TEST(ExactRank, RollingMakesEveryConnectedClusterRigid) {
  for (int trial = 0; trial < 20; ++trial) {
    RandomNetwork o;
    o.columns = 12, o.rows = 11, o.coordination = 2.5, o.periodic = false, o.seed = static_cast<std::uint64_t>(trial);
    const Packing<2> p = random_network(o);
    const RigidBodies bodies = contract_rigid_bodies(p, NetworkLaw::rolling);
    const ExactRank r = exact_rank(p, NetworkLaw::rolling, false);
    EXPECT_EQ(r.floppy, 3 * bodies.count);
    // Eq. 21: H = 3 N_c - 3 N + K; each independent loop adds 3.
    const auto loops =
        static_cast<std::int64_t>(p.links.size()) - (static_cast<std::int64_t>(p.bodies.size()) - bodies.count);
    EXPECT_EQ(r.hyperstatic, 3 * loops);
  }
}

TEST(ExactRank, Torture) {
  const auto rank_of = [](const std::string& text, NetworkLaw law = NetworkLaw::friction, bool cell_free = false) {
    return exact_rank(parse_network<2>(text, "torture").packing, law, cell_free);
  };
  {  // no contacts at all
    const ExactRank r = rank_of("grain 0 0 0 .5\ngrain 1 9 0 .5\n");
    EXPECT_EQ(r.floppy, 6);
    EXPECT_EQ(r.hyperstatic, 0);
    EXPECT_EQ(r.mechanisms, 0);
    const ExactRank one = rank_of("grain 0 0 0 .5\n", NetworkLaw::frictionless);
    EXPECT_EQ(one.floppy, 2);
    EXPECT_EQ(one.mechanisms, 0);
    const ExactRank cell = rank_of("cell 50 50\ngrain 0 0 0 .5\ngrain 1 9 0 .5\n", NetworkLaw::friction, true);
    EXPECT_EQ(cell.floppy, 8);
    EXPECT_EQ(cell.mechanisms, 2);  // the two strains
  }
  {  // a grain touching its own images: both rows of the x image, then of the y image
    const ExactRank r =
        rank_of("cell 1 1\ngrain 0 0 0 .5\ncontact 0 0 c 1 0\ncontact 0 0 c 0 1\n", NetworkLaw::friction, true);
    EXPECT_EQ(r.dofs, 5);
    EXPECT_EQ(r.floppy, 2);
    EXPECT_EQ(r.hyperstatic, 1);
  }
  {  // collinear chain of three pins between three bodies is not rigid: 3 bodies in a row cannot touch pairwise, so pin
     // through contact lines that do not touch
    const ExactRank r =
        rank_of("grain 0 0 0 1\ngrain 1 4 0 1\ngrain 2 8 0 1\ncontact 0 1 c\ncontact 1 2 c\ncontact 0 2 c\n");
    EXPECT_EQ(r.rank,
              rational_rank(
                  parse_network<2>(
                      "grain 0 0 0 1\ngrain 1 4 0 1\ngrain 2 8 0 1\ncontact 0 1 c\ncontact 1 2 c\ncontact 0 2 c\n", "t")
                      .packing,
                  NetworkLaw::friction, false));
    EXPECT_EQ(r.hyperstatic, 1);
    EXPECT_EQ(r.floppy, 4);
  }
  {  // radii from 1e-3 to 1e3, offsets of 1e8: the integers of the double triangle stay
    for (const double offset : {0.0, 1e8, -1e8}) {
      Packing<2> p = read_network<2>(ISOSTAT_DATA "/clusters/double_triangle.net").packing;
      for (Vec2& r : p.bodies.position) r[0] += offset, r[1] -= offset;
      p.bodies.radius = {1e-3, 1e3, 1, 17};
      const ExactRank r = exact_rank(p, NetworkLaw::friction, false);
      EXPECT_EQ(r.floppy, 3);
      EXPECT_EQ(r.hyperstatic, 1);
      EXPECT_EQ(exact_rank(p, NetworkLaw::rolling, false).hyperstatic, 6);
    }
  }
  {  // disconnected pieces: two triangles
    std::string text;
    for (int k = 0; k < 2; ++k)
      for (int g = 0; g < 3; ++g)
        text += "grain " + std::to_string(3 * k + g) + " " + std::to_string(10 * k + (g == 1)) + " " +
                std::to_string(g == 2 ? 0.8 : 0.0) + " .5\n";
    for (int k = 0; k < 2; ++k)
      for (int g = 0; g < 3; ++g)
        text += "contact " + std::to_string(3 * k + g) + " " + std::to_string(3 * k + (g + 1) % 3) + " c\n";
    const ExactRank r = rank_of(text);
    EXPECT_EQ(r.floppy, 6);
    EXPECT_EQ(r.trivial, 3);
    EXPECT_EQ(r.mechanisms, 3);
    EXPECT_EQ(r.hyperstatic, 0);
  }
  {  // coincident contacts: two overlapping disks meet a third at one and the same point (.5, 0), so their two pins on
     // it are not distinct
    const Packing<2> p = parse_network<2>(
                             "grain 0 0 0 1\ngrain 1 .75 0 .5\ngrain 2 1 0 1\n"
                             "contact 0 1 c\ncontact 0 2 c\ncontact 1 2 c\n",
                             "torture")
                             .packing;
    for (const NetworkLaw law : kLaws)
      EXPECT_EQ(exact_rank(p, law, false).rank, rational_rank(p, law, false)) << static_cast<int>(law);
  }
  {  // a perfect crystal of equal disks, in every law and cell: special positions, against rational elimination
    RandomNetwork o;
    o.columns = o.rows = 6, o.jitter = 0, o.coordination = 6;
    Packing<2> p = random_network(o);
    p.bodies.radius.assign(p.bodies.size(), 0.5);
    for (const NetworkLaw law : kLaws)
      for (const bool cell_free : {false, true}) {
        const ExactRank r = exact_rank(p, law, cell_free);
        EXPECT_EQ(r.rank, rational_rank(p, law, cell_free));
        EXPECT_TRUE(r.certified);
        EXPECT_EQ(r.mechanisms, 0);
      }
  }
  {  // several links between one pair, through different images, and one link line twice: each is a row of its own
    const ExactRank once = rank_of("cell 2 9\ngrain 0 0 0 .5\ngrain 1 1 0 .5\ncontact 0 1 c 0 0\ncontact 0 1 c -1 0\n");
    EXPECT_EQ(once.rows, 4);
    EXPECT_EQ(once.rank, 3);
    EXPECT_EQ(once.hyperstatic, 1);
  }
  EXPECT_THROW(rank_of("grain 0 0 0 .5\n", NetworkLaw::friction, true), InputError);
}

// One line given twice, or a pair that is given two kinds for the same image, is refused with both lines named.
TEST(ExactRank, DuplicateAndContradictoryLines) {
  const std::string grains = "grain 0 0 0 .5\ngrain 1 1 0 .5\n";
  for (const char* contacts : {"contact 0 1 c\ncontact 0 1 c\n", "contact 0 1 c\ncontact 1 0 s\n"})
    EXPECT_THROW(parse_network<2>(grains + contacts, "torture"), InputError) << contacts;
  EXPECT_THROW(parse_network<2>(grains + "grain 1 2 0 .5\n", "torture"), InputError);
}

TEST(ExactRank, GearsOfTheBipartiteGraph) {
  const auto k23 = read_network<2>(ISOSTAT_DATA "/clusters/k23.net").packing;
  const auto gears = gear_components(k23, NetworkLaw::friction);
  ASSERT_EQ(gears.size(), 1u);
  EXPECT_EQ(gears[0].size(), 5u);
  const ExactRank r = exact_rank(k23, NetworkLaw::friction, false);
  EXPECT_EQ(r.floppy, 4);
  EXPECT_EQ(r.gear_modes, 1);
  EXPECT_TRUE(r.bounds_meet);  // the generic packing of the same topology has the gear as well
  EXPECT_TRUE(gear_components(k23, NetworkLaw::rolling).empty());
}

// Prototype result of METHODS.md: perfect square lattice at its special positions is where bounds differ.
TEST(ExactRank, CrystalsAreSpecial) {
  const auto square = read_network<2>(ISOSTAT_DATA "/clusters/periodic_square3x3.net").packing;
  const ExactRank r = exact_rank(square, NetworkLaw::frictionless, false);
  EXPECT_FALSE(r.bounds_meet);
  EXPECT_TRUE(r.certified);
  EXPECT_EQ(r.primes.size(), 2u);
}

}  // namespace
}  // namespace isostat
