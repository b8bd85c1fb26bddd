// A packing in a tilted cell, against the same packing described upright: cells whose tilts differ by L1 are the same,
// and a tilt of L1/2 is undone by an upright cell of two copies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report.hpp"
#include "analysis/rigidity/clusters.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/stiffness/bases.hpp"
#include "analysis/stiffness/moduli.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "dem/disks/certificate.hpp"
#include "dem/disks/engine.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/link_ends.hpp"
#include "dem/state/touching.hpp"
#include "tests/support/disk_states.hpp"
#include "tests/support/tilted_packings.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

// Sheared for a while: contacts with stretched springs in a cell that leans.
AnalysisInput sheared_packing() {
  oracle::RandomDisks r;
  r.count = 60, r.law = oracle::soft_law(), r.squeeze = 0.77, r.speed = 0.2;
  r.law.attraction = 0;
  AnalysisInput input;
  input.path = "test", input.links_given = true;
  State<Disks>& s = input.state;
  s = oracle::random_state(r);
  CellControl<2> control;
  control.shear_rate = 1;
  Solver solver(s, control);
  solver.set_drag(5);
  solver.run(160);
  solver.snapshot(s);
  EXPECT_GT(s.packing.cell->tilt, 0.2 * s.packing.cell->length[1]);
  EXPECT_GT(s.packing.links.size(), 60u);
  s.memory = {};
  return input;
}

AnalysisInput described_by(AnalysisInput input, int turns) {
  turn_description<2>(input.state.packing, turns);
  return input;
}

TEST(TiltedPacking, EverySectionSaysTheSameOfEveryEquivalentTilt) {
  const AnalysisInput input = sheared_packing();
  const std::vector<std::string> only{"counts",    "equilibrium", "stress", "forces",     "percolation", "rigidity",
                                      "stiffness", "moduli",      "pores",  "scattering", "dacf"};
  AnalysisOptions options;
  options.k_max = 20;
  Json reports[3];
  for (const int turns : {0, 1, -2}) {
    Json report = analyze(described_by(input, turns), options, only);
    Json& pores = report["pores"]["list"];  // in the order of their size: places are those of another cell
    for (Json& pore : pores) pore.erase("x"), pore.erase("y"), pore.erase("along");
    std::sort(pores.begin(), pores.end(),
              [](const Json& a, const Json& b) { return a.value("area", 1e9) < b.value("area", 1e9); });
    report["percolation"].erase("direction");
    for (const char* curve : {"scattering", "dacf"})  // fits amplify the last digits
      for (const char* fit : {"fit", "power", "mass_radius"}) report[curve].erase(fit);
    reports[turns < 0 ? 2 : turns] = std::move(report);
  }
  for (int k = 1; k < 3; ++k)
    for (const std::string& section : only) {
      const bool transformed = section == "scattering" || section == "dacf";  // on another grid
      expect_near(reports[0].at(section), reports[k].at(section), transformed ? 1e-5 : 1e-7, section);
    }
}

// What rests on null spaces, on connected parts and on links alone. Names of lattice vectors are not compared: (0, 1)
// of one description is (-turns, 1) of the other.
TEST(TiltedPacking, NetworkSectionsSayTheSameOfEveryEquivalentTilt) {
  const AnalysisInput input = sheared_packing();
  const std::vector<std::string> only{"clusters", "loops", "modes", "bases", "stressed", "two_contacts"};
  AnalysisOptions options;
  options.modes = std::nullopt;
  options.density = DensityOptions{.bins = 20, .vectors = 3};
  options.most_vectors = 10000;
  for (const NetworkLaw law : {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling}) {
    options.law = law;
    Json reports[3];
    for (const int turns : {0, 1, -2}) {
      Json report = analyze(described_by(input, turns), options, only);
      for (const char* section : {"clusters", "stressed"})
        for (Json& cluster : report[section]["list"]) cluster.erase("spans");
      for (const char* basis : {"floppy_modes", "self_stress"})
        report["bases"][basis].erase("list");  // any basis is one
      report["bases"]["split"].erase("residual"), report["bases"]["split"].erase("load");
      reports[turns < 0 ? 2 : turns] = std::move(report);
    }
    EXPECT_GT(reports[0]["modes"]["omega"].size(), 60u);
    EXPECT_GT(reports[0]["bases"]["floppy_modes"]["of"], 2);
    for (int k = 1; k < 3; ++k)
      for (const std::string& section : only)
        expect_near(reports[0].at(section), reports[k].at(section), 1e-6, section);
  }
}

