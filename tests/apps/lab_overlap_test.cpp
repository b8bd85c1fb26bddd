// isostat lab overlap: the checked cases through the program, its ways of writing numbers, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/apps/program.hpp"

namespace isostat {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using LabOverlap = Program;

constexpr const char* kPair = "0,0,4,0,0,4,3,4,4,3,1,1\n";

TEST_F(LabOverlap, PrintsTheCheckedCases) {
  std::ifstream in(ISOSTAT_DATA "/geometry/overlap_cases.json");
  const json cases = json::parse(in)["cases"];
  std::string table;
  for (const json& c : cases) {
    std::string line;
    for (const char* triangle : {"A", "B"})
      for (const json& corner : c[triangle])
        for (const json& x : corner) line += (line.empty() ? "" : ",") + x.get<std::string>();
    table += line + "\n";
  }
  write("pairs.csv", table);
  const Outcome o = run("lab overlap " + in_folder("pairs.csv"));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  const json pairs = json::parse(o.out)["pairs"];
  ASSERT_EQ(pairs.size(), cases.size());
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const double area = std::strtod(cases[k]["area"].get<std::string>().c_str(), nullptr);
    EXPECT_EQ(pairs[k]["type"], cases[k]["kind"]) << cases[k]["name"];
    EXPECT_NEAR(pairs[k]["area"].get<double>(), area, 0x1p-52 * area) << cases[k]["name"];
  }
}

TEST_F(LabOverlap, ReadsHeaderBlanksCommentsDecimalsAndHexadecimals) {
  write("pairs.csv",
        "ax0,ay0,ax1,ay1,ax2,ay2,bx0,by0,bx1,by1,bx2,by2\r\n# two pairs\r\n\r\n 0, 0 ,4,0,0,4, 3,4,4,3,1,1 # one\r\n"
        "0x0p+0,-0,0X1p2,0e0,+0,4.0e0,0x1.8p1,4,0x4,3,1,10E-1");
  const Outcome o = run("lab overlap " + in_folder("pairs.csv") + " --json " + in_folder("out.json"));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out, "");
  const json pairs = json::parse(content(in_folder("out.json")))["pairs"];
  ASSERT_EQ(pairs.size(), 2u);
  for (const json& p : pairs) {
    EXPECT_EQ(p["type"], "i");
    EXPECT_DOUBLE_EQ(p["area"].get<double>(), 0.4);
  }
}

TEST_F(LabOverlap, NamesEveryBadLine) {
  write("pairs.csv", std::string(kPair) + "1,2,3\n" + kPair +
                         "0,0,4,0,0,4,3,4,4,3,1,one\n0,0,4,0,0,4,3,4,nan,3,1e999,1\n" +
                         "0,0,4,0,0,4,3,4,4,3,,1\n0x,0,4,0,0,4,3,4,4,--3,2,1\n0,0,4,0,0,4,3,4,4,3,1,1,\n");
  const Outcome o = run("lab overlap " + in_folder("pairs.csv") + " --json " + in_folder("out.json"));
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.out, "");
  EXPECT_FALSE(exists("out.json"));
  EXPECT_THAT(o.err, HasSubstr("pairs.csv:2: columns = 3: 12 numbers between commas"));
  EXPECT_THAT(o.err, HasSubstr("pairs.csv:4: column 12 = one: a finite number"));
  EXPECT_THAT(o.err, HasSubstr("pairs.csv:5: column 9 = nan"));
  EXPECT_THAT(o.err, HasSubstr("pairs.csv:5: column 11 = 1e999"));
  EXPECT_THAT(o.err, HasSubstr("pairs.csv:6: column 11: a finite number"));
  EXPECT_THAT(o.err, HasSubstr("pairs.csv:7: column 1 = 0x"));
  EXPECT_THAT(o.err, HasSubstr("pairs.csv:7: column 10 = --3"));
  EXPECT_THAT(o.err, HasSubstr("pairs.csv:8: columns = 13"));
  EXPECT_THAT(o.err, Not(HasSubstr("pairs.csv:1:")));
  EXPECT_THAT(o.err, Not(HasSubstr("pairs.csv:3:")));
}

TEST_F(LabOverlap, RefusesWhatIsNoTable) {
  write("nan.csv", "nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan\n");
  EXPECT_EQ(run("lab overlap " + in_folder("nan.csv")).code, 2);
  EXPECT_EQ(run("lab overlap").code, 2);
  EXPECT_EQ(run("lab overlap " + in_folder("missing.csv")).code, 2);
  std::string many;
  for (int k = 0; k < 1000; ++k) many += "x\n";
  write("many.csv", many);
  const Outcome o = run("lab overlap " + in_folder("many.csv"));
  EXPECT_EQ(o.code, 2);
  EXPECT_LT(o.err.size(), 10000u);
  EXPECT_THAT(o.err, HasSubstr("more faults are not listed"));
}

}  // namespace
}  // namespace isostat
