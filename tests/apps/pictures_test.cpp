// The look of every picture and plot, held by one approved SVG each in tests/golden/pictures: the same marks in the
// same order, coordinates to a fiftieth of a point. With ISOSTAT_REGENERATE=1 they are written anew: look at them
// before they are committed.
#include <cstdlib>

#include "tests/apps/program.hpp"
#include "tests/support/picture_difference.hpp"

namespace isostat {
namespace {

namespace fs = std::filesystem;

class Pictures : public Program {
 protected:
  static std::string golden(const std::string& name) {
    return (fs::path(ISOSTAT_DATA).parent_path() / "tests/golden/pictures" / name).string();
  }

  // Seven grains in a cell, with forces of both signs, as a state.
  std::string packing() const {
    EXPECT_EQ(run("convert " + golden("packing.grains.csv") + " --box 2.9,2.2 -o " + in_folder("packing.h5")).code, 0);
    return in_folder("packing.h5");
  }

  // A self-stressed double triangle, and a pair that pushes.
  std::string knot() const {
    write("knot.grains.csv",
          "id,x,y,r\n0,0,0,.5\n1,1,0,.5\n2,.5,.8660254037844386,.5\n3,.5,-.8660254037844386,.5\n4,3,0,.5\n5,4,0,.5\n");
    write("knot.contacts.csv",
          "i,j,N,T\n0,1,.4,0\n0,2,-.1,.1732\n1,2,-.1,-.1732\n0,3,-.1,-.1732\n1,3,-.1,.1732\n4,5,.2,0\n");
    return in_folder("knot.grains.csv");
  }

  void expect_approved(const std::string& command, const std::string& name) const {
    const Outcome o = run(command + " -o " + in_folder(name));
    ASSERT_EQ(o.code, 0) << name << ": " << o.err;
    if (std::getenv("ISOSTAT_REGENERATE"))
      fs::copy_file(in_folder(name), golden(name), fs::copy_options::overwrite_existing);
    ASSERT_TRUE(fs::exists(golden(name))) << name;
    EXPECT_EQ(picture_difference(content(golden(name)), content(in_folder(name))), "") << name;
  }
};

TEST_F(Pictures, OfAPacking) {
  const std::string draw = "draw " + packing() + " --what ";
  for (const std::string what : {"grains", "forces", "velocity"}) expect_approved(draw + what, what + ".svg");
  expect_approved(draw + "forces --threshold 0.045 --width total", "threshold.svg");
  expect_approved("draw " + knot() + " --what stressed", "stressed.svg");
  expect_approved("draw " + knot() + " --what loops", "loops.svg");
  expect_approved("draw " + golden("cluster.net") + " --what modes --mode 2", "modes.svg");
  expect_approved("draw " + golden("holes.net") + " --what pores", "pores.svg");
  expect_approved("draw " ISOSTAT_DATA "/clusters/double_triangle.net --what clusters", "clusters.svg");
}

// What crosses the slanted edges of the cell is drawn at both of them.
TEST_F(Pictures, OfATiltedCell) {
  const std::string leaning = golden("leaning.csv");
  expect_approved("draw " + leaning + " --what forces", "leaning-forces.svg");
  expect_approved("draw " + leaning + " --what pores", "leaning-pores.svg");
}

TEST_F(Pictures, OfResults) {
  ASSERT_EQ(run("analyze " + packing() + " --only counts,forces --json " + in_folder("r.json")).code, 0);
  ASSERT_EQ(
      run("analyze " ISOSTAT_DATA "/clusters/periodic_free_cluster.net --only scattering --json " + in_folder("s.json"))
          .code,
      0);
  ASSERT_EQ(run("analyze " + knot() + " --only stressed,loops,two_contacts --json " + in_folder("n.json")).code, 0);
  ASSERT_EQ(run("analyze " ISOSTAT_DATA "/clusters/dense_1400.net --only dacf --json " + in_folder("c.json")).code, 0);
  for (const std::string what : {"stressed", "loops", "two-contacts"})
    expect_approved("plot " + in_folder("n.json") + " --what " + what, "plot-" + what + ".svg");
  expect_approved("plot " + in_folder("c.json") + " --what correlation", "plot-correlation.svg");
  ASSERT_EQ(run("analyze " + golden("holes.net") + " --only pores --json " + in_folder("p.json")).code, 0);
  for (const std::string what : {"force-histogram", "angle", "NT", "coordination"})
    expect_approved("plot " + in_folder("r.json") + " --what " + what, "plot-" + what + ".svg");
  expect_approved("plot " + in_folder("s.json") + " --what scattering", "plot-scattering.svg");
  expect_approved("plot " + in_folder("p.json") + " --what pores", "plot-pores.svg");
  ASSERT_EQ(
      run("analyze " ISOSTAT_DATA "/clusters/dense_1400.net --law frictionless --only modes --density-of-states 40 "
          "--random-vectors 4 --json " +
          in_folder("d.json"))
          .code,
      0);
  expect_approved("plot " + in_folder("d.json") + " --what density-of-states", "plot-density-of-states.svg");
  ASSERT_EQ(run("analyze " ISOSTAT_DATA "/clusters/periodic_triangular4.net --only modes --modes all "
                "--density-of-states 20 --json " +
                in_folder("e.json"))
                .code,
            0);
  expect_approved("plot " + in_folder("e.json"), "plot-all-modes.svg");
  expect_approved("plot " + golden("../soft-particle.json") + " --what law-fit", "plot-law-fit.svg");
  expect_approved("plot " + golden("series.csv") + " --what series", "plot-series.svg");
  expect_approved("plot " + golden("bench.csv") + " --what bench", "plot-bench.svg");
  expect_approved("plot " + golden("study.csv") + " --what study --x law.friction --y z", "plot-study.svg");
}

}  // namespace
}  // namespace isostat
