#include "dem/files/network_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <set>
#include <tuple>

#include "dem/input_error.hpp"
#include "dem/state/touching.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

TEST(NetworkFile, KeepsContactLinesAsTheyStand) {
  const auto file = parse_network<2>(
      "# comment\ncell 10 20\ncontact 7 -3 sr 1 0\n grain 7 9.5 1 0.5 # right edge\ngrain -3 0.5 1 .25\n"
      "contact -3 7 d 0 1\r\n",
      "a.net");
  ASSERT_EQ(file.packing.bodies.size(), 2u);
  EXPECT_TRUE(file.links_given);
  ASSERT_EQ(file.packing.links.size(), 2u);
  EXPECT_EQ(file.packing.links[0].kind, LinkKind::both_yielded);
  EXPECT_EQ(file.packing.links[0].i, 0);
  EXPECT_EQ(file.packing.links[0].j, 1);
  EXPECT_DOUBLE_EQ(file.packing.links[0].gap, 0.25);
  EXPECT_EQ(file.packing.links[1].kind, LinkKind::distant);
}

TEST(NetworkFile, NearestImageWithoutShift) {
  const auto file = parse_network<2>("cell 10 20\ngrain 1 29.5 1 .5\ngrain 2 0.5 -39 .5\ncontact 1 2 c\n", "a.net");
  ASSERT_EQ(file.packing.links.size(), 1u);
  EXPECT_EQ(file.packing.links[0].shift, (ImageShift<2>{3, 2}));
  EXPECT_DOUBLE_EQ(file.packing.links[0].gap, 0.0);
  EXPECT_EQ(file.packing.bodies.id, (std::vector<std::int64_t>{1, 2}));
  EXPECT_DOUBLE_EQ(file.packing.bodies.inertia[0], 0.125);
}

TEST(NetworkFile, SeveralImagesAndOwnImage) {
  const auto file = parse_network<2>(
      "cell 1 1\ngrain 1 0 0 .5\ngrain 2 .5 .5 .2\ncontact 1 1 c 1 0\ncontact 1 1 c 0 1\ncontact 1 2 c 0 0\n"
      "contact 1 2 s -1 0\n",
      "a.net");
  EXPECT_EQ(file.packing.links.size(), 4u);
}

TEST(NetworkFile, Beams) {
  const std::string text =
      "cell 4 4\ngrain 1 0 0 .5\ngrain 2 1 0 .5\ngrain 3 3 0 .5\nbeam 1 2\nbeam 3 1\nbeam 1 1 0 1\n";
  const auto file = parse_network<2>(text, "a.net");
  const Packing<2>& p = file.packing;
  EXPECT_FALSE(file.links_given);  // of contacts none is given: 1 and 2, 1 and 3 touch, but beams join them
  ASSERT_EQ(p.links.size(), 3u);
  ASSERT_EQ(p.beams.size(), 3u);
  EXPECT_EQ(p.links[1].kind, LinkKind::beam);
  EXPECT_EQ(p.links[1].shift, (ImageShift<2>{1, 0}));  // the nearest image
  EXPECT_EQ(p.links[1].beam, 1);
  EXPECT_EQ(p.links[1].gap, 0);
  EXPECT_EQ(p.beams[1], (Beam{1, 0, 0, 1e5, 10}));
  EXPECT_EQ(p.beams[2].rest_length, 4);
  EXPECT_EQ(network_text(parse_network<2>(network_text(p), "b.net").packing), network_text(p));

  // Beside a contact of the same pair, and with contact lines nothing is looked for.
  const auto both = parse_network<2>(text + "contact 1 2 s\n", "a.net");
  EXPECT_TRUE(both.links_given);
  EXPECT_EQ(both.packing.links.size(), 4u);
}

TEST(NetworkFile, AContactThatABeamDoesNotJoinIsFound) {
  const auto file = parse_network<2>("grain 1 0 0 .5\ngrain 2 1 0 .5\ngrain 3 2 0 .5\nbeam 1 3\n", "a.net");
  ASSERT_EQ(file.packing.links.size(), 3u);
  EXPECT_EQ(file.packing.links[0].kind, LinkKind::beam);
  EXPECT_EQ(file.packing.links[2].kind, LinkKind::closed);
}

