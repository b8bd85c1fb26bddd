// Disks at rest in containers: what the solver says of them against what the analysis does. Walls have no columns in G.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/load_input.hpp"
#include "analysis/network/force_scale.hpp"
#include "analysis/network/sections.hpp"
#include "analysis/report.hpp"
#include "analysis/rigidity/clusters.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "dem/disks/certificate.hpp"
#include "dem/disks/sample.hpp"
#include "dem/files/state_file.hpp"
#include "dem/input_error.hpp"
#include "dem/run/stages.hpp"
#include "dem/state/balance.hpp"
#include "tests/oracle/rational_rank.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

// Cohesionless; m g = 1 and T0 = sqrt(a / g).
State<Disks> settled(int grains, double width, double friction, std::uint64_t seed,
                     ContainerWalls walls = ContainerWalls::grains) {
  Scene scene;
  scene.grains.count = grains;
  scene.grains.solid_fraction = 0.4;
  scene.grains.diameter_min = 0.7;
  scene.law.attraction = 0;
  scene.law.normal_stiffness = 1e4;
  scene.law.friction = friction;
  scene.law.rolling = false;
  scene.step.fraction = 0.1;
  scene.gravity = 1;
  scene.container.shape = ContainerShape::box;
  scene.container.wall_size = 0.5, scene.container.walls = walls;
  scene.container.width = width, scene.container.height = 12;
  scene.finish.method = Finish::drag, scene.finish.quiet_time = 5;
  scene.stages.resize(1);
  scene.stages[0].max_time = 4000;
  State<Disks> s = initial_disks(scene, seed);
  const RunOutcome outcome = run_stages(s, {}, {});
  EXPECT_TRUE(outcome.all_met()) << outcome.stages.back().reason;
  return s;
}

AnalysisInput input_of(const State<Disks>& s) {
  const TemporaryFolder folder;
  const std::string path = folder / "state.h5";
  write_state(s, path);
  return load_input(path, {});
}

TEST(PutFreeFirst, KeepsTheOrderAndTheLinks) {
  Packing<2> p;
  p.bodies.resize(4);
  p.bodies.id = {10, 11, 12, 13};
  p.bodies.radius = {1, 2, 3, 4};
  p.part = {GrainPart::wall, GrainPart::free, GrainPart::lid, GrainPart::free};
  p.links.resize(2);
  p.links[0].i = 0, p.links[0].j = 1;
  p.links[1].i = 2, p.links[1].j = 3;
  EXPECT_THROW(LinkNetwork{p}, std::invalid_argument);
  put_free_first(p);
  EXPECT_EQ(p.bodies.id, (std::vector<std::int64_t>{11, 13, 10, 12}));
  EXPECT_EQ(p.bodies.radius, (std::vector<double>{2, 4, 1, 3}));
  EXPECT_EQ(p.part, (std::vector{GrainPart::free, GrainPart::free, GrainPart::wall, GrainPart::lid}));
  EXPECT_EQ(p.links[0].i, 2);
  EXPECT_EQ(p.links[0].j, 0);
  EXPECT_EQ(p.links[1].i, 3);
  EXPECT_EQ(p.links[1].j, 1);
  EXPECT_EQ(LinkNetwork(p).free, 2);
}

class BedOfDisks : public ::testing::TestWithParam<ContainerWalls> {};
INSTANTIATE_TEST_SUITE_P(Walls, BedOfDisks, ::testing::Values(ContainerWalls::grains, ContainerWalls::smooth));

