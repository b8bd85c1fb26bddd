// Starting from a file: what is taken over from it, and what is refused.
#include "dem/disks/sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "dem/disks/scales.hpp"
#include "dem/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

class StartFromFile : public ::testing::Test {
 protected:
  StartFromFile() {
    scene_.grains.file = path_;
    scene_.law.normal_stiffness = 1e4;
  }

  void file(const std::string& text) const { std::ofstream(path_) << text; }
  std::string refusal() const {
    try {
      (void)initial_disks(scene_, 1);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "start.net";
  Scene scene_;
};

TEST_F(StartFromFile, TheHeaviestGrainSetsTheStepAndTheLightestItsBound) {
  file("cell 10 8\ngrain 0 1 1 0.5\ngrain 1 4 4 0.25\n");
  scene_.step.fraction = 0.12;
  const State<Disks> s = initial_disks(scene_, 1);
  EXPECT_DOUBLE_EQ(s.time_step, 0.12 / std::sqrt(1e4));
  EXPECT_EQ(s.packing.bodies.size(), 2u);
  EXPECT_EQ(s.packing.cell->length, (Vec2{{10, 8}}));

  file("cell 10 8\ngrain 0 1 1 0.5\ngrain 1 4 4 0.025\n");
  const double bound = critical_time_step(s.law, 0.05) * std::sqrt(1e4);
  ASSERT_GT(0.12, bound);
  EXPECT_THAT(refusal(), HasSubstr("unstable for the smallest grain"));
  EXPECT_THAT(refusal(), HasSubstr("step.fraction"));
  scene_.step.fraction = 0.99 * bound;
  EXPECT_EQ(refusal(), "");
}

TEST_F(StartFromFile, WithoutACellOnlyWhatNeedsOneIsRefused) {
  file("grain 0 1 1 0.5\n");
  EXPECT_EQ(refusal(), "");
  scene_.stages.resize(3);
  EXPECT_EQ(refusal(), "");
  scene_.stages[1].pressure = 0.1;
  scene_.stages[2].strain_rate_2 = -1e-3;
  scene_.output.snapshot_solid_fractions = {0.5};
  for (const char* key : {"stage.1.pressure", "stage.2.strain_rate_2", "output.snapshot_solid_fractions"})
    EXPECT_THAT(refusal(), HasSubstr(std::string(key) + ": needs a periodic cell"));
}

TEST_F(StartFromFile, DeepOverlapsAndWhatIsNoPackingOfDisksAreRefused) {
  file("cell 10 8\ngrain 0 1 1 0.5\ngrain 1 1.8 1 0.5\n");
  EXPECT_THAT(refusal(), HasSubstr("overlap by 0.2"));
  file("cell 10 8\n");
  EXPECT_NE(refusal(), "");
}

}  // namespace
}  // namespace isostat