TEST(NetworkFile, ALoadedBeamIsNotWritten) {
  Packing<2> p = parse_network<2>("grain 1 0 0 .5\ngrain 2 1 0 .5\nbeam 1 2\n", "a.net").packing;
  p.links[0].moment = 1;
  EXPECT_THROW(network_text(p), InputError);
  p.links[0].moment = 0, p.beams[0].stiffness = 7;
  EXPECT_THROW(network_text(p), InputError);
}

std::string faults_of(const char* text) {
  try {
    parse_network<2>(text, "bad.net");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(NetworkFile, FaultsOfBeams) {
  const std::string faults = faults_of(
      "cell 9 9\ngrain 1 0 0 .5\ngrain 2 1 0 .5\nbeam 1 1\nbeam 1 3\nbeam 1 2\nbeam 2 1 0 0\nbeam 1 2 c\nbeam 1 2 0 "
      "x\n");
  EXPECT_THAT(faults, HasSubstr("bad.net:4: beam = 1 1"));
  EXPECT_THAT(faults, HasSubstr("a beam cannot join a grain to itself except through an image"));
  EXPECT_THAT(faults, HasSubstr("bad.net:5: beam.J = 3: no grain line has this ID"));
  EXPECT_THAT(faults, HasSubstr("repeats line 6"));
  EXPECT_THAT(faults, HasSubstr("beam I J [S1 S2]"));
  EXPECT_THAT(faults, HasSubstr("bad.net:9: beam.S2 = x"));
  try {
    parse_network<3>("grain 1 0 0 0 .5\ngrain 2 1 0 0 .5\nbeam 1 2\n", "bad.net");
    ADD_FAILURE() << "a beam in space";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("this network is in space"));
  }
}

TEST(NetworkFile, ListsEveryFaultWithItsLine) {
  const std::string message = faults_of(
      "cell 1 -1\ngrain 0 0 0 -.5\ngrain 0 0 0 1\ngrain 1 nan 0 1\ngrain x 0 0 1\ngrain 2 0 0\ncontact 0 9 c\n"
      "contact 0 1 q\nbond 0 1\ncontact 0 1\ncell 1 1\n");
  for (const char* part :
       {"bad.net:1: cell.L2 = -1", "bad.net:2: grain.R = -.5", "bad.net:3: grain.ID = 0: used before in line 2",
        "bad.net:4: grain.X = nan", "bad.net:5: grain.ID = x", "bad.net:6: grain = 3 fields",
        "bad.net:7: contact.J = 9: no grain line", "bad.net:8: contact.TYPE = q", "bad.net:9: bond",
        "bad.net:10: contact = 2 fields", "bad.net:11: cell: given before in line 1"})
    EXPECT_THAT(message, HasSubstr(part));
}

TEST(NetworkFile, RefusesRepeatedAndContradictoryLines) {
  const std::string grains = "cell 9 9\ngrain 0 0 0 .5\ngrain 1 1 0 .5\n";
  EXPECT_THAT(faults_of((grains + "contact 0 1 c\ncontact 1 0 c\n").c_str()),
              HasSubstr("bad.net:5: contact = 1 0: repeats line 4"));
  EXPECT_THAT(faults_of((grains + "contact 0 1 c 0 0\ncontact 0 1 s\n").c_str()), HasSubstr("contradicts line 4"));
  EXPECT_THAT(faults_of((grains + "contact 0 0 c 1 0\ncontact 0 0 c -1 0\n").c_str()), HasSubstr("repeats line 4"));
  EXPECT_THAT(faults_of((grains + "contact 0 0 c\n").c_str()), HasSubstr("cannot touch itself"));
  EXPECT_THAT(faults_of("grain 0 0 0 1\ngrain 1 0 0 1\ncontact 0 1 c\n"), HasSubstr("centres coincide"));
  EXPECT_THAT(faults_of("grain 0 0 0 1\ngrain 1 1 0 1\ncontact 0 1 c 1 0\n"), HasSubstr("needs a cell"));
  EXPECT_THAT(faults_of("# nothing\n"), HasSubstr("no grain line"));
}

TEST(NetworkFile, RoundTrip) {
  for (const auto& entry : std::filesystem::directory_iterator(ISOSTAT_DATA "/clusters")) {
    if (entry.path().extension() != ".net") continue;
    const auto first = read_network<2>(entry.path().string());
    const auto second = parse_network<2>(network_text(first.packing), "copy");
    EXPECT_EQ(network_text(first.packing), network_text(second.packing));
    EXPECT_EQ(first.packing.bodies.position, second.packing.bodies.position);
    EXPECT_EQ(first.packing.links.size(), second.packing.links.size());
  }
}

TEST(NetworkFile, ThreeDimensions) {
  const auto file = parse_network<3>("cell 4 4 4\ngrain 0 0 0 0 1\ngrain 1 3 0 3 .5\ncontact 0 1 c -1 0 -1\n", "a.net");
  ASSERT_EQ(file.packing.links.size(), 1u);
  EXPECT_DOUBLE_EQ(file.packing.links[0].gap, std::sqrt(2.0) - 1.5);
}

using Named = std::tuple<int, int, int, int>;

// Oracle: all pairs, all images within reach.
std::set<Named> touching_by_brute_force(const Packing<2>& p, double tolerance) {
  std::set<Named> found;
  const int n = static_cast<int>(p.bodies.size()), reach = p.cell ? 6 : 0;
  for (int i = 0; i < n; ++i)
    for (int j = i; j < n; ++j)
      for (int a = -reach; a <= reach; ++a)
        for (int b = -reach; b <= reach; ++b) {
          if (i == j && (a < 0 || (a == 0 && b <= 0))) continue;
          Vec2 d = p.bodies.position[static_cast<std::size_t>(j)] - p.bodies.position[static_cast<std::size_t>(i)];
          if (p.cell) d += p.cell->offset({a, b});
          if (norm(d) - p.bodies.radius[static_cast<std::size_t>(i)] - p.bodies.radius[static_cast<std::size_t>(j)] <=
              tolerance)
            found.insert({i, j, a, b});
        }
  return found;
}

TEST(Touching, EqualsBruteForce) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    Packing<2> p;
    const bool periodic = trial % 2 == 0;
    const double L = std::uniform_real_distribution<>(1.0, 12.0)(random);
    if (periodic) p.cell = PeriodicCell<2>{{L, 0.7 * L}};
    p.bodies.resize(static_cast<std::size_t>(1 + trial % 40));
    for (std::size_t i = 0; i < p.bodies.size(); ++i) {
      for (int k = 0; k < 2; ++k) p.bodies.position[i][k] = std::uniform_real_distribution<>(-L, 2 * L)(random);
      p.bodies.radius[i] = std::exp(std::uniform_real_distribution<>(-3.0, 0.3)(random));
    }
    std::set<Named> fast;
    for (const auto& l : touching_links(p, 0.05)) fast.insert({l.i, l.j, l.shift[0], l.shift[1]});
    EXPECT_EQ(fast, touching_by_brute_force(p, 0.05)) << "trial " << trial;
  }
}

TEST(Touching, LatticeOnTheCellBorder) {
  // Diameter divides the cell exactly: every disk touches four neighbours, some through the border.
  Packing<2> p;
  p.cell = PeriodicCell<2>{{3, 3}};
  for (int i = 0; i < 9; ++i) p.bodies.position.push_back({{1.0 * (i % 3), 1.0 * (i / 3)}});
  p.bodies.id.resize(9), p.bodies.radius.assign(9, 0.5);
  EXPECT_EQ(touching_links(p, 1e-9).size(), 18u);
}

}  // namespace
}  // namespace isostat
