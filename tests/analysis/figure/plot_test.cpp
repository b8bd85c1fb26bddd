// From result files to charts.
#include "analysis/figure/plot.hpp"
#include "analysis/figure/column_plot.hpp"
#include "analysis/figure/study_plot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "analysis/structure/fractal_fit.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

using Json = nlohmann::json;

const JsonPlot& json_plot(std::string_view name) {
  for (const JsonPlot& p : json_plots())
    if (p.name == name) return p;
  throw std::logic_error("no such plot");
}
const TablePlot& table_plot(std::string_view name) {
  for (const TablePlot& p : table_plots())
    if (p.name == name) return p;
  throw std::logic_error("no such plot");
}

Json parsed(const std::string& name) {
  std::ifstream in(std::string(ISOSTAT_DATA) + name);
  return Json::parse(in);
}

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no error)";
}

// Eq. 28 against 2F1 to 14 digits, near d_F = 2 relative to its value at k = 0 since it vanishes there.
TEST(ScatteringPlot, CurveAgreesWithTheTable) {
  const Json table = parsed("/geometry/hyp2f1_table.json");
  for (const Json& row : table["rows"]) {
    const double d = row[0], x = row[1], expected = row[2];
    for (const double xi : {1.0, 7.3}) {
      const double scale = 2.5 * std::tgamma(d) * std::pow(xi, d);
      EXPECT_NEAR(fractal_intensity(x / xi, d, xi, 2.5, 0.125), 0.125 + scale * expected,
                  1e-13 * (0.125 + scale * expected) + 1e-15 * scale * std::pow(1 + x * x, -d / 2))
          << d << ' ' << x;
    }
  }
}

// The fit drawn is the fit of the file: it goes through the noiseless points.
TEST(ScatteringPlot, DrawsPointsErrorBarsAndFit) {
  const Json cases = parsed("/geometry/fit_cases.json");
  const Json& c = cases[0];
  const Json& fit = c["fit"];
  const Json result = {{"units", {{"length", "a"}}},
                       {"scattering",
                        {{"k", c["k"]},
                         {"I", c["I"]},
                         {"sigma", c["sigma"]},
                         {"fit",
                          {{"d_F", fit["dF"]},
                           {"d_F_error", 0.0122},
                           {"xi", fit["xi"]},
                           {"xi_error", 1.13},
                           {"amplitude", fit["amp"]},
                           {"constant", fit["cst"]}}}}}};
  const Plot plot = json_plot("scattering").make(result, "r.json");
  ASSERT_EQ(plot.charts.size(), 1u);
  const Chart& chart = plot.charts[0];
  EXPECT_TRUE(chart.x.log && chart.y.log);
  ASSERT_EQ(chart.curves.size(), 2u);
  EXPECT_EQ(chart.curves[0].y, c["I"].get<std::vector<double>>());
  EXPECT_EQ(chart.curves[0].error, c["sigma"].get<std::vector<double>>());
  const Curve& line = chart.curves[1];
  for (std::size_t b = 0; b < c["k"].size(); ++b) {
    const double k = c["k"][b], intensity = c["I"][b];
    std::size_t at = 1;
    while (at + 1 < line.x.size() && line.x[at] < k) ++at;
    const double t = std::log(k / line.x[at - 1]) / std::log(line.x[at] / line.x[at - 1]);
    EXPECT_NEAR(std::exp(std::log(line.y[at - 1]) * (1 - t) + std::log(line.y[at]) * t), intensity, 2e-4 * intensity);
  }
  EXPECT_EQ(chart.notes[0].back().text, " = 1.530 \u00b1 0.012");
}