TEST_P(BedOfDisks, IsAnalysedAsTheSolverSeesIt) {
  const State<Disks> s = settled(40, 8, 0.5, 3, GetParam());
  const AnalysisInput input = input_of(s);
  const Json report = analyze(input, {}, {});

  const Json& equilibrium = report.at("equilibrium");
  EXPECT_EQ(equilibrium.at("max_force").get<double>(), s.certificate.max_force);
  EXPECT_EQ(equilibrium.at("max_moment").get<double>(), s.certificate.max_moment);
  EXPECT_EQ(equilibrium.at("kinetic_energy_per_grain").get<double>(), s.certificate.kinetic_energy_per_grain);
  EXPECT_TRUE(equilibrium.at("equilibrated").get<bool>());
  EXPECT_LT(equilibrium.at("law_residual").get<double>(), 1e-9);
  const ForceReading reading = read_forces(input);
  EXPECT_EQ(reading.scale, s.certificate.force_scale);
  EXPECT_FALSE(reading.cohesive);

  // Every grain touches something; loads of the floor make contacts with walls.
  const Json& counts = report.at("counts");
  EXPECT_EQ(counts.at("grains"), 40);
  EXPECT_EQ(counts.at("solid_fraction"), nullptr);
  const auto contacts = counts.at("contacts").get<double>(),
             with_walls = counts.at("contacts_with_walls").get<double>();
  EXPECT_GT(with_walls, 8);
  EXPECT_LT(with_walls, contacts);
  EXPECT_NEAR(counts.at("z").get<double>(), (2 * contacts - with_walls) / 40, 1e-12);
  double mean = 0, all = 0;
  for (std::size_t k = 0; k < counts.at("x").size(); ++k)
    mean += static_cast<double>(k) * counts.at("x")[k].get<double>(), all += counts.at("x")[k].get<double>();
  EXPECT_NEAR(all, 1, 1e-12);
  EXPECT_NEAR(mean, counts.at("z_star").get<double>(), 1e-12);
  EXPECT_LT(counts.at("rattlers").get<int>(), 10);
  EXPECT_NEAR(report.at("forces").at("z_plus").get<double>(), (2 * contacts - with_walls) / 40, 0.3);
  EXPECT_EQ(report.at("units").at("force"), "m a / T0^2");

  const Json& rigidity = report.at("rigidity");
  EXPECT_EQ(rigidity.at("N_f"), 3 * 40);
  EXPECT_EQ(rigidity.at("trivial"), 0);
  EXPECT_EQ(rigidity.at("H").get<int>() + rigidity.at("N_f").get<int>(),
            rigidity.at("K").get<int>() + rigidity.at("M").get<int>());
  EXPECT_TRUE(rigidity.at("certificate").at("certified").get<bool>());
  EXPECT_TRUE(report.at("stiffness").at("positive_definite").is_boolean());
  EXPECT_EQ(report.at("stiffness").at("inertia")[1].get<int>(), rigidity.at("K").get<int>());
  for (const char* absent : {"stress", "moduli", "percolation", "scattering", "dacf"})
    EXPECT_FALSE(report.contains(absent)) << absent;
  EXPECT_THROW(analyze(input, {}, {"moduli"}), InputError);
  EXPECT_EQ(counts_tables(input, {})[0].rows.size(), 40u);
}

// G^T f of the free grains is what the contacts carry: minus the weights.
TEST_P(BedOfDisks, ItsForcesBalanceTheWeightsInG) {
  const State<Disks> s = settled(30, 6, 0.5, 5, GetParam());
  const AnalysisInput input = input_of(s);
  const LinkNetwork network = input.network();
  const RigidityMatrix g = rigidity_matrix(network, NetworkLaw::rolling, false);
  ASSERT_EQ(g.columns(), 3 * 30);
  const std::vector<double> loads = g.body_forces(link_forces(network, g));
  const Bodies<2>& b = input.packing().bodies;
  for (std::size_t k = 0; k < 30; ++k) {
    EXPECT_NEAR(loads[3 * k], 0, 1e-3);
    EXPECT_NEAR(loads[3 * k + 1], b.mass[k], 1e-3);
  }
}

