// A packing of spheres in a tilted cell, against the same packing described otherwise: cells whose tilts differ by L1
// are the same, and a tilt of L1/2 is undone by an upright cell of two copies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/stiffness/sphere_stiffness.hpp"
#include "dem/spheres/engine.hpp"
#include "dem/state/balance_3d.hpp"
#include "dem/state/link_ends.hpp"
#include "dem/state/touching.hpp"
#include "tests/support/sphere_states.hpp"
#include "tests/support/tilted_packings.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

// Sheared for a while: contacts with stretched springs in a cell that leans.
AnalysisInput sheared_packing() {
  oracle::RandomSpheres r;
  r.count = 60, r.room = 0.33, r.speed = 0.2;
  r.law.attraction = r.law.attraction_range = 0;
  r.law.rolling_friction = r.law.rolling_stiffness = 0;
  State<Spheres> s = oracle::random_state(r);
  CellControl<3> control;
  control.shear_rate = 2;
  Solver solver(s, control);
  solver.set_drag(5);
  solver.run(160);
  solver.snapshot(s);
  EXPECT_GT(s.packing.cell->tilt, 0.2 * s.packing.cell->length[1]);
  EXPECT_GT(s.packing.links.size(), 100u);
  s.memory = {};
  s.scene.system = SceneSystem::spheres;
  AnalysisInput input;
  input.path = "test", input.links_given = true;
  input.packing_3d = s.packing;
  static_cast<Packing<3>&>(s.packing) = {};  // as load_input() does
  input.spheres_state = std::move(s);
  return input;
}

AnalysisInput described_by(AnalysisInput input, int turns) {
  turn_description(*input.packing_3d, turns);
  return input;
}

TEST(TiltedSpheres, EverySectionSaysTheSameOfEveryEquivalentTilt) {
  const AnalysisInput input = sheared_packing();
  const std::vector<std::string> only{"counts",   "equilibrium", "stress", "forces", "percolation", "rigidity",
                                      "clusters", "stiffness",   "moduli", "modes",  "bases",       "rdf"};
  for (const bool cell_free : {false, true}) {
    AnalysisOptions options;
    options.modes = 12, options.cell_free = cell_free;
    Json reports[3];
    for (const int turns : {0, 1, -2}) {
      Json report = analyze(described_by(input, turns), options, only);
      report["percolation"].erase("direction");
      // Spans are told along edges, and a basis is one of many: its size and what it says of the forces are the same.
      if (report["clusters"].contains("list"))
        for (Json& cluster : report["clusters"]["list"]) cluster.erase("spans");
      if (report["clusters"].contains("spanning")) report["clusters"].erase("spanning");
      Json& bases = report["bases"];
      for (auto at = bases.begin(); at != bases.end();)
        at = at->is_array() || at->is_object() ? bases.erase(at) : std::next(at);
      reports[turns < 0 ? 2 : turns] = std::move(report);
    }
    EXPECT_GT(reports[0]["rigidity"]["M"], 200);
    for (int k = 1; k < 3; ++k)
      for (const std::string& section : only)
        if (section != "rdf") expect_near(reports[0].at(section), reports[k].at(section), 1e-7, section);
    // The nearest faces of a cell that leans more are nearer: as far as both tell.
    for (int k = 1; k < 3; ++k) {
      const Json &near = reports[k]["rdf"]["g"], &far = reports[0]["rdf"]["g"];
      ASSERT_LE(near.size(), far.size());
      for (std::size_t b = 0; b < near.size(); ++b) EXPECT_NEAR(near[b].get<double>(), far[b].get<double>(), 1e-9);
      EXPECT_GT(near.size(), 20u);
    }
  }
}