// The two null spaces are those of the other description: its floppy modes move none of our links, its states of
// self-stress load none of our grains. Columns (and strains of the cell) and rows are in the same order.
TEST(TiltedPacking, NullSpacesAreThoseOfEveryEquivalentTilt) {
  const AnalysisInput input = sheared_packing();
  for (const NetworkLaw law : {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling})
    for (const bool cell_free : {false, true}) {
      const RigidityMatrix g = rigidity_matrix(input.network(), law, cell_free);
      const ExactRank rank = exact_rank(input.network(), law, cell_free);
      for (const int turns : {1, -2}) {
        const AnalysisInput other = described_by(input, turns);
        const auto floppy = floppy_modes(other.network(), law, cell_free, 10000),
                   stress = self_stress_states(other.network(), law, cell_free, 10000);
        EXPECT_EQ(static_cast<std::int64_t>(floppy.size()), rank.floppy);
        EXPECT_EQ(static_cast<std::int64_t>(stress.size()), rank.hyperstatic);
        double moved = 0, loaded = 0;
        for (const NullVector& u : floppy)
          for (const double v : g.link_velocities(u.value)) moved = std::max(moved, std::abs(v));
        for (const NullVector& f : stress)
          for (const double v : g.body_forces(f.value)) loaded = std::max(loaded, std::abs(v));
        EXPECT_LT(moved, 1e-9);
        EXPECT_LT(loaded, 1e-8);
      }
      const RigidClusters own = rigid_clusters(input.network(), law, cell_free),
                          turned = rigid_clusters(described_by(input, 1).network(), law, cell_free);
      EXPECT_EQ(own.cluster_of_grain, turned.cluster_of_grain);
      EXPECT_EQ(own.cluster_of_link, turned.cluster_of_link);
    }
}

TEST(TiltedPacking, ContactsAreThoseOfTheCellOfTwoCopies) {
  const Packing<2> p = half_tilted(sheared_packing().state.packing), copies = two_copies(p);
  ASSERT_GT(p.links.size(), 60u);
  const std::vector<Link<2>> expected = touching_links(copies, 0.0);
  EXPECT_EQ(expected.size(), 2 * p.links.size());
  for (std::size_t l = 0; l < copies.links.size(); ++l) {
    const LinkEnds<2> twin = ends(copies, copies.links[l]), own = ends(p, p.links[l / 2]);
    EXPECT_LT(norm(twin.branch - own.branch), 1e-12);
  }
  // Rows of G see branch vectors alone: the same elastic moduli, and as many constraints.
  const Moduli one = elastic_moduli(p, NetworkLaw::rolling, sheared_packing().state.law),
               two = elastic_moduli(copies, NetworkLaw::rolling, sheared_packing().state.law);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) EXPECT_NEAR(one[a][b], two[a][b], 1e-8 * std::abs(one[0][0]));
  EXPECT_EQ(exact_rank(p, NetworkLaw::rolling, true).dofs, 3 * static_cast<std::int64_t>(p.bodies.size()) + 2);
}

