// Samples of each law of sizes against its closed form, counted as the law counts: grains, or their area or volume.
#include "dem/sample/grain_sizes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <numeric>

#include "dem/input_error.hpp"
#include "dem/sample/size_table.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

std::vector<double> diameters(const SizesScene& s, int dimension, std::size_t count, std::uint64_t seed = 11) {
  Random random(seed);
  return GrainSizes(s, dimension).draw(count, random).diameter;
}

// Kolmogorov and Smirnov's distance of a weighted sample from a distribution, times the root of the number of
// independent grains that it is worth, (sum w)^2 / sum w^2: above 1.63 once in a hundred.
double kolmogorov(std::vector<double> d, int power, const std::function<double(double)>& below) {
  std::sort(d.begin(), d.end());
  double total = 0, squares = 0;
  for (const double x : d) total += std::pow(x, power), squares += std::pow(x, 2 * power);
  double sum = 0, distance = 0;
  for (const double x : d) {
    const double expected = below(x);
    distance = std::max(distance, std::abs(sum / total - expected));
    sum += std::pow(x, power);
    distance = std::max(distance, std::abs(sum / total - expected));
  }
  return distance * total / std::sqrt(squares);
}
constexpr double kOnceInAHundred = 1.63;

struct Law {
  const char* name;
  SizesScene scene;
  std::function<double(double)> below;  // share of what the law counts
};

std::vector<Law> continuous_laws() {
  const double low = 0.2, high = 1;
  const auto normal = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  std::vector<Law> laws;
  SizesScene s;
  s.diameter_min = low, s.diameter_max = high;
  laws.push_back({"uniform", s, [=](double d) { return (d - low) / (high - low); }});
  s.sizes = SizeLaw::power_law, s.exponent = 1;
  laws.push_back({"1/d", s, [=](double d) { return std::log(d / low) / std::log(high / low); }});
  s.exponent = 3;
  laws.push_back({"d^-3", s, [=](double d) { return (1 - std::pow(d / low, -2)) / (1 - std::pow(high / low, -2)); }});
  s = {}, s.diameter_min = low, s.diameter_max = high, s.sizes = SizeLaw::lognormal;
  for (const double deviation : {0.2, 0.7})
    for (const double median : {0.35, 0.6}) {
      s.log_deviation = deviation, s.median = median;
      const double a = normal(std::log(low / median) / deviation), b = normal(std::log(high / median) / deviation);
      laws.push_back(
          {"lognormal", s, [=](double d) { return (normal(std::log(d / median) / deviation) - a) / (b - a); }});
    }
  return laws;
}

TEST(GrainSizes, SamplesHaveTheirLawByNumberAndByVolume) {
  for (Law& law : continuous_laws())
    for (const int dimension : {2, 3})
      for (const ShareOf of : {ShareOf::number, ShareOf::volume}) {
        law.scene.share_of = of;
        const auto d = diameters(law.scene, dimension, 20000);
        const bool volume = of == ShareOf::volume;
        EXPECT_LT(kolmogorov(d, volume ? dimension : 0, law.below), kOnceInAHundred)
            << law.name << " " << dimension << "D " << volume;
        // It would not pass for the other kind of share.
        EXPECT_GT(kolmogorov(d, volume ? 0 : dimension, law.below), 3 * kOnceInAHundred) << law.name;
        EXPECT_GE(*std::min_element(d.begin(), d.end()), 0.2);
        EXPECT_LE(*std::max_element(d.begin(), d.end()), 1);
      }
}

TEST(GrainSizes, MomentsAreThoseOfTheSample) {
  std::vector<Law> laws = continuous_laws();
  SizesScene two;
  two.sizes = SizeLaw::bidisperse, two.large_share = 0.3;
  laws.push_back({"bidisperse", two, nullptr});
  for (Law& law : laws)
    for (const ShareOf of : {ShareOf::number, ShareOf::volume}) {
      law.scene.share_of = of;
      const GrainSizes sizes(law.scene, 2);
      const auto d = diameters(law.scene, 2, 20000);
      EXPECT_NEAR(sizes.mean_power(0), 1, 1e-12) << law.name;
      for (const int k : {1, 2, 3}) {
        double sum = 0, squares = 0;
        for (const double x : d) sum += std::pow(x, k), squares += std::pow(x, 2 * k);
        const double mean = sum / 20000, error = std::sqrt((squares / 20000 - mean * mean) / 20000);
        EXPECT_NEAR(mean, sizes.mean_power(k), 4 * error) << law.name << " " << k;
      }
    }
}

