// The report of packings of spheres: what it holds, what it refuses, and closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "analysis/network/percolation.hpp"
#include "analysis/report.hpp"
#include "analysis/rigidity/sections.hpp"
#include "analysis/structure/radial_distribution.hpp"
#include "dem/input_error.hpp"
#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"
#include "tests/support/random_spheres.hpp"
#include "tests/support/refusal.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
using oracle::refusal;

AnalysisInput input_of(Packing<3> p) {
  AnalysisInput input;
  input.path = "test";
  static_cast<Packing<3>&>(input.packing_3d.emplace()) = std::move(p);
  input.links_given = true;
  return input;
}

// Touching spheres of diameter 1 on a simple cubic lattice under the pressure 2: each contact bears 2.
Packing<3> pressed_lattice(int n) {
  Packing<3> p;
  p.cell = PeriodicCell<3>{{{1.0 * n, 1.0 * n, 1.0 * n}}};
  p.bodies.resize(idx(n * n * n));
  const auto at = [n](int x, int y, int z) { return (z * n + y) * n + x; };
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const auto i = idx(at(x, y, z));
        p.bodies.id[i] = at(x, y, z), p.bodies.radius[i] = 0.5, p.bodies.mass[i] = 1, p.bodies.inertia[i] = 0.1;
        p.bodies.position[i] = {{x + 0.5, y + 0.5, z + 0.5}};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          std::array<int, 3> to{x, y, z};
          Link<3> link;
          link.i = static_cast<std::int32_t>(i);
          if (++to[axis] == n) to[axis] = 0, link.shift[axis] = 1;
          link.j = at(to[0], to[1], to[2]);
          link.normal_force = 2;
          p.links.push_back(link);
        }
      }
  return p;
}

TEST(SphereSections, LatticeUnderPressure) {
  const AnalysisInput input = input_of(pressed_lattice(3));
  const Json report = analyze(input, {}, {});
  EXPECT_EQ(report["counts"]["z"], 6.0);
  EXPECT_EQ(report["counts"]["rattlers"], 0);
  EXPECT_NEAR(report["counts"]["solid_fraction"].get<double>(), M_PI / 6, 1e-12);
  EXPECT_EQ(report["counts"]["solid_fraction_3d"], report["counts"]["solid_fraction"]);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      EXPECT_NEAR(report["stress"]["tensor"][a][b].get<double>(), a == b ? 2 : 0, 1e-12);
  EXPECT_NEAR(report["stress"]["pressure"].get<double>(), 2, 1e-12);
  EXPECT_NEAR(report["stress"]["rumpf_force"].get<double>(), 2, 1e-12);
  EXPECT_NEAR(report["stress"]["mean_normal_force"].get<double>(), 2, 1e-12);
  EXPECT_NEAR(report["stress"]["mean_force_diameter"].get<double>(), 2, 1e-12);
  EXPECT_NEAR(report["equilibrium"]["max_force"].get<double>(), 0, 1e-12);
  EXPECT_NEAR(report["equilibrium"]["max_moment"].get<double>(), 0, 1e-12);
  EXPECT_EQ(report["equilibrium"]["force_scale"], 2.0);
  EXPECT_EQ(report["forces"]["z_plus"], 6.0);
  EXPECT_EQ(report["percolation"]["F_perc"], 2.0);
  EXPECT_EQ(report["rigidity"]["N_f"], 27 * 6);
  EXPECT_EQ(report["rigidity"]["M"], 81 * 3);
  EXPECT_EQ(report["rigidity"]["trivial"], 3);
  EXPECT_EQ(report["stiffness"]["positive_definite"], report["rigidity"]["mechanisms"] == 0);
  EXPECT_EQ(report["stiffness"]["inertia"][1], report["rigidity"]["K"]);
  EXPECT_EQ(report["stiffness"]["stiffness"]["normal"], 1.0);
  EXPECT_NEAR(report["moduli"]["tensor"][0][0].get<double>(), 1, 1e-10);
  EXPECT_NEAR(report["moduli"]["tensor"][3][3].get<double>(), 0.5, 1e-10);
  EXPECT_NEAR(report["moduli"]["bulk"].get<double>(), 1.0 / 3, 1e-10);
  EXPECT_EQ(report["rdf"]["g"].size() + 1, report["rdf"]["r_edges"].size());
  for (const char* absent : {"modes", "bases", "pores", "scattering", "dacf", "beams"})
    EXPECT_FALSE(report.contains(absent));
  EXPECT_FALSE(analyze(input, {}, {"modes"})["modes"]["omega"].empty());
  EXPECT_FALSE(analyze(input, {}, {"bases"})["bases"]["self_stress"]["list"].empty());
}

