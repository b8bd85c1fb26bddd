// Section `bases`: what a user gets of floppy modes, self-stress states and the split, against G built from the tables.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/report.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/rigidity/sections.hpp"
#include "dem/files/network_file.hpp"
#include "tests/support/random_network.hpp"

namespace isostat {
namespace {

AnalysisInput with_forces(double coordination, bool forces) {
  RandomNetwork o;
  o.columns = o.rows = 6, o.coordination = coordination, o.seed = 5;
  AnalysisInput input;
  input.path = "test";
  input.state.packing = random_network(o);
  input.links_given = true;
  if (!forces) return input;
  for (std::size_t l = 0; l < input.packing().links.size(); ++l) {
    input.state.packing.links[l].normal_force = 1 + std::sin(static_cast<double>(l));
    input.state.packing.links[l].tangential_force = 0.2 * std::cos(static_cast<double>(l));
  }
  input.state.law.normal_stiffness = input.state.law.tangential_stiffness = 1e3;
  input.state.law.friction = 0.5;
  return input;
}

const Table& named(const std::vector<Table>& tables, const std::string& name) {
  for (const Table& t : tables)
    if (t.name == name) return t;
  throw std::out_of_range(name);
}

double largest(const std::vector<double>& v) {
  double m = 0;
  for (double x : v) m = std::max(m, std::abs(x));
  return m;
}

TEST(BasesSection, TablesHoldNullVectorsOfG) {
  for (const double z : {2.6, 3.6, 4.6}) {
    const AnalysisInput input = with_forces(z, false);
    AnalysisOptions options;
    options.cell_free = true, options.most_vectors = 7;
    const auto json = bases_section(input, options);
    const auto rigidity = rigidity_section(input, options);
    EXPECT_EQ(json["floppy_modes"]["of"], rigidity["K"]);
    EXPECT_EQ(json["self_stress"]["of"], rigidity["H"]);
    const auto modes = std::min(7, rigidity["K"].get<int>()), states = std::min(7, rigidity["H"].get<int>());
    EXPECT_EQ(json["floppy_modes"]["given"], modes);
    EXPECT_EQ(json["self_stress"]["given"], states);
    EXPECT_TRUE(json["split"].is_null());

    const RigidityMatrix g = rigidity_matrix(input.packing(), NetworkLaw::friction, true);
    const auto tables = bases_tables(input, options);
    std::map<std::int64_t, std::size_t> grain_of_id;
    for (std::size_t i = 0; i < input.packing().bodies.size(); ++i) grain_of_id[input.packing().bodies.id[i]] = i;
    std::vector<std::vector<double>> u(static_cast<std::size_t>(modes),
                                       std::vector<double>(static_cast<std::size_t>(g.columns()), 0.0));
    for (const auto& row : named(tables, "floppy_modes").rows)
      for (std::size_t d = 0; d < 3; ++d)
        u[static_cast<std::size_t>(row[0]) - 1][3 * grain_of_id.at(static_cast<std::int64_t>(row[1])) + d] = row[2 + d];
    for (const auto& row : named(tables, "floppy_strains").rows)
      for (int a = 0; a < 2; ++a)
        u[static_cast<std::size_t>(row[0]) - 1][static_cast<std::size_t>(g.layout.strain_column(a))] =
            row[1 + static_cast<std::size_t>(a)];
    for (std::size_t m = 0; m < u.size(); ++m) {
      EXPECT_DOUBLE_EQ(largest(u[m]), 1);
      EXPECT_LT(largest(g.link_velocities(u[m])), 1e-9);
      std::size_t moving = 0;
      for (std::size_t i = 0; i < input.packing().bodies.size(); ++i)
        moving += std::abs(u[m][3 * i]) > 1e-9 || std::abs(u[m][3 * i + 1]) > 1e-9 || std::abs(u[m][3 * i + 2]) > 1e-9;
      EXPECT_EQ(json["floppy_modes"]["list"][m]["grains"], moving);
    }

    using Key = std::array<double, 4>;
    std::map<Key, std::size_t> link_of;
    for (std::size_t l = 0; l < input.packing().links.size(); ++l) {
      const auto& link = input.packing().links[l];
      link_of[{static_cast<double>(input.packing().bodies.id[static_cast<std::size_t>(link.i)]),
               static_cast<double>(input.packing().bodies.id[static_cast<std::size_t>(link.j)]),
               static_cast<double>(link.shift[0]), static_cast<double>(link.shift[1])}] = l;
    }
    std::vector<std::map<std::size_t, std::array<double, 3>>> f(static_cast<std::size_t>(states));
    for (const auto& row : named(tables, "self_stress").rows)
      f[static_cast<std::size_t>(row[0]) - 1][link_of.at({row[1], row[2], row[3], row[4]})] = {row[5], row[6], row[7]};
    for (const auto& state : f) {
      std::vector<double> rows(static_cast<std::size_t>(g.rows()), 0.0);
      for (std::size_t r = 0; r < rows.size(); ++r)
        if (const auto at = state.find(static_cast<std::size_t>(g.link_of_row[r])); at != state.end())
          rows[r] = at->second[static_cast<std::size_t>(g.kind[r])];
      EXPECT_DOUBLE_EQ(largest(rows), 1);
      EXPECT_LT(largest(g.body_forces(rows)), 1e-9);
    }
  }
}

TEST(BasesSection, SplitsTheForcesOfAState) {
  const AnalysisInput input = with_forces(4.6, true);
  const auto json = bases_section(input, {});
  ASSERT_TRUE(json["split"].is_object());
  EXPECT_LT(json["split"]["residual"].get<double>(), 1e-10);
  const double all = json["split"]["forces"], load = json["split"]["balancing"], self = json["split"]["self_stress"];
  EXPECT_NEAR(load * load + self * self, all * all, 1e-10 * all * all);
  EXPECT_GT(self, 0.01 * all);
  const Table split = named(bases_tables(input, {}), "split");
  ASSERT_EQ(split.rows.size(), input.packing().links.size());
  for (std::size_t l = 0; l < split.rows.size(); ++l) {
    EXPECT_NEAR(split.rows[l][4] + split.rows[l][7], input.packing().links[l].normal_force, 1e-12);
    EXPECT_NEAR(split.rows[l][5] + split.rows[l][8], input.packing().links[l].tangential_force, 1e-12);
  }
}

TEST(RigiditySections, LargeOnesLeaveSoftModesToThoseWhoAsk) {
  RandomNetwork o;
  o.columns = o.rows = 84, o.coordination = 5.0;  // 21168 dofs
  AnalysisInput input;
  input.path = "test";
  input.state.packing = random_network(o);
  AnalysisOptions options;
  const auto quick = rigidity_section(input, options)["certificate"]["near_null_singular_values"];
  EXPECT_TRUE(quick["values"].is_null());
  EXPECT_TRUE(quick["reason"].is_string());
  options.near_null = true;
  const auto asked = rigidity_section(input, options)["certificate"]["near_null_singular_values"];
  ASSERT_EQ(asked["values"].size(), 6u);
  EXPECT_GT(asked["values"][0].get<double>(), 1e-4);
  EXPECT_LE(asked["values"][0].get<double>(), asked["values"][1].get<double>());
}

}  // namespace
}  // namespace isostat
