// Counts, equilibrium, stress, forces and percolation on packings with closed forms, and against brute force.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "analysis/network/coordination.hpp"
#include "analysis/network/histogram.hpp"
#include "analysis/network/percolation.hpp"
#include "analysis/network/sections.hpp"
#include "analysis/report.hpp"
#include "dem/files/network_file.hpp"
#include "dem/input_error.hpp"

#include "dem/state/touching.hpp"
#include "tests/oracle/network_oracle.hpp"
#include "tests/support/refusal.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
using oracle::refusal;
using testing::HasSubstr;

AnalysisInput foreign(Packing<2> packing) {
  AnalysisInput input;
  input.path = "test";
  input.state.packing = std::move(packing);
  input.links_given = true;
  return input;
}

DiskLaw law_of(double attraction) {
  DiskLaw law;
  law.normal_stiffness = law.tangential_stiffness = 1e5;
  law.friction = 0.5;
  law.attraction = attraction;
  law.attraction_range = attraction > 0 ? 1e-3 : 0;
  return law;
}

AnalysisInput state_input(Packing<2> packing, const DiskLaw& law, std::optional<double> pressure) {
  AnalysisInput input = foreign(std::move(packing));
  input.state.law = law;
  input.state.imposed_stress = isotropic<2>(pressure);
  return input;
}

Packing<2> disks(const std::vector<Vec2>& places, double radius = 0.5) {
  Packing<2> p;
  p.bodies.resize(places.size());
  p.bodies.position = places;
  for (std::size_t k = 0; k < places.size(); ++k) {
    p.bodies.id[k] = static_cast<std::int64_t>(k);
    p.bodies.radius[k] = radius, p.bodies.mass[k] = 1, p.bodies.inertia[k] = 0.125;
  }
  return p;
}

Link<2> link(int i, int j, double normal, double tangential = 0, ImageShift<2> shift = {}) {
  Link<2> l;
  l.i = i, l.j = j, l.shift = shift, l.normal_force = normal, l.tangential_force = tangential;
  l.gap = -1e-5 * (normal + 1);
  return l;
}

// Triangular lattice of touching unit disks, n x 2m of them, every contact bearing the force f and overlap h.
Packing<2> triangular_lattice(int n, int m, double f, double h) {
  const double d = 1 - h, row = d * std::sqrt(3.0) / 2;
  std::vector<Vec2> places;
  for (int y = 0; y < 2 * m; ++y)
    for (int x = 0; x < n; ++x) places.push_back({{d * (x + 0.5 * (y % 2)), row * y}});
  Packing<2> p = disks(places);
  p.cell = PeriodicCell<2>{{{d * n, row * 2 * m}}};
  p.links = touching_links(p, 1e-9);
  for (Link<2>& l : p.links) l.normal_force = f;
  return p;
}

// ---------------------------------------------------------------- counts

TEST(Counts, DanglingChainIsStrippedFromTheBackboneRecursively) {
  // A triangle 0-1-2 with a chain 2-3-4-5 of loaded contacts, and grain 6 touching 0 with a force below tolerance.
  Packing<2> p = disks({{{0, 0}}, {{1, 0}}, {{0.5, 0.8}}, {{0.5, 1.8}}, {{0.5, 2.8}}, {{0.5, 3.8}}, {{-1, 0}}});
  p.links = {link(0, 1, 1), link(1, 2, 1), link(0, 2, 1),     link(2, 3, 1),
             link(3, 4, 1), link(4, 5, 1), link(0, 6, 0.9e-4)};
  const Json free = counts_section(state_input(p, law_of(0), 1.0), {});
  EXPECT_EQ(free["rattlers"], 4);
  EXPECT_EQ(free["contacts"], 6);
  EXPECT_EQ(free["unloaded_contacts"], 1);
  EXPECT_DOUBLE_EQ(free["z"], 2 * 6.0 / 7);
  EXPECT_DOUBLE_EQ(free["z_star"], 2);
  EXPECT_EQ(free["x"], Json({0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0}));

  // With cohesion nothing is removed and every interaction counts; 1-coordinated grains are listed.
  p.links.back().kind = LinkKind::distant;
  const Json stuck = counts_section(state_input(p, law_of(1), 0.01), {});
  EXPECT_EQ(stuck["rattlers"], 0);
  EXPECT_EQ(stuck["contacts"], 6);
  EXPECT_EQ(stuck["distant"], 1);
  EXPECT_DOUBLE_EQ(stuck["z"], 2);
  EXPECT_EQ(stuck["z"], stuck["z_star"]);
  EXPECT_EQ(stuck["one_coordinated"], Json({5, 6}));
}

