#include "analysis/ensemble.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report_text.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

Json report(const char* path, Json counts) {
  return Json{
      {"isostat", "1"}, {"inputs", Json::array({path})}, {"units", {{"system", "reduced"}}}, {"counts", counts}};
}

TEST(Ensemble, OneReportStaysAsItIs) {
  const Json one = report("a", {{"z", 3.0}});
  EXPECT_EQ(merge_reports({one}), one);
}

TEST(Ensemble, NumbersBecomeMeanSpreadAndStandardError) {
  const Json merged = merge_reports({report("a", {{"z", 1}}), report("b", {{"z", 2.0}}), report("c", {{"z", 6.0}})});
  EXPECT_EQ(merged["inputs"], Json({"a", "b", "c"}));
  EXPECT_EQ(merged["isostat"], "1");
  EXPECT_EQ(merged["units"]["system"], "reduced");
  const Json& z = merged["counts"]["z"];
  EXPECT_DOUBLE_EQ(z["mean"], 3);
  EXPECT_DOUBLE_EQ(z["sd"], std::sqrt(7.0));
  EXPECT_DOUBLE_EQ(z["se"], std::sqrt(7.0 / 3));
  EXPECT_FALSE(z.contains("n"));
}

TEST(Ensemble, UndefinedNumbersAreLeftOutAndCounted) {
  const Json merged =
      merge_reports({report("a", {{"z", nullptr}, {"w", nullptr}}), report("b", {{"z", 2.0}, {"w", nullptr}})});
  EXPECT_DOUBLE_EQ(merged["counts"]["z"]["mean"], 2);
  EXPECT_EQ(merged["counts"]["z"]["n"], 1);
  EXPECT_EQ(merged.dump().find("nan"), std::string::npos);
  EXPECT_TRUE(merged["counts"]["w"].is_null());
}

TEST(Ensemble, ArraysElementByElementAndProportionsPadded) {
  const Json merged =
      merge_reports({report("a", {{"x", {0.0, 1.0}}, {"omega", {1.0}}, {"one_coordinated", {4, 5}}}),
                     report("b", {{"x", {0.5, 0.25, 0.25}}, {"omega", {1.0, 2.0}}, {"one_coordinated", {1, 2}}})});
  const Json& c = merged["counts"];
  EXPECT_DOUBLE_EQ(c["x"][0]["mean"], 0.25);
  EXPECT_DOUBLE_EQ(c["x"][2]["mean"], 0.125);
  EXPECT_EQ(c["omega"], Json::parse("[[1.0],[1.0,2.0]]"));
  EXPECT_EQ(c["one_coordinated"], Json::parse("[[4,5],[1,2]]"));
}

TEST(Ensemble, HistogramsOfOneWidthAreAligned) {
  const auto one = [](Json edges, Json density) {
    return report("a", {{"histograms", {{"N", {{"edges", std::move(edges)}, {"density", std::move(density)}}}}}});
  };
  const Json merged = merge_reports({one({-0.5, 0.0, 0.5}, {1.0, 1.0}), one({0.0, 0.5, 1.0}, {0.5, 1.5})});
  const Json& h = merged["counts"]["histograms"]["N"];
  EXPECT_EQ(h["edges"], Json({-0.5, 0.0, 0.5, 1.0}));
  EXPECT_DOUBLE_EQ(h["density"][0]["mean"], 0.5);
  EXPECT_DOUBLE_EQ(h["density"][1]["mean"], 0.75);
  EXPECT_DOUBLE_EQ(h["density"][2]["mean"], 0.75);
  EXPECT_TRUE(merge_reports({one({0.0, 0.5}, {2.0}), one({0.0, 0.3}, {3.3})})["counts"]["histograms"]["N"].is_array());
}

TEST(Ensemble, HistogramsInTwoVariablesAreAligned) {
  const auto one = [](const char* text) { return report("a", {{"NT", Json::parse(text)}}); };
  const Json merged = merge_reports({one(R"({"edges": [[0, 1], [0, 1, 2]], "density": [[0.25, 0.75]]})"),
                                     one(R"({"edges": [[1, 2], [-1, 0]], "density": [[1.0]]})")});
  const Json& h = merged["counts"]["NT"];
  EXPECT_EQ(h["edges"], Json::parse("[[0.0, 1.0, 2.0], [-1.0, 0.0, 1.0, 2.0]]"));
  EXPECT_DOUBLE_EQ(h["density"][0][1]["mean"], 0.125);
  EXPECT_DOUBLE_EQ(h["density"][0][2]["mean"], 0.375);
  EXPECT_DOUBLE_EQ(h["density"][1][0]["mean"], 0.5);
}

