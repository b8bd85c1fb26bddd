// `isostat draw` of several inputs: frames, films, stroboscopic pictures; and of states of triangles.
#include <gtest/gtest.h>

#include <map>

#include "dem/files/state_file.hpp"
#include "tests/apps/program.hpp"
#include "tests/support/triangle_states.hpp"

namespace isostat {
namespace {

class Film : public Program {
 protected:
  // Two disks that part, as foreign packings.
  std::string disks(int n) const {
    std::string all;
    for (int k = 0; k < n; ++k) {
      const std::string name = "p" + std::to_string(k) + ".grains.csv";
      write(name, "id,x,y,r,vx,vy,omega\n1,0,0,.5,1,0,0\n2," + std::to_string(1 + k) + ",0,.5,0,0,0\n");
      all += in_folder(name) + " ";
    }
    return all;
  }
  std::string triangles() const {
    write_state(small_bed(), in_folder("bed.h5"));
    return in_folder("bed.h5") + " ";
  }
  // Width and height in the head of a PNG.
  std::string size_of(const std::string& png) const { return content(in_folder(png)).substr(16, 8); }
  static std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++n;
    return n;
  }
};

TEST_F(Film, FramesAreOfOneSize) {
  const std::string inputs = disks(3);
  const Outcome o = run("draw " + inputs + "--what grains -o " + in_folder("frames/"));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(size_of("frames/frame0001.png"), size_of("frames/frame0002.png"));
  EXPECT_EQ(size_of("frames/frame0001.png"), size_of("frames/frame0003.png"));
  EXPECT_NE(content(in_folder("frames/frame0001.png")), content(in_folder("frames/frame0002.png")));
  EXPECT_FALSE(exists("frames/frame0004.png"));
  // the folder is there now; fewer frames than it holds would leave the end of another film behind
  EXPECT_EQ(run("draw " + inputs + "-o " + in_folder("frames")).code, 0);
  const Outcome fewer = run("draw " + disks(2) + "-o " + in_folder("frames"));
  EXPECT_EQ(fewer.code, 2);
  EXPECT_NE(fewer.err.find("frame0003.png"), std::string::npos) << fewer.err;
}

TEST_F(Film, PlaysInOneFile) {
  const std::string inputs = disks(3);
  ASSERT_EQ(run("draw " + inputs + "--fps 4 -o " + in_folder("film.html")).code, 0);
  const std::string page = content(in_folder("film.html"));
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_EQ(count(page, "<g class=\"frame\""), 3u);
  EXPECT_NE(page.find("framesPerSecond = 4"), std::string::npos);
  for (const char* name : {"p0.grains.csv", "p1.grains.csv", "p2.grains.csv"})
    EXPECT_EQ(count(page, std::string(">") + name + "<"), 1u);
  ASSERT_EQ(run("draw " + inputs + "--fps 4 -o " + in_folder("film.svg")).code, 0);
  const std::string film = content(in_folder("film.svg"));
  EXPECT_EQ(count(film, "<animate "), 3u);
  EXPECT_NE(film.find("dur=\"0.75s\""), std::string::npos);
  ASSERT_EQ(run("draw " + inputs + "--stroboscopic -o " + in_folder("s.svg")).code, 0);
  EXPECT_EQ(count(content(in_folder("s.svg")), "<animate "), 0u);
  EXPECT_EQ(count(content(in_folder("s.svg")), "<circle"), 6u);
}

TEST_F(Film, RefusesWhatIsNoFilm) {
  const std::string two = disks(2), one = disks(1), out = " -o " + in_folder("x.svg");
  for (const std::string& arguments :
       {two + out, two + "-o " + in_folder("x.png"), two + "--fps 5 -o " + in_folder("x.png"), two + "--fps 0" + out,
        two + "--fps 5 --stroboscopic" + out, two + "--stroboscopic -o " + in_folder("x.html"),
        two + "--fps 5 --what modes" + out, two + "--fps 5 -o " + in_folder("x/"), two + "-o " + in_folder("no/x.html"),
        two + "-o " + in_folder("no/x/"), one + triangles() + "--fps 5" + out}) {
    const Outcome o = run("draw " + arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_EQ(count(o.err, "\n"), 1u) << o.err;
  }
  for (const char* name : {"x.svg", "x.png", "x.html", "x"}) EXPECT_FALSE(exists(name)) << name;
}

TEST_F(Film, DrawsGrainsOfTriangles) {
  const std::string bed = triangles();
  const std::map<std::string, std::string> shows{
      {"grains", "lid"}, {"forces", "beam, stretched"}, {"velocity", "cm/s"}, {"clusters", "single"}};
  for (const auto& [what, text] : shows) {
    const Outcome o = run("draw " + bed + "--what " + what + " -o " + in_folder(what + ".svg"));
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_NE(content(in_folder(what + ".svg")).find(text), std::string::npos) << what;
  }
  EXPECT_EQ(run("draw " + bed + "--what pores -o " + in_folder("x.svg")).code, 2);
  State<TriangleGrains> later = small_bed();
  later.time = 0.75;
  write_state(later, in_folder("later.h5"));
  ASSERT_EQ(run("draw " + bed + in_folder("later.h5") + " -o " + in_folder("f.html")).code, 0);
  const std::string film = content(in_folder("f.html"));
  for (const char* time : {"= 0.25", "= 0.75"}) EXPECT_EQ(count(film, time), 1u);  // [s] above its frame
  EXPECT_EQ(count(film, "<use href=\"#walls\"/>"), 1u);
}

}  // namespace
}  // namespace isostat
