// Lengths of very different size, and other numbers that are no packing: one message and exit code 2, never gigabytes,
// an endless loop or an internal error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/program.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Lengths : public Program {
 protected:
  // In two gigabytes and twenty seconds of CPU.
  Outcome bounded(const std::string& arguments) const {
    const std::string out = in_folder("stdout"), err = in_folder("stderr");
    const int status = std::system(
        ("bash -c 'ulimit -v 2000000; ulimit -t 20; " ISOSTAT_PROGRAM " " + arguments + "' >" + out + " 2>" + err)
            .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
  }
};

TEST_F(Lengths, BeyondTheRangeAreRefusedBySection) {
  struct Case {
    std::string net, reason;
  };
  const std::string pair = "grain 0 0 0 .5\ngrain 1 1 0 .5\n";
  for (const Case& c :
       {Case{"grain 0 0 0 .5\ngrain 1 5e6 0 .5\n", "extent of the packing is above 1e+06"},
        Case{"grain 0 0 0 .5\ngrain 1 5e300 0 .5\n", "extent of the packing"},
        Case{"grain 0 -1e308 0 .5\ngrain 1 1e308 0 .5\n", "extent of the packing"},
        Case{"cell 2 1e8\n" + pair, "cell.L2 = 1e+08: an edge is above 1e+06"},
        Case{"cell 1e-3 1e-3\ngrain 0 0 0 .5\ncontact 0 0 c 1 0\n", "an edge is below 0.1"},
        Case{"cell 1 1\ngrain 0 0 0 3.7e6\ncontact 0 0 c 1 0\n", "an edge is below 0.1"},
        Case{"cell 2 2\ngrain 0 0 0 2e9\ncontact 0 0 c 1 0\n", "an edge is below 0.1"},
        Case{"cell 3 1e12\n" + pair, "an edge is above"}, Case{"cell 4 1e308\n" + pair, "an edge is above"},
        Case{"cell 3 1e8\ngrain 0 0 0 5e-151\ngrain 1 1 0 5e-151\n", "radius = 5e-151"},
        Case{"grain 0 0 0 .5\ngrain 1 0 0 1.7e308\n", "radius = 1.7e+308"},
        Case{"grain 0 0 0 .5\ngrain 1 1 0 1e-9\n", "of the smallest grain"},
        Case{"cell 2 2 1e9\ngrain 0 0 0 0 .5\ngrain 1 1 0 0 .5\n", "cell.L3 = 1e+09"},
        Case{"cell 2 1e9\ntriangle 1 1 0 0 1 0 0 1\n", "cell.L2 = 1e+09"}}) {
    write("a.net", c.net);
    for (const char* command : {"analyze ", "draw -o x.svg "}) {
      const Outcome o = bounded(command + in_folder("a.net"));
      EXPECT_EQ(o.code, 2) << command << c.net << o.err;
      EXPECT_THAT(o.err, HasSubstr("a.net:")) << c.net;
      EXPECT_THAT(o.err, HasSubstr(c.reason)) << c.net;
    }
  }
  // Just within it everything runs.
  for (const std::string& net : {"cell 2 4e4\n" + pair, std::string("grain 0 0 0 .5\ngrain 1 4e5 0 .5\n"),
                                 std::string("cell .06 .06\ngrain 0 0 0 .5\ncontact 0 0 c 1 0\n")}) {
    write("a.net", net);
    const Outcome o = bounded("analyze " + in_folder("a.net"));
    EXPECT_EQ(o.code, 0) << net << o.err;
    EXPECT_THAT(bounded("analyze " + in_folder("a.net") + " --only dacf").err, Not(HasSubstr("internal"))) << net;
  }
}

TEST_F(Lengths, ToleranceOfGapsIsBounded) {
  write("a.net", "cell 3 3\ngrain 0 0 0 .5\ngrain 1 1 1 .5\n");
  write("a.csv", "id,x,y,r\n1,0,0,.5\n2,1,1,.5\n");
  for (const char* tolerance : {"6", "1e4", "1e10", "1e308"})
    for (const std::string& input : {in_folder("a.net"), in_folder("a.csv")}) {
      const Outcome o = bounded("analyze " + input + " --only counts --gap-tolerance " + tolerance);
      EXPECT_EQ(o.code, 2) << tolerance;
      EXPECT_THAT(o.err, HasSubstr("--gap-tolerance = ")) << tolerance;
    }
  const Outcome o = bounded("analyze " + in_folder("a.net") + " --only counts --gap-tolerance 2");
  EXPECT_EQ(o.code, 0);
  EXPECT_THAT(o.out, HasSubstr("contacts                      "));
}

TEST_F(Lengths, ScenesThatWouldNeverEndOrNeverBegin) {
  const std::string scene = "pack " ISOSTAT_DATA "/scenes/disks-method1.toml -o " + in_folder("x.h5") +
                            " --max-time .01 --set grains.count=20 --set ";
  write("far.net", "cell 1e9 1e9\ngrain 0 0 0 .5\ngrain 1 1 0 .5\n");
  EXPECT_EQ(bounded(scene + "grains.file=\\\"" + in_folder("far.net") + "\\\"").code, 2);
  EXPECT_EQ(bounded(scene + "step.fraction=1e-15").code, 2);
  EXPECT_EQ(bounded(scene + "stage.0.normal_stiffness=9e18").code, 2);
  EXPECT_THAT(bounded(scene + "stage.0.normal_stiffness=9e18").err, HasSubstr("stage.0.normal_stiffness = 9"));
  EXPECT_EQ(bounded(scene + "grains.solid_fraction=1e-9").code, 3);
  const Outcome many = bounded(scene + "grains.count=1000000000");
  EXPECT_EQ(many.code, 2) << many.err;
  EXPECT_THAT(many.err, HasSubstr("not enough memory"));
}

TEST_F(Lengths, DeepAndManyKeys) {
  std::string deep = "a";
  for (int k = 0; k < 100000; ++k) deep += ".a";
  write("study.toml", "scene = \"x\"\n[set]\n" + deep + " = 1\n");
  for (const char* head : {"study ", "pack "}) {
    const Outcome o = bounded(head + in_folder("study.toml") + " -o " + in_folder("out.h5"));
    EXPECT_EQ(o.code, 2) << head;
    EXPECT_THAT(o.err, HasSubstr("study.toml:3: at most 2000 points in a line")) << head;
  }
  std::string many;
  for (int k = 0; k < 200000; ++k) many += "abcdefgh" + std::to_string(k) + " = 1\n";
  write("many.toml", many);
  const Outcome o = bounded("pack " + in_folder("many.toml") + " -o " + in_folder("x.h5"));
  EXPECT_EQ(o.code, 2);
  EXPECT_THAT(o.err, HasSubstr("more faults are not listed"));
  EXPECT_LT(o.err.size(), 30000u);
}

}  // namespace
}  // namespace isostat
