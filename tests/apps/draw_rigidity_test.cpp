// draw --what clusters and --what modes, through the program.
#include "tests/apps/program.hpp"

namespace isostat {
namespace {

const std::string kClusters = ISOSTAT_DATA "/clusters/";

class DrawRigidity : public Program {
 protected:
  Outcome draw(const std::string& cluster, const std::string& options) const {
    return run("draw " + kClusters + cluster + ".net -o " + in_folder("picture.svg") + " " + options);
  }
  bool shows(const std::string& text) const {
    return content(in_folder("picture.svg")).find(text) != std::string::npos;
  }
};

TEST_F(DrawRigidity, ClustersAndHinges) {
  ASSERT_EQ(draw("sliding_spin3", "--what clusters").code, 0);
  EXPECT_TRUE(shows("hyperstatic cluster"));
  EXPECT_TRUE(shows("hinge"));
  ASSERT_EQ(draw("triangle", "--what clusters").code, 0);
  EXPECT_TRUE(shows("isostatic cluster"));
  EXPECT_FALSE(shows("hyperstatic cluster"));
  EXPECT_FALSE(shows("hinge"));
  EXPECT_FALSE(shows("single"));
}

TEST_F(DrawRigidity, ModesByNumber) {
  ASSERT_EQ(draw("double_triangle", "--what modes").code, 0);
  const std::string first = content(in_folder("picture.svg"));
  ASSERT_EQ(draw("double_triangle", "--what modes --mode 2").code, 0);
  EXPECT_NE(first, content(in_folder("picture.svg")));
}

TEST_F(DrawRigidity, RefusesModesThatAreNotThere) {
  EXPECT_EQ(draw("double_triangle", "--what modes --mode 10").code, 2);
  EXPECT_EQ(draw("double_triangle", "--what clusters --mode 1").code, 2);
  EXPECT_FALSE(std::filesystem::exists(in_folder("picture.svg")));
}

}  // namespace
}  // namespace isostat