// The upright cell of two copies is the same packing, described by another lattice: whatever is said of a grain, a
// link, an area or a distance is the same. (Null spaces are not: two copies may move against each other.)
TEST(TiltedPacking, SectionsAreThoseOfTheCellOfTwoCopies) {
  AnalysisInput one = sheared_packing();
  Packing<2>& p = one.state.packing;
  p = half_tilted(p);
  for (std::size_t l = 0; l < p.links.size(); ++l) {  // forces of both signs, of no equilibrium
    p.links[l].normal_force = std::sin(1.0 + 0.7 * static_cast<double>(l));
    p.links[l].tangential_force = 0.1 * std::cos(2.3 * static_cast<double>(l));
    p.links[l].gap = frame(ends(p, p.links[l])).distance - p.bodies.radius[static_cast<std::size_t>(p.links[l].i)] -
                     p.bodies.radius[static_cast<std::size_t>(p.links[l].j)];
  }
  for (std::size_t k = 0; k < p.bodies.size(); ++k)
    p.bodies.mass[k] = 1, p.bodies.inertia[k] = 1, p.bodies.velocity[k] = {}, p.bodies.spin[k] = 0;
  AnalysisInput two = one;
  two.state.packing = two_copies(p);
  const std::vector<std::string> only{"counts", "stress", "forces", "percolation", "two_contacts", "pores", "dacf"};
  AnalysisOptions options;
  Json a = analyze(one, options, only), b = analyze(two, options, only);
  for (const char* key : {"grains", "contacts", "distant", "unloaded_contacts", "rattlers", "floating"}) {
    EXPECT_EQ(2 * a["counts"][key].get<int>(), b["counts"][key].get<int>()) << key;
    a["counts"].erase(key), b["counts"].erase(key);
  }
  for (Json* report : {&a, &b}) {
    (*report)["counts"].erase("one_coordinated"), (*report)["percolation"].erase("direction");
    for (const char* part : {"touching", "apart"})
      (*report)["two_contacts"][part].erase("grains"), (*report)["two_contacts"][part].erase("deviation_90");
    (*report)["two_contacts"].erase("grains"), (*report)["dacf"].erase("cell_area");
    for (const char* fit : {"fit", "power", "mass_radius", "k_cut"}) (*report)["dacf"].erase(fit);
  }
  EXPECT_TRUE(a["percolation"]["F_perc"].is_number());
  for (const char* section : {"counts", "stress", "forces", "percolation", "two_contacts"})
    expect_near(a[section], b[section], 1e-9, section);
  ASSERT_EQ(2 * a["pores"]["list"].size(), b["pores"]["list"].size());
  std::vector<double> areas, twice;
  for (const Json& pore : a["pores"]["list"]) areas.insert(areas.end(), 2, pore.value("area", -1.0));
  for (const Json& pore : b["pores"]["list"]) twice.push_back(pore.value("area", -1.0));
  std::sort(areas.begin(), areas.end()), std::sort(twice.begin(), twice.end());
  for (std::size_t k = 0; k < areas.size(); ++k) EXPECT_NEAR(areas[k], twice[k], 1e-9 * (1 + areas[k]));
  const Json &c = a["dacf"], &d = b["dacf"];
  const std::size_t common = std::min(c["r"].size(), d["r"].size());
  ASSERT_GT(common, 20u);
  for (std::size_t k = 0; k < common; ++k) {
    ASSERT_NEAR(c["r"][k].get<double>(), d["r"][k].get<double>(), 1e-12);
    EXPECT_NEAR(c["C"][k].get<double>(), d["C"][k].get<double>(), 2e-5) << c["r"][k];
  }
  // Modes in which both copies move alike are the modes of one.
  const DiskLaw law = one.state.law;
  const auto of_one = vibration_modes(one.network(), NetworkLaw::friction, law, kAllModes, false),
             of_two = vibration_modes(two.network(), NetworkLaw::friction, law, kAllModes, false);
  EXPECT_GT(of_one.omega.size(), 60u);
  for (const double w : of_one.omega) {
    const auto at = std::lower_bound(of_two.omega.begin(), of_two.omega.end(), w * (1 - 1e-7));
    ASSERT_NE(at, of_two.omega.end());
    EXPECT_NEAR(*at, w, 1e-6 * w);
  }
}

TEST(TiltedPacking, PrincipalStressesAndFabric) {
  const AnalysisInput input = sheared_packing();
  const Json stress = analyze(input, {}, {"stress"}).at("stress");
  const auto at = [&](const char* key, int row, int column) { return stress.at(key)[row][column].get<double>(); };
  const double mean = 0.5 * (at("tensor", 0, 1) + at("tensor", 1, 0));
  for (int k = 0; k < 2; ++k) {  // S d = s d
    const double value = stress.at("principal")[k].get<double>(), x = at("directions", k, 0),
                 y = at("directions", k, 1);
    EXPECT_NEAR(x * x + y * y, 1, 1e-14);
    EXPECT_NEAR(at("tensor", 0, 0) * x + mean * y, value * x, 1e-12 * std::abs(value));
    EXPECT_NEAR(mean * x + at("tensor", 1, 1) * y, value * y, 1e-12 * std::abs(value));
  }
  const double s1 = stress["principal"][0], s2 = stress["principal"][1];
  EXPECT_GT(s1, s2);
  EXPECT_DOUBLE_EQ(stress["deviator"].get<double>(), 0.5 * (s1 - s2));
  // Shear to the right pushes along the falling diagonal: sigma_12 < 0, and contacts are gained there.
  EXPECT_LT(mean, 0);
  EXPECT_LT(at("directions", 0, 0) * at("directions", 0, 1), 0);
  const Json& fabric = stress["fabric"];
  EXPECT_NEAR(fabric["tensor"][0][0].get<double>() + fabric["tensor"][1][1].get<double>(), 1, 1e-14);
  EXPECT_LT(fabric["tensor"][0][1].get<double>(), 0);
}

}  // namespace
}  // namespace isostat