TEST(Counts, ThresholdScalesWithThePressure) {
  Packing<2> p = disks({{{0, 0}}, {{1, 0}}});
  p.links = {link(0, 1, 0.9e-4)};
  EXPECT_EQ(counts_section(state_input(p, law_of(0), 1.0), {})["contacts"], 0);
  EXPECT_EQ(counts_section(state_input(p, law_of(0), 0.5), {})["contacts"], 1);
}

TEST(Counts, RattlersEqualRepeatedRecountOnRandomNetworks) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Packing<2> p = oracle::random_packing(seed, 40, 25 + seed, true);
    for (Link<2>& l : p.links) l.normal_force = std::abs(l.normal_force);
    for (std::size_t l = 0; l < p.links.size(); l += 4) p.links[l].normal_force = p.links[l].tangential_force = 1e-5;
    const Coordination c = coordination(p, read_forces(state_input(p, law_of(0), 1.0)));
    std::vector<char> out(p.bodies.size(), 0);
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t k = 0; k < out.size() && !changed; ++k) {
        if (out[k]) continue;
        int degree = 0;
        for (const Link<2>& l : p.links) {
          const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
          if (std::hypot(l.normal_force, l.tangential_force) > 1e-4 && !out[i] && !out[j])
            degree += (i == k) + (j == k);
        }
        if (degree < 2) out[k] = 1, changed = true;
      }
    }
    EXPECT_EQ(c.rattler, out) << "seed " << seed;
    double sum = 0;
    std::int64_t kept = 0;
    for (std::size_t k = 0; k < out.size(); ++k) sum += c.backbone_degree[k], kept += !out[k];
    EXPECT_EQ(sum, 2.0 * static_cast<double>(c.backbone_links));
    EXPECT_EQ(kept + c.rattlers, 40);
  }
}

TEST(Counts, SolidFractionsAndEquation14) {
  const double phi = std::numbers::pi / (2 * std::sqrt(3.0));
  const Json json = counts_section(foreign(triangular_lattice(4, 2, 0, 0)), {});
  EXPECT_NEAR(json["solid_fraction"], phi, 1e-14);
  EXPECT_NEAR(json["solid_fraction_3d"], 0.7522527780636751 * std::pow(phi, 1.5), 1e-14);
  EXPECT_DOUBLE_EQ(json["z"], 6);
  EXPECT_EQ(json["x"][6], 1.0);
  EXPECT_TRUE(std::isnan(counts_section(foreign(disks({{{0, 0}}})), {})["solid_fraction"].get<double>()));
}

TEST(Counts, NetworkWithoutForcesCountsEveryLink) {
  const AnalysisInput input = foreign(read_network<2>(std::string(ISOSTAT_DATA) + "/clusters/k23.net").packing);
  const Json json = counts_section(input, {});
  EXPECT_EQ(json["contacts"], 6);
  EXPECT_DOUBLE_EQ(json["z"], 2.4);
  EXPECT_EQ(json["rattlers"], 0);
}

TEST(Counts, SpheresInSpace) {
  AnalysisInput input;
  input.packing_3d.emplace();
  Packing<3>& p = *input.packing_3d;  // simple cubic, one sphere a cell
  p.cell = PeriodicCell<3>{{{1, 1, 1}}};
  p.bodies.resize(1);
  p.bodies.radius = {0.5};
  p.links = touching_links(p, 1e-9);
  const Json json = counts_section(input, {});
  EXPECT_NEAR(json["solid_fraction"], std::numbers::pi / 6, 1e-15);
  EXPECT_DOUBLE_EQ(json["z"], 6);
  EXPECT_EQ(refusal(input, "stress"), "needs forces: this input has none");
  EXPECT_EQ(refusal(input, "pores"), "is defined for packings in the plane; this one is in 3D");
  const std::vector<Table> tables = counts_tables(input, {});
  EXPECT_EQ(tables.at(0).columns[3], "z");
  EXPECT_EQ(tables.at(0).rows.at(0), (std::vector<double>{0, 0, 0, 0, 0.5, 6, 6, 0}));
}

// ---------------------------------------------------------------- stress

