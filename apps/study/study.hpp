// A study: parameter sets times seeds. Read from a TOML file (docs/study.md), every scene of it resolved and checked.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/input.hpp"
#include "apps/study/curves.hpp"
#include "apps/study/derived.hpp"
#include "dem/scene/scene.hpp"

namespace isostat {

// One row of the table, or one point of the grid on it.
struct ParameterSet {
  std::string name;                                           // unique, safe as a file name
  std::string scene_path;                                     // as it can be opened from here
  std::vector<std::pair<std::string, std::string>> settings;  // scene key, TOML literal; each key once
  std::vector<std::uint64_t> seeds;
  std::vector<std::size_t> stages;  // after which stages it is analysed; empty: after the last
  Scene scene;                      // resolved
};

// What of each state goes into the tables.
struct StudyAnalysis {
  std::vector<std::string> sections;
  AnalysisOptions options;
};

struct Study {
  std::string path;
  std::vector<ParameterSet> sets;
  std::vector<std::string> keys;  // scene keys that the study sets, in order of appearance
  StudyAnalysis analysis;
  std::vector<DerivedColumn> derived;
  std::vector<PathSlope> slopes;
  std::vector<SeriesCurve> curves;
};

// Throws one InputError with every fault: of the study's own keys, and of the scenes that its settings make.
Study read_study(const std::string& path);

// One run of the study, and where its files are.
struct StudyRun {
  const ParameterSet* set = nullptr;
  std::uint64_t seed = 0;
  std::string base;  // DIR/NAME.SEED

  // {seed} in the name of grains.file is the number of the sample, as in the names of its files.
  Scene scene() const;
  std::string state() const { return base + ".h5"; }
  std::string record() const { return base + ".run.json"; }
  std::string series() const { return set->scene.output.series.empty() ? "" : base + ".series.csv"; }
  // After a stage (none: the last): the state, and its report.
  std::string state(std::optional<std::size_t> stage) const;
  std::string report(std::optional<std::size_t> stage) const;
  std::string command() const;  // `pack ...` that makes the same state
};

std::vector<StudyRun> runs_of(const Study& study, const std::string& directory);

// The stages of a set after which its states are analysed; none stands for the last.
std::vector<std::optional<std::size_t>> analysed_stages(const ParameterSet& set);

// The value of a scene key in a set as plain text: without quotes, empty where it does not apply.
std::string value_of(const ParameterSet& set, const std::string& key);

// Numbers of the stage after which a state is analysed, as `stage.pressure`: of its scene keys those that differ
// between the rows of the table.
std::vector<std::string> stage_columns(const Study& study);
std::string stage_value(const ParameterSet& set, std::optional<std::size_t> stage, const std::string& column);

// The first scene key in which two scenes differ, as "KEY = THERE, not HERE"; empty if they are the same.
std::string first_difference(const Scene& there, const Scene& here);

}  // namespace isostat