TEST(ScatteringPlot, EnsembleUsesTheErrorOfTheMean) {
  const auto number = [](double mean, double se) { return Json{{"mean", mean}, {"sd", 2 * se}, {"se", se}}; };
  const Json result = {{"scattering",
                        {{"k", {1.0, 2.0}},
                         {"I", {number(5, 0.5), number(3, 0.25)}},
                         {"sigma", {1.0, 1.0}},
                         {"fit",
                          {{"d_F", number(1.5, 0.03)},
                           {"xi", number(8, 0.4)},
                           {"amplitude", number(2, 0.1)},
                           {"constant", number(0, 0.1)}}}}}};
  const Plot plot = json_plot("scattering").make(result, "r.json");
  EXPECT_EQ(plot.charts[0].curves[0].y, (std::vector{5.0, 3.0}));
  EXPECT_EQ(plot.charts[0].curves[0].error, (std::vector{0.5, 0.25}));
  EXPECT_EQ(plot.charts[0].notes[0].back().text, " = 1.50 \u00b1 0.03");
}

TEST(ScatteringPlot, APooledCurveGoesBeforeTheMean) {
  const auto section = [](double high) {
    return Json{{"k", {1.0, 2.0}}, {"I", {high, 3.0}}, {"sigma", {0.5, 0.25}}, {"fit", Json::object()}};
  };
  Json result = {{"scattering", section(5)}};
  result["scattering"]["pooled"] = section(6);
  const Plot plot = json_plot("scattering").make(result, "r.json");
  EXPECT_EQ(plot.charts[0].curves[0].y, (std::vector{6.0, 3.0}));
  EXPECT_EQ(plot.charts[0].curves[0].error, (std::vector{0.5, 0.25}));
}

TEST(ScatteringPlot, EmptyBinsAndAMissingFitAreLeftOut) {
  const Json result = {{"scattering",
                        {{"k", {1.0, 2.0, 4.0}},
                         {"I", {3.0, nullptr, 1.0}},
                         {"sigma", {0.1, nullptr, 0.1}},
                         {"fit", {{"d_F", nullptr}, {"xi", nullptr}}}}}};
  const Plot plot = json_plot("scattering").make(result, "r.json");
  ASSERT_EQ(plot.charts[0].curves.size(), 1u);
  EXPECT_TRUE(std::isnan(plot.charts[0].curves[0].y[1]));
}

std::string notes_of(const Chart& chart) {
  std::string text;
  for (const RichText& note : chart.notes) {
    for (const auto& piece : note) text += piece.text;
    text += '\n';
  }
  return text;
}

TEST(ScatteringPlot, AFitThatIsNotIdentifiableIsSaidAndNotDrawn) {
  Json result = {{"scattering",
                  {{"k", {1.0, 2.0, 4.0}},
                   {"I", {3.0, 2.0, 1.0}},
                   {"sigma", {0.1, 0.1, 0.1}},
                   {"fit",
                    {{"d_F", 1.5},
                     {"xi", 3.0},
                     {"amplitude", 1.0},
                     {"constant", 0.0},
                     {"identifiable", false},
                     {"message", "xi runs out of what the window can tell"}}},
                   {"power",
                    {{"d_F", 1.25},
                     {"d_F_error", 0.05},
                     {"amplitude", 3.0},
                     {"window", {1.0, 4.0}},
                     {"identifiable", true},
                     {"message", ""}}}}}};
  Plot plot = json_plot("scattering").make(result, "r.json");
  ASSERT_EQ(plot.charts[0].curves.size(), 2u);  // points, Eq. 26
  EXPECT_NEAR(plot.charts[0].curves[1].y.back(), 3 * std::pow(4, -1.25), 1e-12);
  EXPECT_EQ(notes_of(plot.charts[0]),
            "Eq. 28 not identifiable: xi runs out of what the window can tell\nEq. 26: dF = 1.25 \u00b1 0.05\n");
  result["scattering"]["power"]["identifiable"] = false;
  EXPECT_EQ(json_plot("scattering").make(result, "r.json").charts[0].curves.size(), 1u);
}

TEST(ScatteringPlot, ErrorsOverSamplesGoBeforeThoseOfTheModes) {
  const Json fit = {{"d_F", 1.5},
                    {"d_F_error", 0.03},
                    {"xi", 8.0},
                    {"xi_error", 0.4},
                    {"amplitude", 2.0},
                    {"constant", 0.0},
                    {"identifiable", true},
                    {"bootstrap", {{"d_F_error", 0.11}, {"xi_error", 1.2}}}};
  const Json result = {{"scattering", {{"k", {1.0, 2.0}}, {"I", {5.0, 3.0}}, {"sigma", {1.0, 1.0}}, {"fit", fit}}}};
  EXPECT_EQ(notes_of(json_plot("scattering").make(result, "r.json").charts[0]),
            "dF = 1.50 \u00b1 0.11\n\u03be = 8.0 \u00b1 1.2\n");
}

