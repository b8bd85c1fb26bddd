// `isostat draw` and `isostat plot` from outside: files, messages, exit codes.
#include <gtest/gtest.h>

#include "tests/apps/program.hpp"

namespace isostat {
namespace {

class Figures : public Program {
 protected:
  std::string cluster(const std::string& name) const { return std::string(ISOSTAT_DATA) + "/clusters/" + name; }
  static std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++n;
    return n;
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(in_folder("")), {}));
  }
};

TEST_F(Figures, DrawsEveryFormat) {
  for (const auto& [name, head] : {std::pair{"a.svg", "<?xml"}, {"a.pdf", "%PDF"}, {"a.png", "\x89PNG"}}) {
    const Outcome o = run("draw " + cluster("double_triangle.net") + " -o " + in_folder(name));
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.out, "");
    EXPECT_TRUE(content(in_folder(name)).starts_with(head));
  }
  const std::string svg = content(in_folder("a.svg"));
  EXPECT_EQ(count(svg, "<circle"), 4u);
  EXPECT_EQ(count(svg.substr(svg.find("\"links\"")), "M"), 5u);
}

// Forces come with a foreign packing: colours by sign, widths by size, blue by threshold.
TEST_F(Figures, DrawsForces) {
  std::ofstream(in_folder("p.grains.csv"))
      << "id,x,y,r,vx,vy,omega\n1,0,0,.5,0,0,0\n2,1,0,.5,0,0,0\n3,2,0,.5,0,0,0\n4,3,0,.5,0,0,0\n";
  std::ofstream(in_folder("p.contacts.csv"))
      << "i,j,s1,s2,kind,h,N,T,M\n1,2,0,0,c,0,1,0,0\n2,3,0,0,c,0,-.5,0,0\n3,4,0,0,d,0,-.001,0,0\n";
  const std::string input = in_folder("p.grains.csv");
  ASSERT_EQ(run("draw " + input + " -o " + in_folder("f.svg")).code, 0);
  const std::string plain = content(in_folder("f.svg"));
  const std::string links = plain.substr(plain.find("\"links\""), plain.find("\"legend\"") - plain.find("\"links\""));
  for (const char* color : {"#d7191c", "#12964a", "#2b6fdb"}) EXPECT_EQ(count(links, color), 1u) << color;
  EXPECT_EQ(count(plain, ">distant<"), 1u);
  ASSERT_EQ(run("draw " + input + " --threshold .01 -o " + in_folder("t.svg")).code, 0);
  const std::string thresholded = content(in_folder("t.svg"));
  EXPECT_EQ(count(thresholded, ">unstressed<"), 1u);
  EXPECT_NE(thresholded.find("= "), std::string::npos);
  ASSERT_EQ(run("draw " + input + " --what stressed --threshold .01 -o " + in_folder("s.svg")).code, 0);
  const std::string stressed = content(in_folder("s.svg"));
  EXPECT_EQ(count(stressed, ">stressed cluster<"), 1u);
  EXPECT_EQ(count(stressed, ">below 0.01<"), 1u);
  ASSERT_EQ(run("draw " + input + " --what stressed --threshold .6 --width normal -o " + in_folder("s.svg")).code, 0);
  EXPECT_EQ(count(content(in_folder("s.svg")), ">tensile<"), 0u);
  ASSERT_EQ(run("draw " + input + " --what loops -o " + in_folder("l.svg")).code, 0);
  EXPECT_EQ(count(content(in_folder("l.svg")), ">on no loop<"), 1u);
  ASSERT_EQ(run("draw " + cluster("double_triangle.net") + " --what loops -o " + in_folder("l.svg")).code, 0);
  EXPECT_EQ(count(content(in_folder("l.svg")), ">self-stressed by forces<"), 1u);
}

