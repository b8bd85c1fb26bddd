// `isostat draw` and `convert` of packings in space: views, slices, films, refusals.
#include <gtest/gtest.h>

#include "dem/files/state_file.hpp"
#include "dem/spheres/spheres.hpp"
#include "tests/apps/program.hpp"

namespace isostat {
namespace {

class DrawSpheres : public Program {
 protected:
  static std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++n;
    return n;
  }
  // Two spheres that touch, the second at `x`, and a third.
  std::string spheres(const std::string& name, double x, bool forces = true) const {
    write(name + ".grains.csv", "id,x,y,z,r,vx,vy,vz,wx,wy,wz\n1,1,1,1,.5,1,0,0,0,0,0\n2," + std::to_string(x) +
                                    ",1,1,.5,0,1,0,0,0,0\n3,3,3,2.2,.5,0,0,0,0,0,0\n");
    write(name + ".contacts.csv", std::string("i,j,kind,N\n1,2,c,") + (forces ? "2\n" : "0\n"));
    EXPECT_EQ(run("convert " + in_folder(name + ".grains.csv") + " --box 4,4,4 -o " + in_folder(name + ".h5")).code, 0);
    return in_folder(name + ".h5") + " ";
  }
};

TEST_F(DrawSpheres, FromAllSides) {
  const std::string state = spheres("a", 2);
  for (const char* view : {"", "--view x ", "--view=-30,45 ", "--view z --what grains ", "--what velocity "})
    for (const char* end : {".svg", ".pdf", ".png"}) {
      const Outcome o = run("draw " + state + view + "-o " + in_folder(std::string("p") + end));
      ASSERT_EQ(o.code, 0) << view << o.err;
    }
  ASSERT_EQ(run("draw " + state + "--view -30,45 -o " + in_folder("one.svg")).code, 0);
  ASSERT_EQ(run("draw " + state + "--view=-30,45 -o " + in_folder("two.svg")).code, 0);
  EXPECT_EQ(content(in_folder("one.svg")), content(in_folder("two.svg")));
  EXPECT_EQ(count(content(in_folder("one.svg")), "<circle"), 4u);  // all are rattlers: one in the legend
  EXPECT_NE(content(in_folder("one.svg")).find("compressive"), std::string::npos);
}

TEST_F(DrawSpheres, RigidClusters) {
  write("four.net",
        "grain 1 0 0 0 .5\ngrain 2 1 0 0 .5\ngrain 3 .5 .8660254 0 .5\ngrain 4 .5 .2886751 .8164966 .5\ngrain 5 3 0 0 "
        ".5\n"
        "contact 1 2 c\ncontact 1 3 c\ncontact 2 3 c\ncontact 1 4 c\ncontact 2 4 c\ncontact 3 4 c\n");
  ASSERT_EQ(run("draw " + in_folder("four.net") + " --what clusters -o " + in_folder("c.svg")).code, 0);
  const std::string picture = content(in_folder("c.svg"));
  EXPECT_EQ(count(picture, "<circle"), 7u);  // two in the legend; 18 rows hold 24 - 6 dofs
  EXPECT_NE(picture.find("isostatic cluster"), std::string::npos);
  EXPECT_NE(picture.find("single"), std::string::npos);
}

TEST_F(DrawSpheres, Slices) {
  const std::string state = spheres("a", 2);
  ASSERT_EQ(run("draw " + state + "--slice z=1.3 --what grains -o " + in_folder("s.svg")).code, 0);
  EXPECT_EQ(count(content(in_folder("s.svg")), "<circle"), 2u);
  ASSERT_EQ(run("draw " + state + "--slice z=5.3 --what grains -o " + in_folder("t.svg")).code, 0);  // an image
  EXPECT_EQ(count(content(in_folder("t.svg")), "<circle"), 2u);
}

TEST_F(DrawSpheres, FilmsHaveFramesOfOneSize) {
  const std::string inputs = spheres("a", 2) + spheres("b", 2.1) + spheres("c", 2.2);
  ASSERT_EQ(run("draw " + inputs + "-o " + in_folder("frames/")).code, 0);
  const auto size = [&](const char* png) { return content(in_folder(png)).substr(16, 8); };
  EXPECT_EQ(size("frames/frame0001.png"), size("frames/frame0002.png"));
  EXPECT_EQ(size("frames/frame0001.png"), size("frames/frame0003.png"));
  ASSERT_EQ(run("draw " + inputs + "--what grains -o " + in_folder("film.html")).code, 0);
  EXPECT_EQ(count(content(in_folder("film.html")), "<g class=\"frame\""), 3u);
  ASSERT_EQ(run("draw " + inputs + "--slice z=1 --fps 5 -o " + in_folder("film.svg")).code, 0);
  EXPECT_EQ(count(content(in_folder("film.svg")), "<animate "), 3u);
  EXPECT_EQ(run("draw " + inputs + "--stroboscopic -o " + in_folder("s.svg")).code, 0);
}

TEST_F(DrawSpheres, RefusesWithOneSentence) {
  const std::string state = spheres("a", 2), still = spheres("still", 2, false), out = "-o " + in_folder("x.svg");
  write("flat.net", "grain 1 0 0 .5\ngrain 2 1 0 .5\ncontact 1 2 c\n");
  const std::string flat = in_folder("flat.net") + " ";
  for (const std::string& arguments :
       {state + "--what pores ", state + "--what modes ", state + "--slice z=1 --what clusters ", state + "--view w ",
        state + "--view 10 ", state + "--view 10,91 ", state + "--view 10,2x ", state + "--view nan,0 ",
        state + "--slice z ", state + "--slice w=1 ", state + "--slice z=one ", state + "--slice z=1 --view z ",
        state + "--slice z=3.5 ", state + "--what grains --threshold 1 ", still + "--what forces ", flat + "--view x ",
        flat + "--slice z=0 ", state + flat + "--fps 5 "}) {
    const Outcome o = run("draw " + arguments + out);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_EQ(count(o.err, "\n"), 1u) << o.err;
    EXPECT_FALSE(exists("x.svg")) << arguments;
  }
}

TEST_F(DrawSpheres, ParaViewHasGroupsAndWalls) {
  spheres("a", 2);
  State<Spheres> state = read_state<Spheres>(in_folder("a.h5"));
  state.law.grain.modulus = 1e4;
  state.packing.group = {0, 1, 1};
  state.packing.walls = {{WallShape::plane, {{0, 0, 0.5}}, {{0, 0, 1}}, 0, {}, SphereWall::kEveryGroup}};
  state.packing.wall_links = {{0, 0, LinkKind::closed, 0, 2, {}}};
  write_state(state, in_folder("w.h5"));
  ASSERT_EQ(run("convert " + in_folder("w.h5") + " -o " + in_folder("w.vtp")).code, 0);
  const std::string vtp = content(in_folder("w.vtp"));
  EXPECT_NE(vtp.find("Name=\"group\""), std::string::npos);
  EXPECT_NE(vtp.find("NumberOfPoints=\"4\" NumberOfVerts=\"3\" NumberOfLines=\"2\""), std::string::npos);
  ASSERT_EQ(run("draw " + in_folder("w.h5") + " --what grains -o " + in_folder("w.svg")).code, 0);
  EXPECT_NE(content(in_folder("w.svg")).find("group 1"), std::string::npos);
}

}  // namespace
}  // namespace isostat