TEST(CorrelationPlot, DrawsTheExcessAndItsFitInTheWindow) {
  Json result = {{"units", {{"length", "a"}}},
                 {"dacf",
                  {{"r", {0.0, 1.0, 2.0, 3.0}},
                   {"C", {0.5, 0.45, 0.35, 0.24}},
                   {"solid_fraction", 0.5},
                   {"fit",
                    {{"d_F", 1.5},
                     {"d_F_error", 0.1},
                     {"xi", 2.0},
                     {"xi_error", 0.3},
                     {"amplitude", 0.2},
                     {"window", {1.0, 2.0}},
                     {"identifiable", true}}},
                   {"mass_radius", {{"local_dimension", {2.0, 1.9, 1.8, 1.7}}}}}}};
  Plot plot = json_plot("correlation").make(result, "r.json");
  ASSERT_EQ(plot.charts.size(), 2u);
  ASSERT_EQ(plot.charts[0].curves.size(), 2u);
  EXPECT_NEAR(plot.charts[0].curves[0].y[1], 0.2, 1e-15);
  EXPECT_EQ(plot.charts[0].curves[1].x.front(), 1);
  EXPECT_NEAR(plot.charts[0].curves[1].x.back(), 2, 1e-12);
  EXPECT_NEAR(plot.charts[0].curves[1].y.back(), 0.2 * std::pow(2, -0.5) * std::exp(-1), 1e-12);
  EXPECT_EQ(plot.charts[1].curves[0].y[3], 1.7);
  result["dacf"]["fit"]["identifiable"] = false;
  result["dacf"]["fit"]["message"] = "why";
  plot = json_plot("correlation").make(result, "r.json");
  EXPECT_EQ(plot.charts[0].curves.size(), 1u);
  EXPECT_EQ(notes_of(plot.charts[0]), "Eq. 27 not identifiable: why\n");
  result["dacf"]["pooled"] = {{"r", {0.0, 1.0}}, {"excess", {0.25, 0.15}}, {"fit", Json::object()}};
  EXPECT_EQ(json_plot("correlation").make(result, "r.json").charts[0].curves[0].y, (std::vector{0.25, 0.15}));
}

// A size law n^-tau, as the number above: at the lower end all that are in the window.
TEST(SizePlots, TheLawIsDrawnAsANumberAbove) {
  Json law = {{"from", 1.0},           {"to", nullptr},        {"exponent", 2.0},
              {"exponent_error", 0.1}, {"identifiable", true}, {"message", ""}};
  Json list = Json::array();
  for (const double r : {0.5, 1.0, 2.0, 3.0, 8.0}) list.push_back({{"R", r}});
  Json result = {{"pores", {{"list", list}, {"size_law", law}}}};
  Chart chart = json_plot("pores").make(result, "r.json").charts[0];
  ASSERT_EQ(chart.curves.size(), 2u);
  EXPECT_EQ(chart.curves[0].y.front(), 5);
  EXPECT_NEAR(chart.curves[1].y.front(), 4, 1e-12);  // those from 1 on
  EXPECT_NEAR(chart.curves[1].y.back(), 4.0 / 8, 1e-12);
  law["identifiable"] = false, law["message"] = "no power law";
  result["pores"]["size_law"] = law;
  chart = json_plot("pores").make(result, "r.json").charts[0];
  EXPECT_EQ(chart.curves.size(), 1u);
  EXPECT_EQ(notes_of(chart), "size law not identifiable: no power law\n");

  law["identifiable"] = true, law["to"] = 100.0;
  result = {
      {"stressed",
       {{"threshold", 0.01},
        {"list", {{{"grains", 4}, {"spans", ""}}, {{"grains", 900}, {"spans", "x"}}, {{"grains", 7}, {"spans", ""}}}},
        {"size_law", law},
        {"above", {0.01, 0.1}},
        {"above_largest", {900, 7}},
        {"above_mean_size_weighted", {700.0, 5.5}}}}};
  const Plot plot = json_plot("stressed").make(result, "r.json");
  ASSERT_EQ(plot.charts.size(), 2u);
  EXPECT_EQ(plot.charts[0].curves[0].x, (std::vector{4.0, 4.0, 7.0, 7.0}));  // the spanning one has no size
  EXPECT_EQ(plot.charts[1].curves[0].y, (std::vector{900.0, 7.0}));
}

