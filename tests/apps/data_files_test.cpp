// What is shipped and printed can be used: every scene of data/scenes, every study of data/studies with all its rows,
// and what the README says of scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "apps/study/study.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"
#include "dem/scene/file.hpp"

namespace isostat {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_of(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(ISOSTAT_DATA "/" + folder)) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> found_in(const std::string& text, const char* pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), expression); at != std::sregex_iterator(); ++at)
    found.push_back((*at)[1]);
  return found;
}

std::string readme() { return read_whole_file(fs::path(ISOSTAT_DATA).parent_path() / "README.md"); }

TEST(DataFiles, EveryShippedSceneIsASceneThatCanRun) {
  const auto files = files_of("scenes");
  EXPECT_GT(files.size(), 5u);
  for (const std::string& file : files) {
    try {
      const Scene scene = read_scene(file, {});
      EXPECT_FALSE(scene.stages.empty()) << file;
    } catch (const InputError& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST(DataFiles, EveryShippedStudyMakesItsRuns) {
  const auto files = files_of("studies");
  EXPECT_GT(files.size(), 3u);
  for (const std::string& file : files) {
    try {
      const Study study = read_study(file);
      EXPECT_FALSE(study.sets.empty()) << file;
      std::set<std::string> states;
      for (const StudyRun& run : runs_of(study, "out"))
        EXPECT_TRUE(states.insert(run.state()).second) << file << ": two runs of " << run.state();
      EXPECT_GE(states.size(), study.sets.size());
    } catch (const InputError& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST(DataFiles, TheReadmeNamesScenesAndKeysThatThereAre) {
  const std::string text = readme();
  const auto settings = found_in(text, "`--set ([^`]+)`");
  const auto named = found_in(text, "`([A-Za-z0-9-]+\\.toml)`");
  ASSERT_FALSE(settings.empty());
  std::set<std::string> scenes;
  for (const std::string& file : files_of("scenes")) {
    scenes.insert(fs::path(file).filename());
    EXPECT_NO_THROW(read_scene(file, settings)) << file;
  }
  EXPECT_EQ(std::set<std::string>(named.begin(), named.end()), scenes)
      << "the README's table of scenes, and the folder";
  for (const std::string& path : found_in(text, "(data/[A-Za-z0-9_./-]*[A-Za-z0-9])"))
    EXPECT_TRUE(fs::exists(fs::path(ISOSTAT_DATA).parent_path() / path)) << path;
}

}  // namespace
}  // namespace isostat