TEST(GrainSizes, UniformDisksKeepTheirBits) {
  const SizesScene s;
  Random random(5);
  for (const double d : diameters(s, 2, 100, 5)) EXPECT_EQ(d, 0.5 + (1.0 - 0.5) * random.uniform());
  SizesScene power;
  power.exponent = 3.5;  // without grains.sizes, as scenes of spheres have it
  Random again(5);
  for (const double d : diameters(power, 3, 100, 5)) EXPECT_EQ(d, (SizeDistribution{0.5, 1.0, 3.5}.draw(again)));
}

TEST(GrainSizes, TwoSizesHaveTheirSharesToHalfAGrain) {
  SizesScene s;
  s.sizes = SizeLaw::bidisperse, s.diameter_min = 0.4, s.large_share = 0.3, s.density_ratio = 2.5;
  for (const int dimension : {2, 3})
    for (const ShareOf of : {ShareOf::number, ShareOf::volume}) {
      s.share_of = of;
      Random random(1);
      const DrawnSizes drawn = GrainSizes(s, dimension).draw(1001, random);
      const int power = of == ShareOf::volume ? dimension : 0;
      double large = 0, all = 0;
      for (std::size_t k = 0; k < 1001; ++k) {
        const double d = drawn.diameter[k];
        ASSERT_TRUE(d == 0.4 || d == 1.0);
        EXPECT_EQ(drawn.density[k], d == 1.0 ? 2.5 : 1.0);
        all += std::pow(d, power);
        if (d == 1.0) large += std::pow(d, power);
      }
      // A large grain in the place of a small one changes the large ones by 1, and all by less.
      EXPECT_NEAR(large, 0.3 * all, 0.5 * (1 - 0.3 * (1 - std::pow(0.4, power))) + 1e-9) << dimension << power;
    }
  s.large_share = 0;
  for (const double d : diameters(s, 2, 10)) EXPECT_EQ(d, 0.4);
  s.large_share = 1;
  for (const double d : diameters(s, 2, 10)) EXPECT_EQ(d, 1.0);
  s.large_share = 1e-3;
  try {
    diameters(s, 2, 100);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("grains.count"));
  }
}