TEST(LogHistogramPlots, ShowWhatThereIs) {
  const Json h = {{"edges", {-2.0, -1.0, 0.0}}, {"density", {0.25, 0.75}}};
  const Json loops = {{"loops", {{"scale", 0.005}, {"histograms", {{"log10_F_loops", h}, {"log10_F_trees", h}}}}}};
  EXPECT_EQ(json_plot("loops").make(loops, "r.json").charts[0].curves.size(), 2u);
  const Json two = {{"two_contacts", {{"histograms", {{"log10_deviation_touching", h}}}}}};
  EXPECT_EQ(json_plot("two-contacts").make(two, "r.json").charts[0].curves.size(), 1u);
  for (const char* name : {"loops", "two-contacts", "stressed", "correlation"})
    EXPECT_NE(message_of([&] { json_plot(name).make(Json::object(), "r.json"); }), "(no error)") << name;
}

TEST(CoordinationPlot, InPercent) {
  const Json result = {{"counts", {{"z", 3.05}, {"x", {0.0, 0.1, 0.9}}}}};
  const Plot plot = json_plot("coordination").make(result, "r.json");
  EXPECT_EQ(plot.charts[0].curves[0].x, (std::vector{0.0, 1.0, 2.0}));
  EXPECT_NEAR(plot.charts[0].curves[0].y[2], 90, 1e-12);
}

TEST(ForcePlots, HistogramsKeepTheirEdges) {
  const Json result = {{"units", {{"force", "F0"}}},
                       {"forces",
                        {{"histograms",
                          {{"N", {{"edges", {-0.2, -0.1, 0.0, 0.1, 0.2}}, {"density", {0.0, 4.0, 6.0, 0.0}}}},
                           {"angle", {{"edges", {0.0, 90.0, 180.0}}, {"density", {0.008, 0.003}}}},
                           {"NT", {{"edges", {{0.0, 1.0, 2.0}, {0.0, 1.0}}}, {"density", {{0.25}, {0.75}}}}}}}}}};
  const Chart n = json_plot("force-histogram").make(result, "r.json").charts[0];
  EXPECT_EQ(n.curves[0].x, (std::vector{-0.1, 0.0, 0.1}));  // empty ends cut
  EXPECT_EQ(n.curves[0].y, (std::vector{4.0, 6.0}));
  const Chart angle = json_plot("angle").make(result, "r.json").charts[0];
  EXPECT_EQ(angle.curves[0].x.size(), 3u);
  const Chart nt = json_plot("NT").make(result, "r.json").charts[0];
  EXPECT_EQ(nt.curves[0].y, (std::vector{0.25, 0.75}));
  EXPECT_THROW(json_plot("angle").make(Json::object(), "r.json"), InputError);
  EXPECT_THROW(json_plot("force-histogram").make(Json{{"forces", 3}}, "r.json"), InputError);
}

TEST(PoresPlot, CountsThePoresThatAreLarger) {
  const Json result = {
      {"pores", {{"list", {{{"R", 2.0}}, {{"R", 0.5}}, {{"R", nullptr}, {"percolating", true}}, {{"R", 1.0}}}}}}};
  const Curve curve = json_plot("pores").make(result, "r.json").charts[0].curves[0];
  EXPECT_EQ(curve.x, (std::vector{0.5, 0.5, 1.0, 1.0, 2.0, 2.0}));
  EXPECT_EQ(curve.y, (std::vector{3.0, 2.0, 2.0, 1.0, 1.0, 0.0}));
}

