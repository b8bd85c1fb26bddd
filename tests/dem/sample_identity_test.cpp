// Fast and blind insertion make packings of one distribution: ensembles of both, compared reading by reading.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "dem/sample/free_volume.hpp"
#include "dem/sample/insertion.hpp"
#include "dem/sample/placement.hpp"
#include "dem/sample/size_statistics.hpp"
#include "tests/oracle/blind_insertion.hpp"

namespace isostat {
namespace {

constexpr double kLevel = 1e-3;  // of each two-sample Kolmogorov-Smirnov test: chance to reject one distribution

// Largest difference of the two empirical distributions over its critical value at kLevel.
double ks(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end()), std::sort(b.begin(), b.end());
  const double n = static_cast<double>(a.size()), m = static_cast<double>(b.size());
  double most = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double x = std::min(a[i], b[j]);
    while (i < a.size() && a[i] == x) ++i;
    while (j < b.size() && b[j] == x) ++j;
    most = std::max(most, std::abs(static_cast<double>(i) / n - static_cast<double>(j) / m));
  }
  return most / (std::sqrt(-std::log(kLevel / 2) / 2) * std::sqrt((n + m) / (n * m)));
}

using Readings = std::map<std::string, std::vector<double>>;  // name: one number a packing

template <int D>
void read(const Enclosure<D>& room, const std::vector<Vec<D>>& x, const std::vector<double>& drawn,
          const InsertionScene& s, Readings& readings) {
  const std::vector<double> r = oracle::grow_blind(room, x, drawn, s.radius_max);
  double volume = 0, before = 0, gap = 0;
  for (std::size_t k = 0; k < r.size(); ++k) {
    volume += ball_measure<D>(r[k]), before += ball_measure<D>(drawn[k]);
    gap += oracle::nearest_gap(room, x, drawn, k) / drawn[k];
  }
  const double n = static_cast<double>(r.size());
  readings["grains"].push_back(n);
  readings["density"].push_back(volume / room.measure());
  readings["density before growth"].push_back(before / room.measure());
  readings["mean nearest gap"].push_back(gap / n);
  readings["exponent"].push_back(likely_exponent(r, s.radius_min, s.radius_max).value);
  readings["place of the first"].push_back(x.front()[0]);
  readings["place of the last"].push_back(room.cell ? x.back()[1] : norm(x.back()));
  const SizeHistogram h = size_histogram(r, s.radius_min, s.radius_max, 5);
  for (std::size_t k = 0; k < 5; ++k)
    readings["sizes in bin " + std::to_string(k)].push_back(static_cast<double>(h.count[k]));
}

template <int D>
Readings ensemble(const InsertionScene& s, int packings, bool blind, std::uint64_t seed) {
  Readings readings;
  const Enclosure<D> room = enclosure_of<D>(s);
  for (int k = 0; k < packings; ++k) {
    Random random(seed + static_cast<std::uint64_t>(k));
    const std::vector<double> radii = listed_radii(s, D, room.measure(), random);
    if (blind) {
      const auto p = oracle::place_blind(room, radii, s.trials, random);
      read(room, p.position, p.radius, s, readings);
    } else {
      const Placed<D> p = place(room, radii, s.trials, random);
      read(room, p.position, p.radius, s, readings);
    }
  }
  return readings;
}

InsertionScene small(double ratio, double beta, double trials) {
  InsertionScene s;
  s.radius_min = s.radius_max / ratio, s.volume_factor = beta, s.trials = trials;
  return s;
}

template <int D>
void expect_one_distribution(const InsertionScene& s, int packings) {
  const Readings fast = ensemble<D>(s, packings, false, 100000), blind = ensemble<D>(s, packings, true, 200000);
  for (const auto& [name, values] : blind) EXPECT_LT(ks(fast.at(name), values), 1) << D << "D, " << name;
}

TEST(InsertionIdentity, InASphericalShell) { expect_one_distribution<3>(small(4, 1.2, 100), 200); }
TEST(InsertionIdentity, InACircularShell) { expect_one_distribution<2>(small(6, 1.1, 200), 200); }
TEST(InsertionIdentity, InASphericalShellWithOneTrial) { expect_one_distribution<3>(small(3, 2, 1), 400); }

