// What changed between two states: two rigid triads that turn about a common grain, a packing told in other words,
// links that come and go, in the plane and in space.
#include "analysis/compare/comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <random>

#include "tests/support/random_network.hpp"
#include "tests/support/random_spheres.hpp"

namespace isostat {
namespace {

constexpr double kPi = std::numbers::pi;

template <int D>
void add_grain(Packing<D>& p, std::int64_t id, const Vec<D>& at) {
  p.bodies.resize(p.bodies.size() + 1);
  p.bodies.id.back() = id, p.bodies.position.back() = at, p.bodies.radius.back() = 0.5;
}

template <int D>
void add_contacts(Packing<D>& p, const std::vector<std::array<int, 2>>& pairs) {
  for (const auto& [i, j] : pairs) {
    Link<D> link;
    link.i = i, link.j = j;
    p.links.push_back(link);
  }
}

// Grains 0 1 2 and 2 3 4 are triads of touching disks; the second is turned about grain 2 by `turn`.
Packing<2> hinge(double turn) {
  Packing<2> p;
  const double h = std::sqrt(3) / 2;
  const std::vector<Vec2> arm{{{1, 0}}, {{0.5, h}}};
  add_grain(p, 0, Vec2{{-1, 0}});
  add_grain(p, 1, Vec2{{-0.5, h}});
  add_grain(p, 2, Vec2{{0, 0}});
  for (std::size_t k = 0; k < 2; ++k) {
    const double c = std::cos(turn), s = std::sin(turn);
    add_grain(p, static_cast<std::int64_t>(3 + k),
              Vec2{{c * arm[k][0] - s * arm[k][1], s * arm[k][0] + c * arm[k][1]}});
  }
  add_contacts(p, {{0, 1}, {1, 2}, {0, 2}, {2, 3}, {3, 4}, {2, 4}});
  return p;
}

TEST(Comparison, AHingeJoinsTwoRegions) {
  const Comparison<2> c = compare(hinge(0), hinge(-0.3), kRigidTolerance);
  ASSERT_EQ(c.regions.regions.size(), 2u);
  for (const RigidRegion& r : c.regions.regions) {
    EXPECT_EQ(r.grains.size(), 3u);
    EXPECT_NEAR(r.misfit, 0, 1e-14);
  }
  EXPECT_EQ(c.regions.grains_in_regions(), 5u);
  EXPECT_EQ(c.contacts.kept_before.size(), 6u);
  EXPECT_TRUE(c.contacts.lost.empty() && c.contacts.gained.empty());
  for (const std::int32_t r : c.regions.of_kept_link) EXPECT_GE(r, 0);
}

TEST(Comparison, WithinTheToleranceItIsOneRegionAndTheMisfitSaysHowMuchItGave) {
  const double turn = 0.5 * kRigidTolerance;
  const Comparison<2> c = compare(hinge(0), hinge(-turn), kRigidTolerance);
  ASSERT_EQ(c.regions.regions.size(), 1u);
  EXPECT_EQ(c.regions.regions[0].grains.size(), 5u);
  EXPECT_GT(c.regions.regions[0].misfit, 0.1 * turn);
  EXPECT_LT(c.regions.regions[0].misfit, turn);
}

TEST(Comparison, AChainThatBendsIsNoRegion) {
  Packing<2> straight, bent;
  for (int k = 0; k < 6; ++k) {
    add_grain(straight, k, Vec2{{1.0 * k, 0}});
    const double phi = 0.1 * k;
    add_grain(bent, k, Vec2{{std::sin(phi) / 0.1, (1 - std::cos(phi)) / 0.1}});
  }
  for (Packing<2>* p : {&straight, &bent}) add_contacts(*p, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}});
  const Comparison<2> c = compare(straight, bent, kRigidTolerance);
  EXPECT_TRUE(c.regions.regions.empty());
  EXPECT_TRUE(std::isnan(c.regions.mean_size_weighted()));
}