TEST(Stress, TriangularLatticeIsIsotropicAndRumpfIsExact) {
  const double f = 0.7, h = 1e-6;
  const Json json = stress_section(foreign(triangular_lattice(6, 3, f, h)), {});
  const double pressure = std::sqrt(3.0) * f / (1 - h);  // sum over 3 contacts a grain of f d / 2, area d^2 sqrt(3)/2
  EXPECT_NEAR(json["tensor"][0][0], pressure, 1e-12);
  EXPECT_NEAR(json["tensor"][1][1], pressure, 1e-12);
  EXPECT_NEAR(json["tensor"][0][1], 0, 1e-13);
  EXPECT_NEAR(json["mean_normal_force"], f, 1e-14);
  EXPECT_NEAR(json["rumpf_force"], f, 2 * h * f);  // Eq. 15 assumes h << R
  EXPECT_NEAR(json["mean_force_diameter"], f, 1e-14);
}

// Eq. 16 is an assumption, <N (R_i + R_j)> is not: large grains with large forces.
TEST(Stress, MeanForceDiameterClosesRumpfWhereForcesFollowSizes) {
  const int n = 200;
  std::vector<Vec2> places;
  std::vector<double> radius(n);
  double x = 0;
  for (int k = 0; k < n; ++k) {
    radius[static_cast<std::size_t>(k)] = k < n / 2 ? 0.25 : 0.5;
    x += radius[static_cast<std::size_t>(k)];
    places.push_back({{x, 0}});
    x += radius[static_cast<std::size_t>(k)];
  }
  Packing<2> p = disks(places);
  p.bodies.radius = radius;
  p.cell = PeriodicCell<2>{{{x, 2}}};
  for (int k = 0; k < n; ++k) p.links.push_back(link(k, (k + 1) % n, k < n / 2 ? 1 : 3, 0, {k + 1 == n ? 1 : 0, 0}));
  const Json stress = stress_section(foreign(p), {});
  const double mean_diameter = 0.75, rumpf = stress["rumpf_force"], mean = stress["mean_normal_force"];
  EXPECT_DOUBLE_EQ(mean, 2);
  EXPECT_NEAR(stress["mean_force_diameter"].get<double>(), (99.0 * 0.5 + 0.75 + 99 * 3 + 3 * 0.75) / 200, 1e-13);
  EXPECT_NEAR(rumpf * mean_diameter, stress["mean_force_diameter"].get<double>(), 1e-12);
  EXPECT_GT(rumpf, 1.1 * mean);
}

TEST(Stress, RumpfForceIsEquation18ForThePapersDiameters) {
  const int n = 400;  // diameters at the quantiles of the uniform distribution in [1/2, 1]
  std::vector<Vec2> places;
  for (int k = 0; k < n; ++k) places.push_back({{1.0 * k, 0}});
  Packing<2> p = disks(places);
  for (int k = 0; k < n; ++k) p.bodies.radius[static_cast<std::size_t>(k)] = 0.25 + 0.25 * (k + 0.5) / n;
  p.cell = PeriodicCell<2>{{{1.0 * n, 2}}};
  for (int k = 0; k < n; ++k)
    p.links.push_back(link(k, (k + 1) % n, 1 + 0.3 * std::sin(k), 0, {k + 1 == n ? 1 : 0, 0}));
  const AnalysisInput input = foreign(p);
  const Json stress = stress_section(input, {}), counts = counts_section(input, {});
  const double pressure = stress["pressure"], z = counts["z"], phi = counts["solid_fraction"];
  EXPECT_NEAR(stress["rumpf_force"].get<double>(), 7 * std::numbers::pi / 9 * pressure / (z * phi), 1e-5);
}

TEST(Stress, TensorMatchesPairSumOnRandomPackings) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Packing<2> p = oracle::random_packing(seed, 10, 30, true);
    double s[2][2] = {};
    for (std::size_t k = 0; k < p.bodies.size(); ++k)
      for (int a : {0, 1})
        for (int b : {0, 1}) s[a][b] += p.bodies.mass[k] * p.bodies.velocity[k][a] * p.bodies.velocity[k][b];
    for (const Link<2>& l : p.links) {
      const Vec2 r = p.bodies.position[static_cast<std::size_t>(l.j)] + p.cell->offset(l.shift) -
                     p.bodies.position[static_cast<std::size_t>(l.i)];
      const Vec2 n = (1 / norm(r)) * r, f = l.normal_force * n + l.tangential_force * Vec2{{-n[1], n[0]}};
      for (int a : {0, 1})
        for (int b : {0, 1}) s[a][b] += f[a] * r[b];
    }
    const Json json = stress_section(foreign(p), {});
    for (int a : {0, 1})
      for (int b : {0, 1}) EXPECT_NEAR(json["tensor"][a][b], s[a][b] / p.cell->measure(), 1e-12);
  }
}

