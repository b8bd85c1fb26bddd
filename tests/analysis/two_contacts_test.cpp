// Grains with two loaded contacts, against forces that are laid along the line of their contact points.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "analysis/network/sections.hpp"
#include "analysis/network/two_contacts.hpp"
#include "analysis/stiffness/bases.hpp"
#include "dem/files/network_file.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

Packing<2> disks(const std::vector<Vec2>& places, const std::vector<double>& radii) {
  Packing<2> p;
  p.bodies.resize(places.size());
  p.bodies.position = places, p.bodies.radius = radii;
  for (std::size_t k = 0; k < places.size(); ++k) p.bodies.id[k] = static_cast<std::int64_t>(k);
  return p;
}

// Force f on `neighbour` by `grain`, split by the link's normal and tangent.
Link<2> link_with_force(const Packing<2>& p, int grain, int neighbour, const Vec2& f) {
  Link<2> l;
  l.i = grain, l.j = neighbour;
  const Vec2 r =
      p.bodies.position[static_cast<std::size_t>(neighbour)] - p.bodies.position[static_cast<std::size_t>(grain)];
  const Vec2 n = r / norm(r);
  l.normal_force = dot(f, n), l.tangential_force = dot(f, Vec2{{-n[1], n[0]}});
  return l;
}

// A disk in touch with two others; `touching`: these touch each other. Forces +-f along the line of contact points.
Packing<2> held_disk(std::mt19937_64& engine, bool touching, double strength) {
  std::uniform_real_distribution<double> radius(0.25, 0.5), angle(0.3, 3.0);
  const double r = radius(engine), r1 = radius(engine), r2 = radius(engine);
  const double a = r + r1, b = r + r2, c = r1 + r2;
  const double cosine = (a * a + b * b - c * c) / (2 * a * b);
  const double gamma = touching ? std::acos(cosine) : std::acos(cosine) + 0.1 + 0.2 * angle(engine);
  Packing<2> p = disks({{{0, 0}}, {{a, 0}}, {{b * std::cos(gamma), b * std::sin(gamma)}}}, {r, r1, r2});
  const Vec2 contact1{{r, 0}}, contact2{{r * std::cos(gamma), r * std::sin(gamma)}}, along = contact2 - contact1;
  const Vec2 f = strength / norm(along) * along;
  p.links = {link_with_force(p, 0, 1, f), link_with_force(p, 0, 2, -1.0 * f)};
  if (touching) {
    p.links.push_back(link_with_force(p, 1, 2, {{0, 0}}));
    p.links.back().normal_force = 1e-9;
  }
  return p;
}

TEST(TwoContacts, ForcesThroughBothContactPointsAreAsPredicted) {
  std::mt19937_64 engine(3);
  for (int n = 0; n < 200; ++n) {
    const bool touching = n % 2 == 0;
    const Packing<2> p = held_disk(engine, touching, n % 3 == 0 ? -0.7 : 1.3);
    const auto found = two_contacts(p, 1e-4);
    ASSERT_EQ(found.size(), 2u) << n;
    for (const TwoContact& c : found) {
      EXPECT_EQ(c.grain, 0);
      EXPECT_EQ(c.touching, touching);
      EXPECT_NEAR(c.ratio / c.predicted, 1, 1e-10) << n;
    }
  }
}

TEST(TwoContacts, EqualDisksHaveTheRootOfThree) {
  Packing<2> p = read_network<2>(ISOSTAT_DATA "/clusters/double_triangle.net").packing;
  const auto f = self_stress_states(p, NetworkLaw::friction, false, 1).at(0).value;
  for (std::size_t l = 0; l < 5; ++l) p.links[l].normal_force = f[2 * l], p.links[l].tangential_force = f[2 * l + 1];
  AnalysisInput input;
  input.state.packing = p;
  const Json json = two_contacts_section(input, {});
  EXPECT_EQ(json["grains"], 2);
  EXPECT_EQ(json["touching"]["grains"], 2);
  EXPECT_EQ(json["apart"]["grains"], 0);
  EXPECT_NEAR(json["touching"]["mean_ratio"].get<double>(), std::sqrt(3.0), 1e-12);
  EXPECT_LT(json["touching"]["largest_deviation"].get<double>(), 1e-12);
  EXPECT_DOUBLE_EQ(json["touching"]["within_1_percent"].get<double>(), 1);
  EXPECT_TRUE(std::isnan(json["apart"]["median_deviation"].get<double>()));
  const std::vector<Table> tables = two_contacts_tables(input, {});
  ASSERT_EQ(tables.at(0).rows.size(), 4u);
  EXPECT_NEAR(tables.at(0).rows[0][8], tables.at(0).rows[0][9], 1e-12);
}