// tests/golden/soft-particle.json has what `lab soft-particle --json` writes: the keys of the contract, undefined
// numbers null.
TEST(LawFitPlot, FollowsTheEquations) {
  const std::string path = ISOSTAT_DATA "/../tests/golden/soft-particle.json";
  const Json result = Json::parse(read_whole_file(path));
  const auto of_its_kind = [&](const JsonPlot& p) { return p.applies(result); };
  ASSERT_EQ(std::count_if(json_plots().begin(), json_plots().end(), of_its_kind), 1);
  const Plot plot = json_plot("law-fit").make(result, path);
  ASSERT_EQ(plot.charts.size(), 4u);
  EXPECT_EQ(plot.charts[0].curves[0].x, (std::vector{0.05, 0.1, 0.3}));
  EXPECT_EQ(plot.charts[0].curves[0].y, (std::vector{0.0, 0.08, 2.5}));
  EXPECT_EQ(plot.charts[0].curves[0].error, (std::vector{0.0, 0.01, 0.1}));
  const Curve& fit = plot.charts[0].curves[1];
  for (std::size_t k = 0; k < fit.x.size(); ++k)
    EXPECT_DOUBLE_EQ(fit.y[k], fit.x[k] < 0.065 ? 0 : 73.669 * std::pow(fit.x[k], 2.799) - 0.035);
  EXPECT_EQ(plot.charts[1].curves[0].x, (std::vector{0.1, 0.2}));
  EXPECT_EQ(plot.charts[1].curves[0].y[1], 0.02);
  EXPECT_EQ(plot.charts[1].curves[0].error[1], 0.005);
  const Curve &slope = plot.charts[1].curves[1], &solid = plot.charts[0].curves[2];
  EXPECT_DOUBLE_EQ(slope.y.back(), 0.740 * std::pow(0.3, 2.1) - 0.0024);
  for (std::size_t k = 0; k < solid.x.size(); ++k)
    EXPECT_NEAR(solid.y[k], 15.4085 * std::pow(solid.x[k] / 0.3, 1.5), 1e-12);
  ASSERT_EQ(plot.charts[2].curves.size(), 2u);  // a curve for each deformation
  EXPECT_EQ(plot.charts[2].curves[0].x, (std::vector{0.0, 1.1}));
  EXPECT_EQ(plot.charts[2].curves[0].y, (std::vector{0.001, 0.011}));
  EXPECT_EQ(plot.charts[3].curves[1].y, (std::vector{0.002}));
}

TEST(DataTable, ReadsNumbersTextAndQuotes) {
  const DataTable t = parse_table("# machine: here\ncase, dt ,error\n\"a, \"\"b\"\"\",0.5,1e-3\r\nc,nan,\n", "t.csv");
  ASSERT_EQ(t.columns.size(), 3u);
  EXPECT_EQ(t.columns[0].text, (std::vector<std::string>{"a, \"b\"", "c"}));
  EXPECT_FALSE(t.columns[0].numeric());
  ASSERT_TRUE(t.find("dt")->numeric());
  EXPECT_EQ(t.find("dt")->value[0], 0.5);
  EXPECT_TRUE(std::isnan(t.find("dt")->value[1]));
  EXPECT_TRUE(std::isnan(t.find("error")->value[1]));
  EXPECT_EQ(t.find("nope"), nullptr);
}

TEST(DataTable, NamesTheLinesThatAreWrong) {
  EXPECT_EQ(message_of([] { parse_table("a,b\n1\n2,3\n4,5,6\n", "t.csv"); }),
            "t.csv:2: 1 fields: the header has 2\nt.csv:4: 3 fields: the header has 2");
  EXPECT_THROW(parse_table("", "t.csv"), InputError);
  EXPECT_THROW(parse_table("a,b\n", "t.csv"), InputError);
}