TEST(Stress, RefusesWhatHasNoAreaOrNoForces) {
  Packing<2> p = disks({{{0, 0}}, {{1, 0}}});
  p.links = {link(0, 1, 1)};
  EXPECT_THAT(refusal(foreign(p), "stress"), HasSubstr("no area"));
  EXPECT_THAT(refusal(foreign(p), "percolation"), HasSubstr("needs a periodic cell"));
  p.cell = PeriodicCell<2>{{{4, 4}}};
  p.links[0].normal_force = 0;
  for (const char* section : {"stress", "forces", "percolation"})
    EXPECT_EQ(refusal(foreign(p), section), "needs forces: this input has none");
  EXPECT_EQ(refusal(foreign(p), "equilibrium"), "needs forces: this input has none");
}

// ---------------------------------------------------------------- equilibrium

TEST(EquilibriumSection, RecomputesTheCertificateAndSeesForeignForces) {
  Packing<2> p = disks({{{0, 0}}, {{1 - 1e-5, 0}}});
  p.links = {link(0, 1, 0)};
  AnalysisInput input = state_input(p, law_of(1), std::nullopt);
  input.state.certificate.equilibrated = false;  // what the file claims does not count
  Json json = equilibrium_section(input, {});
  EXPECT_TRUE(json["equilibrated"]);
  EXPECT_TRUE(std::isnan(json["pressure_error"].get<double>()));
  EXPECT_NEAR(json["law_residual"], 0, 1e-9);
  input.state.packing.links[0].normal_force = 0.5;  // not the law's force at this gap
  json = equilibrium_section(input, {});
  EXPECT_FALSE(json["equilibrated"]);
  EXPECT_DOUBLE_EQ(json["max_force"], 0.5);
  EXPECT_NEAR(json["law_residual"], 0.5, 1e-9);
}

// A ring of four around the cell: the mean |N| is 2, whatever the units.
TEST(EquilibriumSection, WithoutALawForcesBalanceOrAreSaidNotTo) {
  Packing<2> p = disks({{{0, 0}}, {{2, 0}}, {{4, 0}}, {{6, 0}}}, 1);
  p.cell = PeriodicCell<2>{{{8, 3}}};
  p.links = {link(0, 1, 2), link(1, 2, 2), link(2, 3, 2), link(3, 0, 2, 0, {1, 0})};
  for (Link<2>& l : p.links) l.gap = 0;
  Json report = analyze(foreign(p), {}, {"equilibrium"});
  EXPECT_EQ(report["equilibrium"].dump(), R"({"max_force":0.0,"max_moment":0.0,"force_scale":2.0})");
  EXPECT_FALSE(report.contains("warnings"));

  p.links[0].normal_force = 3, p.links[1].normal_force = 1;  // on grain 1 the force 2, of grains 0 and 2 it is 1
  report = analyze(foreign(p), {}, {"equilibrium"});
  EXPECT_DOUBLE_EQ(report["equilibrium"]["max_force"], 1);
  ASSERT_EQ(report["warnings"].size(), 1u);
  EXPECT_THAT(
      report["warnings"][0].get<std::string>(),
      HasSubstr("test: forces do not balance: 3 of 4 grains have a net force above 0.1 of the mean |N|, grain 1 "
                "one of 1;"));

  p.links[0].normal_force = p.links[1].normal_force = 2;
  p.links[2].tangential_force = 0.1;  // 0.05 of the mean, on an arm of half the diameter
  report = analyze(foreign(p), {}, {"equilibrium"});
  EXPECT_DOUBLE_EQ(report["equilibrium"]["max_force"], 0.05);
  EXPECT_DOUBLE_EQ(report["equilibrium"]["max_moment"], 0.025);
  EXPECT_FALSE(report.contains("warnings"));
}

// ---------------------------------------------------------------- forces