class SizeTables : public ::testing::Test {
 protected:
  SizeTables() { scene_.sizes = SizeLaw::table, scene_.size_table = folder_ / "sizes.csv"; }
  void table(const std::string& text) const { std::ofstream(scene_.size_table) << text; }
  std::string refusal() const {
    try {
      (void)GrainSizes(scene_, 2);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  SizesScene scene_;
};

// Micrometres; the largest is a.
TEST_F(SizeTables, SharesOfDiametersByNumberAndByVolume) {
  table("diameter,share,density\n40, 0.2, 1\n60, 0.5, 1\n80, 0.3, 2\n");
  for (const int dimension : {2, 3})
    for (const ShareOf of : {ShareOf::number, ShareOf::volume}) {
      scene_.share_of = of;
      Random random(1);
      const std::size_t n = 10000;
      const DrawnSizes drawn = GrainSizes(scene_, dimension).draw(n, random);
      const int power = of == ShareOf::volume ? dimension : 0;
      const double sizes[] = {0.5, 0.75, 1}, shares[] = {0.2, 0.5, 0.3};
      double all = 0, part[3] = {};
      for (std::size_t k = 0; k < n; ++k) {
        const auto c = std::find(sizes, sizes + 3, drawn.diameter[k]) - sizes;
        ASSERT_LT(c, 3);
        EXPECT_EQ(drawn.density[k], c == 2 ? 2 : 1);
        all += std::pow(sizes[c], power), part[c] += std::pow(sizes[c], power);
      }
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(part[c] / all, shares[c], 3.0 / n) << dimension << power << c;
    }
}

TEST_F(SizeTables, WhatPassesSievesIsSpreadBetweenThem) {
  table("diameter,passing\n1,0\n2,0.25\n3,0.25\n4,0.85\n5,1\n6,1\n");
  const auto below = [](double d) {
    const double x = 5 * d;  // the largest grain that there is has 5
    return x < 2 ? 0.25 * (x - 1) : x < 3 ? 0.25 : x < 4 ? 0.25 + 0.6 * (x - 3) : 0.85 + 0.15 * (x - 4);
  };
  for (const int dimension : {2, 3})
    for (const ShareOf of : {ShareOf::number, ShareOf::volume}) {
      scene_.share_of = of;
      EXPECT_LT(kolmogorov(diameters(scene_, dimension, 20000), of == ShareOf::volume ? dimension : 0, below),
                kOnceInAHundred);
    }
}

TEST_F(SizeTables, FaultsNameLineColumnAndRule) {
  const auto refused = [&](const std::string& text, const std::string& place, const std::string& rule) {
    table(text);
    EXPECT_THAT(refusal(), HasSubstr(scene_.size_table + place)) << text;
    EXPECT_THAT(refusal(), HasSubstr(rule)) << text;
  };
  refused("diameter,share\n1,0.5\n2,-0.5\n3,1\n", ":3: share = -0.5", "must not be negative");
  refused("diameter,share\n1,0.5\n2,0.4\n", ":3: share = 0.9", "add up to, in place of 1");
  refused("diameter,share\n1,40\n2,60\n", ":3: share = 100", "0.25 for 25 %");
  refused("diameter,share\n2,0.5\n1,0.5\n", ":3: diameter = 1.0", "ascend");
  refused("diameter,share\n0,0.5\n1,0.5\n", ":2: diameter = 0.0", "positive");
  refused("diameter,share\n1,half\n2,0.5\n", ":2: share = half", "finite number");
  refused("diameter,share,density\n1,0.5,0\n2,0.5,1\n", ":2: density = 0.0", "positive");
  refused("diameter,share\n1,0.5,3\n", ":2", "as many fields");
  refused("diameter,mass\n1,0.5\n", ":1: share", "column is missing");
  refused("d,share\n1,1\n", ":1: diameter", "column is missing");
  refused("diameter,share\n", ":1: diameter", "too few rows");
  refused("diameter,passing\n1,0.1\n2,1\n", ":2: passing = 0.1", "starts at 0");
  refused("diameter,passing\n1,0\n2,0.6\n3,0.5\n4,1\n", ":4: passing = 0.5", "never falls");
  refused("diameter,passing\n1,0\n2,0.9\n", ":3: passing = 0.9", "ends at 1");
  refused("diameter,share,passing\n1,1,0\n2,0,1\n", ":1: passing", "not both");
  table("diameter,share\n1,0.3333\n2,0.3333\n3,0.3333\n");
  EXPECT_EQ(refusal(), "") << "printed shares are rounded";
  scene_.size_table = folder_ / "nowhere.csv";
  EXPECT_THAT(refusal(), HasSubstr("nowhere.csv"));
}

TEST(GrainSizes, BrokenRulesAreTold) {
  const auto keys = [](const SizesScene& s) {
    std::vector<std::string> found;
    for (const SceneConflict& c : size_conflicts(s, 2)) found.push_back(c.key);
    return found;
  };
  using Keys = std::vector<std::string>;
  SizesScene s;
  EXPECT_EQ(keys(s), Keys{});
  s.sizes = SizeLaw::power_law;
  EXPECT_EQ(keys(s), Keys{"grains.exponent"});
  s.sizes = SizeLaw::table;
  EXPECT_EQ(keys(s), Keys{"grains.size_table"});
  s.sizes = SizeLaw::bidisperse, s.size_table = "sizes.csv";
  EXPECT_EQ(keys(s), Keys{"grains.sizes"});
  s = {}, s.sizes = SizeLaw::lognormal;
  EXPECT_EQ(keys(s), Keys{});
  s.median = 3;
  EXPECT_EQ(keys(s), Keys{"grains.median"});
  s.median.reset(), s.log_deviation = 50;
  EXPECT_EQ(keys(s), Keys{"grains.log_deviation"});
}

}  // namespace
}  // namespace isostat