TEST(Ensemble, VerdictsAndWordsAreKeptWhenTheyAgree) {
  const Json merged =
      merge_reports({report("a", {{"ok", true}, {"same", true}, {"direction", "x"}, {"law", "rolling"}}),
                     report("b", {{"ok", false}, {"same", true}, {"direction", "y"}, {"law", "rolling"}})});
  EXPECT_DOUBLE_EQ(merged["counts"]["ok"]["mean"], 0.5);
  EXPECT_EQ(merged["counts"]["same"], true);
  EXPECT_EQ(merged["counts"]["direction"], Json({"x", "y"}));
  EXPECT_EQ(merged["counts"]["law"], "rolling");
}

std::string csv_of(const Json& r, const std::string& name) {
  for (const auto& [file, content] : report_as_csv(r))
    if (file == name) return content;
  return "absent";
}

TEST(ReportCsv, ScalarsColumnsHistogramsAndLists) {
  const Json r = report("a", Json::parse(R"({"z": 2.5, "law": "a,b", "none": null, "tensor": [[1, 2], [3, 4.5]],
    "k_edges": [0, 1, 2], "I": [0.5, null], "x": [0.1, 0.2, 0.7],
    "histograms": {"N": {"edges": [0, 1, 2], "density": [0.25, 0.75]}},
    "list": [{"area": 1.5, "x": 2}, {"x": 3}]})"));
  EXPECT_EQ(csv_of(r, "counts.csv"),
            "key,value\nz,2.5\nlaw,\"a,b\"\nnone,\ntensor.0.0,1\ntensor.0.1,2\ntensor.1.0,3\ntensor.1.1,4.5\n");
  EXPECT_EQ(csv_of(r, "counts.table.csv"), "k_left,k_right,I\n0,1,0.5\n1,2,\n");
  EXPECT_EQ(csv_of(r, "counts.x.csv"),
            "index,x\n0,0.10000000000000001\n1,0.20000000000000001\n2,0.69999999999999996\n");
  EXPECT_EQ(csv_of(r, "counts.N.csv"), "left,right,density\n0,1,0.25\n1,2,0.75\n");
  EXPECT_EQ(csv_of(r, "counts.list.csv"), "area,x\n1.5,2\n,3\n");
}

TEST(ReportCsv, EnsemblesCarryTheirErrors) {
  const Json merged =
      merge_reports({report("a", {{"z", 1.0}, {"x", {1.0, 2.0}}}), report("b", {{"z", 3.0}, {"x", {1.0, 4.0}}})});
  EXPECT_EQ(csv_of(merged, "counts.csv"), "key,mean,sd,se\nz,2,1.4142135623730951,1\n");
  EXPECT_EQ(csv_of(merged, "counts.x.csv"), "index,x,x_sd,x_se\n0,1,0,0\n1,3,1.4142135623730951,1\n");
}

TEST(ReportText, OneLineANumber) {
  const std::string text = report_as_text(report("a", Json::parse(R"({"z": 2.5, "w": null, "x": [1, 2]})")));
  EXPECT_NE(text.find("counts\n  z "), std::string::npos);
  EXPECT_NE(text.find(" 2.5\n"), std::string::npos);
  EXPECT_NE(text.find(" -\n"), std::string::npos);
  EXPECT_NE(text.find("[1, 2]\n"), std::string::npos);
}

TEST(Ensemble, AFitThatIsNotIdentifiableIsNoPartOfAMean) {
  const auto one = [](double d, bool told) {
    return report("a", {{"fit",
                         {{"d_F", d},
                          {"d_F_error", 0.1 * d},
                          {"correlation", {{1.0}}},
                          {"k_limit", 6.0},
                          {"identifiable", told},
                          {"message", told ? "" : "why"}}}});
  };
  const Json merged = merge_reports({one(1, true), one(2, true), one(50, false)})["counts"]["fit"];
  EXPECT_EQ(merged["d_F"]["mean"], 1.5);
  EXPECT_EQ(merged["d_F"]["n"], 2);
  EXPECT_EQ(merged["d_F_error"]["n"], 2);
  EXPECT_EQ(merged["k_limit"]["mean"], 6.0);
  EXPECT_NEAR(merged["identifiable"]["mean"].get<double>(), 2.0 / 3, 1e-15);
  const Json none = merge_reports({one(1, false), one(2, false)})["counts"]["fit"];
  EXPECT_TRUE(none["d_F"].is_null());
  EXPECT_EQ(none["identifiable"], false);
  EXPECT_EQ(none["message"], "why");
}

TEST(ReportText, AFitWithoutAResultSaysSoAndShowsNoNumbers) {
  const auto text = [](bool told) {
    return report_as_text(report("a", {{"fit", {{"d_F", 1.25}, {"identifiable", told}, {"message", "xi runs away"}}}}));
  };
  EXPECT_NE(text(true).find("fit.d_F"), std::string::npos);
  EXPECT_EQ(text(false).find("1.25"), std::string::npos);
  EXPECT_NE(text(false).find("NOT IDENTIFIABLE: xi runs away"), std::string::npos);
}

}  // namespace
}  // namespace isostat