TEST(SphereSections, ForcesThatDoNotBalanceAreSaidNotTo) {
  Packing<3> p = pressed_lattice(3);
  EXPECT_FALSE(analyze(input_of(p), {}, {"equilibrium"}).contains("warnings"));
  p.links[0].normal_force = 2.5;
  const Json report = analyze(input_of(p), {}, {"equilibrium"});
  const double mean = 2 + 0.5 / 81;
  EXPECT_DOUBLE_EQ(report["equilibrium"]["force_scale"], mean);
  EXPECT_NEAR(report["equilibrium"]["max_force"].get<double>(), 0.5 / mean, 1e-12);
  ASSERT_EQ(report["warnings"].size(), 1u);
  EXPECT_NE(report["warnings"][0].get<std::string>().find("2 of 27 grains"), std::string::npos);
}

TEST(SphereSections, Refusals) {
  Packing<3> p = pressed_lattice(2);
  for (const char* section : {"pores", "scattering", "dacf"})
    EXPECT_NE(refusal(input_of(p), section).find("in the plane; this one is in 3D"), std::string::npos) << section;
  AnalysisOptions prestress;
  prestress.prestress = true;
  EXPECT_EQ(refusal(input_of(p), "modes", prestress), "--prestress is for packings in the plane");
  for (Link<3>& link : p.links) link.normal_force = 0;
  for (const char* section : {"equilibrium", "stress", "forces", "percolation"})
    EXPECT_EQ(refusal(input_of(p), section), "needs forces: this input has none") << section;
  p.cell.reset();
  EXPECT_NE(refusal(input_of(p), "rdf").find("needs a periodic cell"), std::string::npos);
  AnalysisInput plane;
  plane.state.packing.bodies.resize(1);
  EXPECT_EQ(refusal(plane, "rdf"), "is defined for spheres; this packing is in the plane");
}

TEST(SphereSections, StiffnessOptionIsUsed) {
  AnalysisOptions options;
  options.stiffness = {5, 3};
  const Json report = analyze(input_of(pressed_lattice(2)), options, {"stiffness", "moduli"});
  EXPECT_EQ(report["moduli"]["stiffness"]["tangential"], 3.0);
  EXPECT_NEAR(report["moduli"]["tensor"][0][0].get<double>(), 5, 1e-10);
  EXPECT_NEAR(report["moduli"]["tensor"][5][5].get<double>(), 1.5, 1e-10);
}

TEST(SphereSections, ClustersAndTheirTables) {
  const AnalysisInput input = input_of(pressed_lattice(2));
  const Json clusters = analyze(input, {}, {"clusters"})["clusters"];
  EXPECT_TRUE(clusters["list"].empty() || clusters["list"][0]["spans"].size() == 3);
  const auto tables = clusters_tables(input, {});
  EXPECT_EQ(tables[1].columns, (std::vector<std::string>{"i", "j", "s1", "s2", "s3", "cluster"}));
  EXPECT_EQ(tables[1].rows.size(), input.packing_3d->links.size());
  AnalysisOptions rolling;
  rolling.law = NetworkLaw::rolling;
  const Json glued = analyze(input, rolling, {"clusters"})["clusters"];
  EXPECT_EQ(glued["sizes"], Json::array({8}));
  EXPECT_EQ(glued["list"][0]["spans"], Json::array({true, true, true}));
}

TEST(SphereSections, PercolationKnowsThreeAxes) {
  Packing<3> p = pressed_lattice(2);
  for (std::size_t l = 0; l < p.links.size(); ++l) p.links[l].normal_force = l % 3 == 2 ? 5 : 1;
  const auto found = force_percolation(p);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->force, 5);
  EXPECT_EQ(found->direction(), "z");
}

// All pairs and images, counted one by one.
void expect_all_pairs(double tilt, double r_max) {
  RandomSpheres o;
  o.size = {6, 5, 4}, o.tilt = tilt;
  const Packing<3> p = random_spheres(o);
  const double bin = 0.25;
  const RadialDistribution found = radial_distribution(p, r_max, bin);
  std::vector<double> pairs(8, 0);
  for (std::size_t i = 0; i < p.bodies.size(); ++i)
    for (std::size_t j = i + 1; j < p.bodies.size(); ++j) {
      Vec3 d = p.bodies.position[j] - p.bodies.position[i];
      d += p.cell->offset(p.cell->nearest_image(d));
      if (norm(d) < r_max) pairs[static_cast<std::size_t>(norm(d) / bin)] += 1;
    }
  const double n = static_cast<double>(p.bodies.size()), volume = p.cell->measure();
  ASSERT_EQ(found.g.size(), static_cast<std::size_t>(r_max / bin));
  for (std::size_t k = 0; k < found.g.size(); ++k) {
    const double low = static_cast<double>(k) * bin, high = low + bin;
    const double shell = 4.0 / 3.0 * M_PI * (std::pow(high, 3) - std::pow(low, 3));
    EXPECT_NEAR(found.g[k], pairs[k] / (0.5 * n * (n - 1) / volume * shell), 1e-9);
  }
}

TEST(RadialDistribution, EqualsAllPairs) {
  expect_all_pairs(0, 2);
  for (const double tilt : {1.75, -3.0, 2.5, 8.0}) expect_all_pairs(tilt, tilt > 5 ? 1.5 : 2);
}

}  // namespace
}  // namespace isostat
