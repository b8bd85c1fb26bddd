// Contacts found by touching: the curve z(tolerance) against brute force, and when it is said that no one can trust it.
#include "analysis/network/contact_tolerance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/load_input.hpp"
#include "analysis/report.hpp"
#include "dem/files/network_file.hpp"
#include "dem/state/touching.hpp"
#include "tests/oracle/network_oracle.hpp"

namespace isostat {
namespace {

using testing::HasSubstr;

AnalysisInput found(Packing<2> packing, std::optional<double> tolerance = std::nullopt) {
  AnalysisInput input;
  input.path = "test";
  input.touching_tolerance = tolerance.value_or(default_gap_tolerance(packing.bodies));
  find_contacts(packing, *input.touching_tolerance);
  input.state.packing = std::move(packing);
  return input;
}

// A packing of a run, to all digits.
Packing<2> packed() { return read_network<2>(ISOSTAT_DATA "/clusters/dense_1400.net").packing; }

// Disks of diameter 1 that touch to rounding.
Packing<2> triangular_lattice() {
  Packing<2> p;
  const double row = std::sqrt(3.0) / 2;
  p.cell = PeriodicCell<2>{{{10, 10 * row}}};
  p.bodies.resize(100);
  for (std::size_t k = 0; k < 100; ++k) {
    const auto x = static_cast<double>(k % 10), y = static_cast<double>(k / 10);
    p.bodies.id[k] = static_cast<std::int64_t>(k), p.bodies.radius[k] = 0.5;
    p.bodies.position[k] = {{x + (k / 10 % 2 == 1 ? 0.5 : 0), row * y}};
  }
  return p;
}

Packing<2> rounded(Packing<2> packing, double unit) {
  for (Vec2& r : packing.bodies.position)
    for (double& x : r.c) x = unit * std::round(x / unit);
  return packing;
}

AnalysisInput photograph(std::optional<double> tolerance = std::nullopt) {
  AnalysisOptions options;
  options.box = {420.248, 424.388};
  options.gap_tolerance = tolerance;
  return load_input(ISOSTAT_DATA "/foreign/photograph.csv", options);
}

TEST(ContactTolerance, CurveIsThatOfAllPairs) {
  Packing<2> p = oracle::random_packing(5, 30, 0, true);
  double radius = 0;
  for (const double r : p.bodies.radius) radius += r / 30;
  const ContactTolerance c = contact_tolerance(found(p));
  ASSERT_EQ(c.tolerance.size(), 17u);
  EXPECT_NEAR(c.tolerance.front(), 1e-9 * radius, 1e-15 * radius);
  EXPECT_NEAR(c.tolerance.back(), 1e-1 * radius, 1e-12 * radius);
  for (std::size_t k = 0; k < c.tolerance.size(); ++k) {
    const auto pairs = oracle::touching_pairs(p, c.tolerance[k], 4).size();
    EXPECT_EQ(c.contacts[k], static_cast<std::int64_t>(pairs)) << c.tolerance[k];
    EXPECT_DOUBLE_EQ(c.z[k], 2.0 * static_cast<double>(pairs) / 30);
  }
  EXPECT_GT(c.contacts.back(), 0);
}

// The true z is 3.8; an error of .3 pixels turns half of the contacts into gaps.
TEST(ContactTolerance, APhotographIsInDoubt) {
  const ContactTolerance c = contact_tolerance(photograph());
  EXPECT_LT(c.z_used, 2.1);
  EXPECT_GT(c.z_high, 2.6);
  EXPECT_TRUE(c.in_doubt());
  EXPECT_THAT(contact_warning(photograph()),
              HasSubstr("their number hangs on the gap that still touches: z = 2.05 with --gap-tolerance "));
  EXPECT_TRUE(contact_tolerance(photograph(0.1)).in_doubt());
  EXPECT_TRUE(contact_tolerance(photograph(1)).in_doubt());  // near neighbours count as well: there is no plateau
}

TEST(ContactTolerance, WhatIsExactIsNot) {
  const Packing<2> exact = packed();
  std::size_t listed = 0;
  for (const Link<2>& l : exact.links) listed += is_contact(l.kind);
  const AnalysisInput input = found(exact);
  EXPECT_NEAR(static_cast<double>(input.state.packing.links.size()), static_cast<double>(listed),
              0.002 * double(listed));
  EXPECT_FALSE(contact_tolerance(input).in_doubt());
  EXPECT_EQ(contact_warning(input), "");

  // Six digits are right for contacts whose overlaps are wider, and wrong where disks just touch.
  EXPECT_FALSE(contact_tolerance(found(rounded(exact, 1e-6))).in_doubt());
  const Packing<2> touching = triangular_lattice();
  EXPECT_EQ(contact_tolerance(found(touching)).z_used, 6);
  EXPECT_FALSE(contact_tolerance(found(touching)).in_doubt());
  EXPECT_TRUE(contact_tolerance(found(rounded(touching, 1e-6))).in_doubt());
  EXPECT_FALSE(contact_tolerance(found(rounded(touching, 1e-6), 1e-5)).in_doubt());  // what the digits need

  Packing<2> soft;  // squashed by a hundredth: overlaps are wide, and gaps are none
  soft.cell = PeriodicCell<2>{{{9.9, 9.9}}};
  soft.bodies.resize(100);
  for (std::size_t k = 0; k < 100; ++k) {
    soft.bodies.id[k] = static_cast<std::int64_t>(k), soft.bodies.radius[k] = 0.5;
    soft.bodies.position[k] = {{0.99 * static_cast<double>(k % 10), 0.99 * static_cast<double>(k / 10)}};
  }
  EXPECT_FALSE(contact_tolerance(found(soft)).in_doubt());
  EXPECT_EQ(contact_tolerance(found(soft)).z_used, 4);
  for (Vec2& r : soft.bodies.position) r = 1.1 * r;
  soft.cell->length = 1.1 * soft.cell->length;
  EXPECT_FALSE(contact_tolerance(found(soft)).in_doubt());  // a gas: nothing touches, whatever the tolerance
}

TEST(ContactTolerance, ReportSaysWhereContactsAreFrom) {
  const auto report = analyze(photograph(), {}, {"counts", "rigidity", "clusters"});
  EXPECT_EQ(report["counts"]["z_of_tolerance"]["tolerance"].size(), 17u);
  ASSERT_EQ(report["warnings"].size(), 1u);  // three sections, told once
  EXPECT_THAT(report["warnings"][0].get<std::string>(), HasSubstr("photograph.csv: contacts were found by touching"));
  EXPECT_THAT(report["rigidity"]["certificate"]["contacts"].get<std::string>(),
              HasSubstr("found by touching: every gap up to "));
  AnalysisInput listed;
  listed.path = "test";
  listed.state.packing = packed();
  listed.links_given = true;
  const auto exact = analyze(listed, {}, {"counts", "rigidity"});
  EXPECT_FALSE(exact.contains("warnings"));
  EXPECT_FALSE(exact["counts"].contains("z_of_tolerance"));
  EXPECT_EQ(exact["rigidity"]["certificate"]["contacts"], "those of the file");
}

}  // namespace
}  // namespace isostat