// Grains in another order, in other images, links listed from the other end, a uniform strain of the cell and a drift:
// nothing but the strain has changed.
template <int D>
Packing<D> told_otherwise(const Packing<D>& p, double strain, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::size_t> order(p.bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), random);
  Packing<D> q;
  q.cell = p.cell;
  for (int k = 0; k < D; ++k) q.cell->length[k] *= 1 - strain * (k + 1);
  q.bodies.resize(p.bodies.size());
  std::vector<ImageShift<D>> moved(p.bodies.size());  // cells by which a grain went to another image
  std::vector<std::int32_t> place(p.bodies.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    const std::size_t b = order[n];
    place[b] = static_cast<std::int32_t>(n);
    q.bodies.id[n] = p.bodies.id[b], q.bodies.radius[n] = p.bodies.radius[b];
    for (int k = 0; k < D; ++k) {
      const int image = static_cast<int>(random() % 5) - 2;
      moved[b][static_cast<std::size_t>(k)] = image;
      q.bodies.position[n][k] = (p.bodies.position[b][k] / p.cell->length[k] + 0.3 + image) * q.cell->length[k];
    }
  }
  for (Link<D> link : p.links) {
    for (std::size_t k = 0; k < D; ++k)
      link.shift[k] += moved[static_cast<std::size_t>(link.i)][k] - moved[static_cast<std::size_t>(link.j)][k];
    link.i = place[static_cast<std::size_t>(link.i)], link.j = place[static_cast<std::size_t>(link.j)];
    if (random() % 2) {
      std::swap(link.i, link.j);
      for (std::size_t k = 0; k < D; ++k) link.shift[k] = -link.shift[k];
    }
    q.links.push_back(link);
  }
  std::shuffle(q.links.begin(), q.links.end(), random);
  return q;
}

template <int D>
void expect_strain_alone(const Packing<D>& p, std::uint64_t seed) {
  const Packing<D> q = told_otherwise(p, 1e-3, seed);
  const Comparison<D> c = compare(p, q, 0.05);
  EXPECT_TRUE(c.contacts.lost.empty() && c.contacts.gained.empty());
  EXPECT_TRUE(c.distant.lost.empty() && c.distant.gained.empty());
  EXPECT_EQ(c.contacts.kept_before.size() + c.distant.kept_before.size(), p.links.size());
  for (const Vec<D>& u : c.displacement) EXPECT_LT(norm(u), 1e-12);
  const auto json = comparison_json(p, q, c, 0.05);
  for (std::size_t k = 0; k < D; ++k)
    EXPECT_NEAR(json["cell"]["strain"][k].template get<double>(), 1e-3 * static_cast<double>(k + 1), 1e-14);
}

TEST(Comparison, OrderImagesAndDriftAreNoChange) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    expect_strain_alone(random_network({.columns = 3, .rows = 4, .distant = 0.2, .seed = seed}), seed);
    expect_strain_alone(random_spheres({.size = {2, 3, 2}, .coordination = 10, .distant = 0.2, .seed = seed}), seed);
  }
}

// A cell that has sheared past half its edge and was lowered by a whole one: the displacements are affine.
TEST(Comparison, ShearIsAffineWhateverTheTilt) {
  const Packing<2> p = random_network({.columns = 4, .rows = 4, .seed = 3});
  Packing<2> q = p;
  q.cell->tilt = 0.7 * q.cell->length[0];
  for (Vec2& r : q.bodies.position) r = q.cell->point(p.cell->fractions(r));
  q.cell->tilt -= q.cell->length[0];
  for (Link<2>& l : q.links) l.shift[0] += l.shift[1];
  Packing<2> before = p;
  before.cell->tilt = 0.3 * p.cell->length[0];
  for (Vec2& r : before.bodies.position) r = before.cell->point(p.cell->fractions(r));
  const Comparison<2> c = compare(before, q, 0.05);
  for (const Vec2& u : c.displacement) EXPECT_LT(norm(u), 1e-12);
  EXPECT_EQ(c.contacts.kept_before.size() + c.distant.kept_before.size(), p.links.size());
  const auto json = comparison_json(before, q, c, 0.05);
  EXPECT_NEAR(json["cell"]["shear"].get<double>(), 0.4 * p.cell->length[0] / p.cell->length[1], 1e-12);
  EXPECT_NEAR(json["displacement"]["affine_rms"].get<double>(), 0.4 * p.cell->length[0] / std::sqrt(12), 1e-12);
}