TEST(Forces, BinsAreAsWideAsAskedFor) {
  Packing<2> p = disks({{{0, 0}}, {{1, 0}}, {{2, 0}}});
  p.links = {link(0, 1, 0.3), link(1, 2, 0.9), link(0, 2, 0.6)};
  AnalysisOptions options;
  options.bin_width = 0.5;
  const Json histograms = forces_section(foreign(p), options)["histograms"];  // F1 is the mean, 0.6
  EXPECT_DOUBLE_EQ(histograms["N"]["edges"][1].get<double>() - histograms["N"]["edges"][0].get<double>(), 0.3);
  EXPECT_DOUBLE_EQ(histograms["N_over_mean"]["edges"][1].get<double>(), 1);
  EXPECT_DOUBLE_EQ(histograms["NT"]["edges"][0][1].get<double>() - histograms["NT"]["edges"][0][0].get<double>(), 0.3);
}

TEST(Forces, PopulationsOfTableVI) {
  Packing<2> p = disks({{{0, 0}}, {{1, 0}}, {{2, 0}}, {{3, 0}}});
  p.links = {link(0, 1, 0.3), link(1, 2, 0.4), link(2, 3, -0.6), link(3, 0, 5e-5), link(0, 2, 0.5e-4, 0.2)};
  const Json json = forces_section(state_input(p, law_of(1), 0.0), {});
  EXPECT_DOUBLE_EQ(json["z_plus"], 1);
  EXPECT_DOUBLE_EQ(json["z_minus"], 0.5);
  EXPECT_DOUBLE_EQ(json["z_zero"], 1);
  EXPECT_DOUBLE_EQ(json["N_plus"], 0.35);
  EXPECT_DOUBLE_EQ(json["N_plus_2"], std::sqrt((0.09 + 0.16) / 2));
  EXPECT_DOUBLE_EQ(json["N_minus"], 0.6);
  EXPECT_DOUBLE_EQ(json["N_minus_2"], 0.6);
  EXPECT_DOUBLE_EQ(json["zero_fraction"], 0.2);  // of the total force: the last link bears T
  EXPECT_DOUBLE_EQ(json["above_tenth_fraction"], 0.6);
}

TEST(Forces, AnglesOfTheCrossPatternAreAt60And120Degrees) {
  Packing<2> p = disks({{{0, 0}}, {{1, 0}}});
  const double t = std::sqrt(3.0) * (1 + 1e-9);  // just inside the bins [60, 62) and [118, 120)
  p.links = {link(0, 1, 1, t), link(0, 1, -1, t, {1, 0}), link(0, 1, 1, -t, {0, 1}), link(0, 1, 2, 0, {1, 1})};
  const Json angle = forces_section(state_input(p, law_of(1), 0.0), {})["histograms"]["angle"];
  EXPECT_DOUBLE_EQ(angle["density"][30], 2.0 / 4 / 2);
  EXPECT_DOUBLE_EQ(angle["density"][59], 1.0 / 4 / 2);
  EXPECT_DOUBLE_EQ(angle["density"][0], 1.0 / 4 / 2);
}

double integral(const Json& h) {
  double sum = 0;
  for (std::size_t k = 0; k < h["density"].size(); ++k)
    sum += h["density"][k].get<double>() * (h["edges"][k + 1].get<double>() - h["edges"][k].get<double>());
  return sum;
}

TEST(Forces, HistogramsAreDensities) {
  const Packing<2> p = oracle::random_packing(3, 50, 700, true);
  const Json json = forces_section(state_input(p, law_of(1), 0.0), {})["histograms"];
  for (const char* name : {"N", "N_over_mean", "angle", "F"}) EXPECT_NEAR(integral(json[name]), 1, 1e-12) << name;
  const Json& nt = json["NT"];
  double sum = 0;
  for (std::size_t x = 0; x < nt["density"].size(); ++x)
    for (std::size_t y = 0; y < nt["density"][x].size(); ++y)
      sum += nt["density"][x][y].get<double>() *
             (nt["edges"][0][x + 1].get<double>() - nt["edges"][0][x].get<double>()) *
             (nt["edges"][1][y + 1].get<double>() - nt["edges"][1][y].get<double>());
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(Histogram, CountsEveryValueInItsBin) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal(0, 3);
  std::vector<double> values(1000);
  for (double& v : values) v = normal(engine);
  const Histogram h = anchored_histogram(values, 0.25);
  for (std::size_t k = 0; k < h.density.size(); ++k) {
    int count = 0;
    for (const double v : values) count += v >= h.edges[k] && v < h.edges[k + 1];
    EXPECT_NEAR(h.density[k] * 0.25 * 1000, count, 1e-9);
  }
  EXPECT_LE(anchored_histogram({0, 1e9}, 1e-3).density.size(), static_cast<std::size_t>(kMostBins));
}