TEST(SeriesPlot, OnePanelAQuantity) {
  const DataTable t = parse_table("t,Phi,L1,L2,kinetic_energy,mine\n0,.3,40,41,1e-3,5\n1,.4,39,40,0,6\n", "s.csv");
  EXPECT_TRUE(table_plot("series").applies(t));
  const Plot plot = table_plot("series").make(t);
  EXPECT_TRUE(plot.share_x);
  ASSERT_EQ(plot.charts.size(), 4u);  // Phi; L1 and L2; kinetic energy; the unknown column
  EXPECT_EQ(plot.charts[1].curves.size(), 2u);
  EXPECT_TRUE(plot.charts[2].y.log);
  EXPECT_EQ(plot.charts[3].y.title, plain("mine"));
  EXPECT_THROW(table_plot("series").make(parse_table("a,b\n1,2\n", "s.csv")), InputError);
}

// Nine energies, eight colours: no two curves of a panel look the same.
TEST(SeriesPlot, CurvesOfAPanelDiffer) {
  const DataTable t = parse_table(
      "t,E_kinetic,E_elastic,E_adhesive,E_viscous,E_sliding,E_rolling,E_drag,E_cell_work,E_total\n"
      "0,1,2,3,4,5,6,7,8,9\n1,1,2,3,4,5,6,7,8,9\n",
      "s.csv");
  const Plot plot = table_plot("series").make(t);
  ASSERT_EQ(plot.charts.size(), 1u);
  const std::vector<Curve>& curves = plot.charts[0].curves;
  ASSERT_EQ(curves.size(), 9u);
  for (std::size_t a = 0; a < curves.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_FALSE(curves[a].color == curves[b].color && curves[a].style == curves[b].style) << a << ' ' << b;
}

TEST(SeriesPlot, SaysWhereStaticSolvesJumpedAndWhatIsImposed) {
  const Plot plot = table_plot("series").make(parse_table(
      "t,Phi,sigma11,imposed11,stage,static_solves\n0,.3,1,nan,0,0\n1,.4,1,2,1,2\n2,.41,2,2,1,2\n", "s.csv"));
  ASSERT_EQ(plot.charts.size(), 2u) << "stage and static_solves have no panel";
  ASSERT_EQ(plot.charts[0].curves.size(), 2u);
  EXPECT_EQ(plot.charts[0].curves[1].x, std::vector<double>{1});
  EXPECT_EQ(plot.charts[0].curves[1].y, std::vector<double>{.4});
  ASSERT_EQ(plot.charts[1].curves.size(), 2u);
  EXPECT_EQ(plot.charts[1].curves[1].style, CurveStyle::dashed);
}

TEST(ColumnPlot, AnyColumnsOfAnyTables) {
  const std::vector<DataTable> tables{
      parse_table("t,kinetic_energy,Phi,z,z_se\n0,1,.3,1,.1\n1,1,.4,3,\n2,1,.35,,.2\n", "d/up.csv"),
      parse_table("Phi,x.z\n.5,4\n", "down.csv")};
  const Plot plot = column_plot(tables, "Phi", {"z"});
  ASSERT_EQ(plot.charts.size(), 1u);
  const auto& curves = plot.charts[0].curves;  // a line and points a table
  ASSERT_EQ(curves.size(), 4u);
  EXPECT_EQ(curves[1].x, (std::vector<double>{.3, .4})) << "in the order of the file; no row without a number";
  EXPECT_EQ(curves[1].error, (std::vector<double>{.1, 0}));
  EXPECT_EQ(curves[1].label, plain("up"));
  EXPECT_EQ(curves[3].y, std::vector<double>{4}) << "a name's end is enough";
  EXPECT_EQ(plot.charts[0].x.title, rich("Φ")) << "columns of a series have symbols";
  EXPECT_THROW(column_plot(tables, "t", {"z"}), InputError) << "the second has no t";
  EXPECT_THROW(column_plot({tables[0]}, "Phi", {"nope"}), InputError);
}

TEST(BenchPlot, ErrorAgainstStepAndTimeByLabel) {
  const DataTable t = parse_table(
      "case,dt,cpu_seconds,error\npair,.1,1,1e-2\npair,.01,10,1e-4\nwall,.1,2,1e-1\nwall,.01,20,0\n", "b.csv");
  EXPECT_TRUE(table_plot("bench").applies(t));
  const Plot plot = table_plot("bench").make(t);
  ASSERT_EQ(plot.charts.size(), 2u);
  const auto& curves = plot.charts[0].curves;  // line and points a label
  ASSERT_EQ(curves.size(), 4u);
  EXPECT_EQ(curves[1].label, plain("pair"));
  EXPECT_EQ(curves[1].x, (std::vector{0.01, 0.1}));
  EXPECT_EQ(curves[1].y, (std::vector{1e-4, 1e-2}));
  EXPECT_EQ(curves[3].x, (std::vector{0.1}));  // an error of zero has no place on a log axis
  EXPECT_EQ(plot.charts[1].curves[1].x, (std::vector{1.0, 10.0}));
  EXPECT_THROW(table_plot("bench").make(parse_table("error,b\n1,2\n", "b.csv")), InputError);
}

// A method that is never wrong stays in the picture.
TEST(BenchPlot, SharesWithZerosAreLinear) {
  const Plot plot = table_plot("bench").make(
      parse_table("N,method,wrong,seconds\n10,a,0,1\n20,a,0,2\n10,b,0.5,3\n20,b,1,4\n", "b.csv"));
  ASSERT_EQ(plot.charts.size(), 2u);
  EXPECT_FALSE(plot.charts[0].y.log);
  EXPECT_EQ(plot.charts[0].curves[1].y, (std::vector{0.0, 0.0}));
  EXPECT_TRUE(plot.charts[1].y.log);
}

class PlotFiles : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name) << content;
    return folder_ / name;
  }
  TemporaryFolder folder_;
};