TEST(TiltedSpheres, ContactsAreThoseOfTheCellOfTwoCopies) {
  const Packing<3> p = half_tilted(*sheared_packing().packing_3d), copies = two_copies(p);
  ASSERT_GT(p.links.size(), 100u);
  const std::vector<Link<3>> expected = touching_links(copies, 0.0);
  EXPECT_EQ(expected.size(), 2 * p.links.size());
  for (std::size_t l = 0; l < copies.links.size(); ++l) {
    const LinkEnds<3> twin = ends(copies, copies.links[l]), own = ends(p, p.links[l / 2]);
    EXPECT_LT(norm(twin.branch - own.branch), 1e-12);
  }
  // Rows of G see branch vectors alone: the same elastic moduli.
  const UniformStiffness k{1, 0.7, 0, 0};
  const SphereModuli one = elastic_moduli(p, NetworkLaw::friction, by_link(p, k)),
                     two = elastic_moduli(copies, NetworkLaw::friction, by_link(copies, k));
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = 0; b < 6; ++b) EXPECT_NEAR(one[a][b], two[a][b], 1e-8 * std::abs(one[0][0]));
  // A motion of one copy is one of both.
  for (const NetworkLaw law : {NetworkLaw::frictionless, NetworkLaw::friction}) {
    const ExactRank single = exact_rank(p, law, true), both = exact_rank(copies, law, true);
    EXPECT_GE(both.floppy, single.floppy);
    EXPECT_EQ(both.rows, 2 * single.rows);
    EXPECT_TRUE(single.certified && both.certified);
  }
}

TEST(TiltedSpheres, PrincipalStressesAndFabric) {
  const AnalysisInput input = sheared_packing();
  const Json stress = analyze(input, {}, {"stress"}).at("stress");
  const auto at = [&](const char* key, int row, int column) { return stress.at(key)[row][column].get<double>(); };
  for (int k = 0; k < 3; ++k) {  // S d = s d
    const double value = stress.at("principal")[k].get<double>();
    double square = 0;
    for (int a = 0; a < 3; ++a) {
      double sum = 0;
      for (int b = 0; b < 3; ++b) sum += 0.5 * (at("tensor", a, b) + at("tensor", b, a)) * at("directions", k, b);
      EXPECT_NEAR(sum, value * at("directions", k, a), 1e-11 * std::abs(stress["principal"][0].get<double>()));
      square += at("directions", k, a) * at("directions", k, a);
    }
    EXPECT_NEAR(square, 1, 1e-13);
  }
  // Shear to the right pushes along the falling diagonal: sigma_12 < 0.
  EXPECT_LT(at("tensor", 0, 1), 0);
  EXPECT_LT(at("directions", 0, 0) * at("directions", 0, 1), 0);
  // Both tensors are sums over links, each once.
  StressTensor3 sum{}, normals{};
  const auto links = static_cast<double>(input.packing_3d->links.size());
  for (const Link<3>& l : input.packing_3d->links) {
    const LinkEnds<3> where = ends<3>(*input.packing_3d, l);
    const Vec3 n = where.branch / norm(where.branch);
    for (int a = 0; a < 3; ++a) normals[static_cast<std::size_t>(a)] += (n[a] / links) * n;
    const Vec3 f = (l.normal_force / norm(where.branch)) * where.branch + l.tangential_force;
    for (int a = 0; a < 3; ++a) sum[static_cast<std::size_t>(a)] += f[a] * where.branch;
  }
  const Bodies<3>& b = input.packing_3d->bodies;
  for (std::size_t k = 0; k < b.size(); ++k)
    for (int a = 0; a < 3; ++a) sum[static_cast<std::size_t>(a)] += b.mass[k] * b.velocity[k][a] * b.velocity[k];
  for (int a = 0; a < 3; ++a)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(sum[static_cast<std::size_t>(a)][c] / input.packing_3d->cell->measure(), at("tensor", a, c), 1e-10);
  for (int a = 0; a < 3; ++a)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(stress["fabric"]["tensor"][a][c].get<double>(), normals[static_cast<std::size_t>(a)][c], 1e-13);
}

}  // namespace
}  // namespace isostat