TEST(TwoContacts, StatisticsOfTheDeviation) {
  std::mt19937_64 engine(5);
  Packing<2> all;
  const double off[] = {0.005, 0.05, 0.5};  // relative errors of T, in three copies far from each other
  for (int n = 0; n < 3; ++n) {
    Packing<2> p = held_disk(engine, true, 1);
    for (Link<2>& l : p.links) l.tangential_force *= 1 + off[n];
    const auto first = static_cast<std::int32_t>(all.bodies.size());
    all.bodies.resize(all.bodies.size() + 3);
    for (std::size_t k = 0; k < 3; ++k) {
      all.bodies.id[static_cast<std::size_t>(first) + k] = first + static_cast<std::int32_t>(k);
      all.bodies.position[static_cast<std::size_t>(first) + k] = p.bodies.position[k] + Vec2{{10.0 * n, 0}};
      all.bodies.radius[static_cast<std::size_t>(first) + k] = p.bodies.radius[k];
    }
    for (Link<2> l : p.links) {
      l.i += first, l.j += first;
      all.links.push_back(l);
    }
  }
  AnalysisInput input;
  input.state.packing = all;
  const Json json = two_contacts_section(input, {})["touching"];
  EXPECT_EQ(json["grains"], 3);
  EXPECT_NEAR(json["median_deviation"].get<double>(), 0.05, 1e-9);
  EXPECT_NEAR(json["mean_deviation"].get<double>(), 0.185, 1e-9);
  EXPECT_NEAR(json["largest_deviation"].get<double>(), 0.5, 1e-9);
  EXPECT_NEAR(json["within_1_percent"].get<double>(), 1.0 / 3, 1e-12);
  EXPECT_NEAR(json["within_10_percent"].get<double>(), 2.0 / 3, 1e-12);
}

TEST(TwoContacts, LeavesOutWhatIsHeldOtherwise) {
  std::mt19937_64 engine(7);
  Packing<2> p = held_disk(engine, true, 1);
  p.links[0].kind = LinkKind::distant;  // no surface, no contact point
  EXPECT_TRUE(two_contacts(p, 1e-4).empty());
  p.links[0].kind = LinkKind::closed;
  EXPECT_EQ(two_contacts(p, 1e-4).size(), 2u);
  EXPECT_TRUE(two_contacts(p, 10).empty());  // nothing is loaded
  p.part = {GrainPart::free, GrainPart::wall, GrainPart::free};
  EXPECT_TRUE(two_contacts(p, 1e-4).empty());
}

// Two neighbours that touch in another image only do not touch.
TEST(TwoContacts, ImagesAreToldApart) {
  std::mt19937_64 engine(9);
  Packing<2> p = held_disk(engine, true, 1);
  p.cell = PeriodicCell<2>{{{20, 20}}};
  EXPECT_TRUE(two_contacts(p, 1e-4).at(0).touching);
  p.links[2].shift = {1, 0};
  EXPECT_FALSE(two_contacts(p, 1e-4).at(0).touching);
  p.links[2].shift = {0, 0};
  p.bodies.position[1] -= Vec2{{20, 0}};  // the same place, another image
  p.links[0].shift = {1, 0}, p.links[2].shift = {-1, 0};
  const auto found = two_contacts(p, 1e-4);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].touching);
  EXPECT_NEAR(found[0].ratio / found[0].predicted, 1, 1e-10);
}

}  // namespace
}  // namespace isostat