TEST_F(PlotFiles, OneMeaningNeedsNoName) {
  const std::string path = file("r.json", R"({"counts": {"x": [0.5, 0.5]}})");
  EXPECT_EQ(read_plot(path, "").charts.size(), 1u);
  EXPECT_EQ(read_plot(path, "coordination").charts.size(), 1u);
}

TEST_F(PlotFiles, FaultsSayWhatThereIs) {
  const std::string two = file("r.json", R"({"counts": {"x": [1]}, "pores": {"list": [{"R": 1}]}})");
  EXPECT_NE(message_of([&] { read_plot(two, ""); }).find("coordination, pores"), std::string::npos);
  EXPECT_NE(message_of([&] { read_plot(two, "angle"); }).find("analyze --only forces"), std::string::npos);
  EXPECT_NE(message_of([&] { read_plot(two, "series"); }).find("series"), std::string::npos);
  EXPECT_NE(message_of([&] { read_plot(file("n.json", "{}"), ""); }).find("nothing to plot"), std::string::npos);
  EXPECT_NE(message_of([&] { read_plot(file("x.json", "{\"a\": "), ""); }).find("no JSON"), std::string::npos);
  EXPECT_THROW(read_plot(folder_ / "missing.json", ""), InputError);
  EXPECT_THROW(read_plot(file("x.txt", ""), ""), InputError);
}

TEST(StudyPlot, ALoadPathGoesForthAndBack) {
  const DataTable table = parse_table(
      "row,stage,stage.pressure,law.friction,runs,n,e,e_sd,e_se\n"
      "a,1,0.1,0.2,2,2,1.5,.1,.07\na,2,1,0.2,2,2,0.9,.1,.07\na,3,0.1,0.2,2,2,0.91,.1,.07\n"
      "b,1,0.1,0.5,2,2,1.6,.1,.07\nb,2,1,0.5,2,2,1.0,.1,.07\nb,3,0.1,0.5,2,2,1.01,.1,.07\n",
      "study.csv");
  std::size_t color = 0;
  const Plot plot = study_plot(table, "stage.pressure", "e", color);
  ASSERT_EQ(plot.charts.size(), 1u);
  ASSERT_EQ(plot.charts[0].curves.size(), 4u);  // a line and its points for each friction
  EXPECT_EQ(plot.charts[0].curves[1].x, (std::vector<double>{0.1, 1, 0.1}));
  EXPECT_EQ(plot.charts[0].curves[1].y, (std::vector<double>{1.5, 0.9, 0.91}));
  EXPECT_EQ(plot.charts[0].curves[3].y, (std::vector<double>{1.6, 1.0, 1.01}));
  EXPECT_EQ(color, 2u);
}

}  // namespace
}  // namespace isostat
