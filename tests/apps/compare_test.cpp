// isostat compare: from two states to a report, tables and a picture.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/program.hpp"

namespace isostat {
namespace {

using Json = nlohmann::json;

constexpr const char* kChain = "cell 10 10\ngrain 1 1 1 .5\ngrain 2 2 1 .5\ngrain 3 3 1 .5\ngrain 4 3 2 .5\n";

class Compare : public Program {};

TEST_F(Compare, StatesOfARun) {
  write("scene.toml", quick_scene(60) + "[output]\nstages = true\n");
  ASSERT_EQ(run("pack " + in_folder("scene.toml") + " -o " + in_folder("s.h5")).code, 0);
  const std::string pair = in_folder("s.stage0.h5") + " " + in_folder("s.h5");
  const Outcome told = run("compare " + pair + " --json - --csv " + in_folder("tables") + " -o " + in_folder("c.svg"));
  ASSERT_EQ(told.code, 0) << told.err;
  const Json json = Json::parse(told.out);
  EXPECT_EQ(json["grains"]["matched"], 60);
  const Json& c = json["contacts"];
  EXPECT_EQ(c["before"], c["kept"].get<int>() + c["lost"].get<int>());
  EXPECT_EQ(c["after"], c["kept"].get<int>() + c["gained"].get<int>());
  EXPECT_GT(json["cell"]["strain"][0].get<double>(), 0);  // the second stage compresses
  EXPECT_GT(json["cell"]["solid_fraction"][1].get<double>(), json["cell"]["solid_fraction"][0].get<double>());
  EXPECT_NE(content(in_folder("c.svg")).find("id=\"velocities\""), std::string::npos);
  EXPECT_EQ(content(in_folder("tables/displacements.csv")).rfind("id,x,y,r,ux,uy,region\n", 0), 0u);
  EXPECT_NE(content(in_folder("tables/links.csv")).find(",lost,"), std::string::npos);

  const Outcome same = run("compare " + in_folder("s.h5") + " " + in_folder("s.h5") + " --json -");
  ASSERT_EQ(same.code, 0) << same.err;
  const Json still = Json::parse(same.out);
  EXPECT_EQ(still["contacts"]["lost"], 0);
  EXPECT_EQ(still["displacement"]["nonaffine_rms"], 0.0);
}

TEST_F(Compare, BadInput) {
  write("a.net", kChain);
  write("free.net", "grain 1 0 0 .5\n");
  write("other.net", "cell 10 10\ngrain 7 0 0 .5\n");
  write("space.net", "cell 5 5 5\ngrain 1 0 0 0 .5\n");
  const std::string a = in_folder("a.net");
  const auto refused = [&](const std::string& arguments, const std::string& why) {
    const Outcome o = run("compare " + arguments + " --json " + in_folder("out.json"));
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_NE(o.err.find(why), std::string::npos) << o.err;
    EXPECT_FALSE(exists("out.json")) << arguments;
  };
  refused(a, "two packings");
  refused(a + " " + in_folder("free.net"), "only one of the two packings has a cell");
  refused(a + " " + in_folder("other.net"), "no grain has the id");
  refused(a + " " + in_folder("space.net"), "in another dimension");
  refused(a + " " + a + " --tolerance 0", "--tolerance");
  refused(a + " " + a + " --gap-tolerance -1", "--gap-tolerance");
  refused(a + " " + a + " -o " + in_folder("c.gif"), ".svg, .pdf or .png");
  refused(a + " " + a + " -o " + a, "-o");
}

}  // namespace
}  // namespace isostat