TEST(InsertionIdentity, InABox) {
  InsertionScene s = small(4, 1, 60);
  s.room = InsertionRoom::box, s.box = {1.4, 1.2, 2.6};
  expect_one_distribution<3>(s, 200);
}

TEST(InsertionIdentity, InARectangle) {
  InsertionScene s = small(6, 1.1, 200);
  s.room = InsertionRoom::box, s.box = {1, 2.7, 0};
  expect_one_distribution<2>(s, 200);
}

// Half of the trials is seen, so an error in counting them would be.
TEST(InsertionIdentity, IsRefusedToOtherTrials) {
  const Readings fast = ensemble<3>(small(4, 1.2, 50), 200, false, 100000),
                 blind = ensemble<3>(small(4, 1.2, 100), 200, true, 200000);
  EXPECT_GT(ks(fast.at("density before growth"), blind.at("density before growth")), 1);
}

// The share of the room that is open to a next grain, and where it is: candidates against random points of the room.
template <int D>
void expect_open_space(const Enclosure<D>& room, double radius_last) {
  const std::vector<double> radii{0.5, 0.42, 0.35, 0.3, 0.22, 0.2, 0.18};
  Random random(12);
  const auto p = oracle::place_blind(room, radii, 1000, random);
  GrainIndex<D> index(room, 0.5, {10, 10, 10, 10});
  FreeVolume<D> open(room, index, 0.5, radius_last);
  for (std::size_t k = 0; k < p.radius.size(); ++k) {
    open.descend(p.radius[k]);
    for (int tries = 0; tries < 50 && open.fraction() > 0; ++tries) {  // refined among few grains, then these are many
      const auto point = open.draw(random);
      if (!(p.radius[k] <= room.largest_at(point.position)))
        open.refine(point, nullptr);
      else if (const auto* g = index.overlapping(point.position, p.radius[k]))
        open.refine(point, g);
    }
    index.add(p.position[k], p.radius[k]);
  }
  for (const double r : {0.15, 0.1, 0.08}) {
    open.descend(r);
    const auto free = [&](const Vec<D>& x) {
      if (!(r <= room.largest_at(x))) return false;
      for (std::size_t i = 0; i < p.radius.size(); ++i)
        if (oracle::image_distance(room, x, p.position[i]) < r + p.radius[i]) return false;
      return true;
    };
    constexpr int n = 20000;
    double chance = 0, variance = 0;
    std::vector<double> fast, slow;  // distances of open points from a corner of nothing in particular
    const Vec<D> from{{0.3, 0.1}};
    for (int k = 0; k < n; ++k) {
      const double fraction = open.fraction();
      ASSERT_LE(fraction, 1 + 1e-12);
      const auto point = open.draw(random);
      if (free(point.position)) {
        chance += fraction / n, variance += fraction * fraction / n / n;
        fast.push_back(norm(point.position - from));
      } else {
        open.refine(point, index.overlapping(point.position, r));
      }
      const Vec<D> x = oracle::random_point(room, random);
      if (free(x)) slow.push_back(norm(x - from));
    }
    const double blind = static_cast<double>(slow.size()) / n;
    EXPECT_NEAR(chance, blind, 4 * std::sqrt(variance + blind / n)) << D << "D, r = " << r;
    EXPECT_GT(static_cast<double>(fast.size()), 2.0 * static_cast<double>(slow.size()));
    EXPECT_LT(ks(fast, slow), 1) << D << "D, r = " << r;
  }
}

TEST(FreeVolume, HoldsAllOpenSpace) {
  expect_open_space<2>(Enclosure<2>::shell(1), 0.08);
  expect_open_space<3>(Enclosure<3>::shell(0.8), 0.08);
  expect_open_space<2>(Enclosure<2>::box({{2, 1.1}}), 0.05);
  expect_open_space<3>(Enclosure<3>::box({{1.1, 1, 1.5}}), 0.05);
}

}  // namespace
}  // namespace isostat