TEST(Histogram, PowerLawFitRecoversItsExponent) {
  for (const double q : {-1.0, 0.0, 0.7, 1.0, 2.0}) {
    std::vector<double> values;
    const int n = 2000;
    for (int k = 0; k < n; ++k) {  // quantiles of p ~ v^-q in [1e-3, 1e-2)
      const double u = (k + 0.5) / n, a = 1e-3, b = 1e-2, e = 1 - q;
      values.push_back(std::abs(e) < 1e-12 ? a * std::pow(b / a, u)
                                           : std::pow(std::pow(a, e) + u * (std::pow(b, e) - std::pow(a, e)), 1 / e));
    }
    values.push_back(1);  // outside
    const PowerLaw fit = fit_power_law(values, 1e-3, 1e-2);
    EXPECT_EQ(fit.count, n);
    EXPECT_NEAR(fit.exponent, q, 1e-3);
  }
  // The error is the spread of the estimate over samples.
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> unit(0, 1);
  double sum = 0, squares = 0, error = 0;
  const int samples = 400;
  for (int s = 0; s < samples; ++s) {
    std::vector<double> values;
    for (int k = 0; k < 200; ++k)
      values.push_back(
          std::pow(std::pow(1e-3, 0.3) + unit(engine) * (std::pow(1e-2, 0.3) - std::pow(1e-3, 0.3)), 1 / 0.3));
    const PowerLaw fit = fit_power_law(values, 1e-3, 1e-2);
    sum += fit.exponent, squares += fit.exponent * fit.exponent, error += fit.error / samples;
  }
  const double spread = std::sqrt(squares / samples - sum * sum / samples / samples);
  EXPECT_NEAR(spread / error, 1, 5 / std::sqrt(2.0 * samples));  // five standard errors of a spread
  EXPECT_TRUE(std::isnan(fit_power_law({2e-3, 3e-3}, 1e-3, 1e-2).exponent));
}

// ---------------------------------------------------------------- percolation

TEST(PercolationThreshold, WeakestLinkOfTheStrongestPath) {
  // Two chains around x, the stronger one interrupted by a weak link; one loop that does not wrap.
  Packing<2> p = disks({{{0, 0}}, {{1, 0}}, {{0, 1}}, {{1, 1}}});
  p.cell = PeriodicCell<2>{{{2, 4}}};
  p.links = {link(0, 1, 5),    link(1, 0, 0.02, 0, {1, 0}),
             link(2, 3, -0.3), link(3, 2, 0.05, 0.12, {1, 0}),
             link(0, 2, 7),    link(1, 3, 7)};
  const auto found = force_percolation(p);
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->force, 0.13);
  EXPECT_EQ(found->direction(), "x");
  p.links.erase(p.links.begin() + 3);
  p.links.erase(p.links.begin() + 1);
  EXPECT_FALSE(force_percolation(p));
}

TEST(PercolationThreshold, DiagonalLoopAndOwnImage) {
  Packing<2> p = disks({{{0, 0}}});
  p.cell = PeriodicCell<2>{{{1, 1}}};
  p.links = {link(0, 0, 1, 0, {0, 1}), link(0, 0, 2, 0, {1, -1})};
  EXPECT_EQ(force_percolation(p)->direction(), "xy");
  p.links.pop_back();
  EXPECT_EQ(force_percolation(p)->direction(), "y");
}

TEST(PercolationThreshold, EqualsFloodingReplicasOnRandomNetworks) {
  int wrapping = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const Packing<2> p = oracle::random_packing(seed, 6, 4 + seed % 6, true);
    const auto found = force_percolation(p);
    const int reach = 7;
    const auto whole = oracle::percolates(p, 0, reach);
    ASSERT_EQ(found.has_value(), whole[0] || whole[1]) << "seed " << seed;
    if (!found) continue;
    ++wrapping;
    const auto at = oracle::percolates(p, found->force, reach);
    const auto above = oracle::percolates(p, std::nextafter(found->force, 10.0), reach);
    EXPECT_EQ(at[0], found->winding[0] != 0) << "seed " << seed;
    EXPECT_EQ(at[1], found->winding[1] != 0) << "seed " << seed;
    EXPECT_FALSE(above[0] || above[1]) << "seed " << seed;
  }
  EXPECT_GT(wrapping, 30);
}

}  // namespace
}  // namespace isostat