TEST_F(Figures, DrawsClustersPoresAndModes) {
  const std::string net = cluster("double_triangle.net");
  for (const char* what : {"clusters", "pores", "modes", "velocity"}) {
    const Outcome o = run("draw " + net + " --what " + what + " -o " + in_folder("w.svg"));
    EXPECT_EQ(o.code, 0) << what << o.err;
    EXPECT_GE(count(content(in_folder("w.svg")), "<circle"), 4u) << what;
  }
  ASSERT_EQ(run("draw " + net + " --what clusters -o " + in_folder("c.svg")).code, 0);
  EXPECT_NE(content(in_folder("c.svg")).find("hyperstatic cluster"), std::string::npos);  // H = 1
  ASSERT_EQ(run("draw " + cluster("triangle.net") + " --what clusters -o " + in_folder("c.svg")).code, 0);
  EXPECT_NE(content(in_folder("c.svg")).find("isostatic cluster"), std::string::npos);  // H = 0
  // a triangle of pins has 9 - 6 rigid motions and 6 modes above them
  EXPECT_EQ(run("draw " + cluster("triangle.net") + " --what modes --mode 6 -o " + in_folder("m.svg")).code, 0);
  EXPECT_EQ(run("draw " + cluster("triangle.net") + " --what modes --mode 7 -o " + in_folder("n.svg")).code, 2);
  EXPECT_EQ(run("draw " + net + " --what grains --mode 1 -o " + in_folder("n.svg")).code, 2);
}

TEST_F(Figures, BadInputLeavesNothing) {
  const std::string net = cluster("double_triangle.net"), out = in_folder("x.svg");
  const std::size_t before = 2;  // stdout and stderr of the run itself
  for (const std::string& arguments :
       {"draw " + net, "draw " + net + " -o " + in_folder("x.gif"), "draw -o " + out,
        "draw " + net + " " + net + " -o " + out, "draw " + in_folder("none.net") + " -o " + out,
        "draw " + net + " --what forces -o " + out, "draw " + net + " --what stressed -o " + out,
        "draw " + net + " --what loops --threshold .1 -o " + out, "draw " + net + " --what tea -o " + out,
        "draw " + net + " --threshold -1 -o " + out, "draw " + net + " --what grains --threshold .1 -o " + out,
        "draw " + net + " -o " + in_folder("no/x.svg"), "plot " + net + " -o " + out,
        "plot " + in_folder("none.json") + " -o " + out, "plot -o " + out,
        "plot " + cluster("expected.tsv") + " -o " + out, "draw " + net + " --colour red -o " + out}) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_EQ(o.out, "");
    EXPECT_TRUE(o.err.starts_with("isostat: ")) << o.err;
    EXPECT_EQ(files(), before) << arguments;
  }
}

TEST_F(Figures, AnOldFigureSurvivesAFault) {
  std::ofstream(in_folder("x.svg")) << "old";
  EXPECT_EQ(run("draw " + in_folder("none.net") + " -o " + in_folder("x.svg")).code, 2);
  EXPECT_EQ(content(in_folder("x.svg")), "old");
}

TEST_F(Figures, PlotsWhatAnalyzeWrites) {
  const std::string json = in_folder("r.json");
  ASSERT_EQ(
      run("analyze " + cluster("dense_1400.net") + " --gap-tolerance 1e-4 --only counts,pores --json " + json).code, 0);
  for (const char* what : {"coordination", "pores"}) {
    const Outcome o = run("plot " + json + " --what " + what + " -o " + in_folder("r.svg"));
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_GT(count(content(in_folder("r.svg")), "<text"), 5u);
  }
  EXPECT_EQ(run("plot " + json + " -o " + in_folder("q.svg")).code, 2);  // two meanings
  EXPECT_FALSE(std::filesystem::exists(in_folder("q.svg")));
}

// The same input gives the same bytes.
TEST_F(Figures, AreReproducible) {
  for (const char* extension : {".svg", ".png"}) {
    for (const char* name : {"a", "b"})
      ASSERT_EQ(run("draw " + cluster("dense_1400.net") + " -o " + in_folder(name + std::string(extension))).code, 0);
    EXPECT_EQ(content(in_folder("a" + std::string(extension))), content(in_folder("b" + std::string(extension))));
  }
}

}  // namespace
}  // namespace isostat