TEST(Comparison, LinksThatComeAndGoAreNamedByTheirGrains) {
  Packing<2> before = hinge(0), after = hinge(0);
  std::reverse(after.bodies.id.begin(), after.bodies.id.end());  // grain 0 is where 4 was
  std::reverse(after.bodies.position.begin(), after.bodies.position.end());
  for (Link<2>& l : after.links) l.i = 4 - l.i, l.j = 4 - l.j;
  after.links.erase(after.links.begin());        // 0-1 opens,
  after.links.front().kind = LinkKind::distant;  // 1-2 opens and attracts across the gap,
  add_contacts(after, {{0, 4}});                 // 4-0 closes
  const Comparison<2> c = compare(before, after, kRigidTolerance);
  EXPECT_EQ(c.contacts.lost, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(c.contacts.gained, (std::vector<std::size_t>{5}));
  EXPECT_EQ(c.contacts.kept_before.size(), 4u);
  EXPECT_EQ(c.distant.gained, (std::vector<std::size_t>{0}));
  EXPECT_TRUE(c.distant.lost.empty());
  const std::string csv = link_changes_csv(before, after, c);
  EXPECT_NE(csv.find("\n0,1,c,,lost,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n4,0,,c,gained,"), std::string::npos) << csv;
}

TEST(Comparison, GrainsOfOneStateOnlyAreLeftOut) {
  Packing<2> after = hinge(0);
  after.bodies.id[4] = 77;
  const Comparison<2> c = compare(hinge(0), after, kRigidTolerance);
  EXPECT_EQ(c.grains.size(), 4u);
  EXPECT_EQ(c.grains.of_before[4], -1);
  EXPECT_EQ(c.contacts.kept_before.size(), 4u);
  EXPECT_TRUE(c.contacts.lost.empty());  // those of grain 4 belong to no pair
}

TEST(Comparison, InSpaceATetrahedronIsRigidAndAHingeIsNot) {
  const auto tetrahedra = [](double turn) {
    Packing<3> p;
    const double c = std::cos(turn), s = std::sin(turn), h = std::sqrt(2.0 / 3), g = 1 / std::sqrt(3.0);
    add_grain(p, 0, Vec3{});
    for (int k = 0; k < 3; ++k)  // below the origin
      add_grain(p, 1 + k, Vec3{{g * std::cos(2 * kPi * k / 3), g * std::sin(2 * kPi * k / 3), -h}});
    for (int k = 0; k < 3; ++k) {  // above it, tilted about x
      const double y = g * std::sin(2 * kPi * k / 3), z = h;
      add_grain(p, 4 + k, Vec3{{g * std::cos(2 * kPi * k / 3), c * y - s * z, s * y + c * z}});
    }
    add_contacts(p, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}, {1, 3}, {0, 4}, {0, 5}, {0, 6}, {4, 5}, {5, 6}, {4, 6}});
    return p;
  };
  const Comparison<3> c = compare(tetrahedra(0), tetrahedra(0.2), kRigidTolerance);
  ASSERT_EQ(c.regions.regions.size(), 2u);
  for (const RigidRegion& r : c.regions.regions) {
    EXPECT_EQ(r.grains.size(), 4u);
    EXPECT_NEAR(r.misfit, 0, 1e-14);
  }
}

}  // namespace
}  // namespace isostat