// Under every law the rank is the one of elimination over the rationals, from the packing in the solver's order.
TEST(FewDisksInABox, HaveTheRankOfTheRationals) {
  for (const double friction : {0.0, 0.5}) {
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
      const auto walls = seed < 4 ? ContainerWalls::grains : ContainerWalls::smooth;
      const State<Disks> s = settled(6, 3.3, friction, seed, walls);
      Packing<2> p = s.packing;
      for (std::size_t k = 0; k < p.links.size(); ++k)  // other kinds, too
        if (k % 4 == 3) p.links[k].kind = k % 8 == 3 ? LinkKind::sliding : LinkKind::both_yielded;
      const Packing<2> unsorted = p;
      put_free_first(p);
      for (const NetworkLaw law : {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling}) {
        const ExactRank r = exact_rank(p, law, false);
        EXPECT_EQ(r.dofs, 6 * (law == NetworkLaw::frictionless ? 2 : 3));
        EXPECT_EQ(r.rank, rational_rank(unsorted, law, false)) << friction << " " << seed;
        EXPECT_EQ(r.trivial, 0);
        EXPECT_TRUE(r.certified);
        // What is hyperstatic is so inside of clusters, of which the walls are one body.
        std::int64_t inside = 0;
        for (const RigidCluster& c : rigid_clusters(p, law, false).clusters) inside += c.hyperstatic;
        EXPECT_EQ(inside, r.hyperstatic);
      }
    }
  }
}

// Frictionless disks under weight stand still: each on as many contacts as it has coordinates, or more.
TEST(FewDisksInABox, WithoutFrictionNothingButRattlersMoves) {
  const State<Disks> s = settled(6, 3.3, 0, 4);
  const AnalysisInput input = input_of(s);
  const Json rigidity = analyze(input, {}, {"rigidity"}).at("rigidity");
  EXPECT_EQ(rigidity.at("mechanisms"), 0);
  EXPECT_EQ(rigidity.at("K"), 0);
}

// A disk on two of a floor stands; a second one that touches a single wall disk turns about it.
TEST(RigidClusters, TheWallsAreOneBody) {
  Packing<2> p;
  p.bodies.resize(6);
  p.bodies.id = {0, 1, 2, 3, 4, 5};
  p.bodies.position = {{{0.5, 0.75}}, {{2.5, 0.75}}, {{0, 0}}, {{1, 0}}, {{2, 0}}, {{3, 0}}};
  p.bodies.radius.assign(6, 0.5);
  p.part = {GrainPart::free, GrainPart::free, GrainPart::wall, GrainPart::wall, GrainPart::wall, GrainPart::wall};
  const auto join = [&](std::int32_t i, std::int32_t j) {
    Link<2> l;
    l.i = i, l.j = j;
    p.links.push_back(l);
  };
  join(0, 2), join(0, 3), join(1, 4), join(5, 1);
  for (const NetworkLaw law : {NetworkLaw::frictionless, NetworkLaw::friction}) {
    const RigidClusters both = rigid_clusters(p, law, false);
    ASSERT_EQ(both.clusters.size(), 1u);
    EXPECT_EQ(both.clusters[0].grains, 2);
    EXPECT_EQ(both.clusters[0].links, 4);
    EXPECT_EQ(both.clusters[0].hyperstatic, law == NetworkLaw::frictionless ? 0 : 2);
  }
  p.links.pop_back();
  const RigidClusters one = rigid_clusters(p, NetworkLaw::friction, false);
  ASSERT_EQ(one.clusters.size(), 1u);
  EXPECT_EQ(one.clusters[0].grains, 1);
  EXPECT_EQ(one.clusters[0].hyperstatic, 1);
  EXPECT_EQ(one.cluster_of_grain[1], -1);
  EXPECT_EQ(exact_rank(p, NetworkLaw::friction, false).mechanisms, 1);
  const RigidClusters links = rigid_clusters(p, NetworkLaw::frictionless, false);
  ASSERT_EQ(links.clusters.size(), 2u);  // the single link is one of its own
  EXPECT_EQ(links.cluster_of_link[0], links.cluster_of_link[1]);
  EXPECT_NE(links.cluster_of_link[2], links.cluster_of_link[0]);
}

}  // namespace
}  // namespace isostat
