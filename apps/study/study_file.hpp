// What a study file (TOML, docs/study.md) says: rows and a grid of settings, not yet multiplied.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "apps/study/study.hpp"
#include "apps/study/study_faults.hpp"

namespace isostat {

inline constexpr std::size_t kMostRuns = 1'000'000;

struct Setting {
  std::string key, value;  // scene key, TOML literal
  int line = 0;
};

// One [[row]], or the file itself if it has none; with the settings and the scene that hold for all rows.
struct StudyRow {
  std::string name, scene;
  std::vector<Setting> settings;
  std::vector<std::uint64_t> seeds;
  std::vector<std::size_t> stages;
  bool all_stages = false;  // of the scene, whatever their number
  int line = 0;
};

struct GridAxis {
  std::string key;
  std::vector<Setting> choices;
};

// Expressions of columns, not yet read (derived_columns.hpp).
struct DerivedText {
  std::string name, of;
  int line = 0;
};
struct SlopeText {
  std::string name, x, y;
  std::vector<std::size_t> stages;
  int line = 0;
};

struct CurveText {
  std::string name, x, y;
  double step = 0;
  std::size_t stage = 0;
  int line = 0;
};

struct StudyFile {
  std::vector<StudyRow> rows;
  std::vector<GridAxis> grid;
  StudyAnalysis analysis;
  std::vector<DerivedText> derived;  // in the order of the file
  std::vector<SlopeText> slopes;
  std::vector<CurveText> curves;
};

// Reads faults.path(); adds what is wrong with its keys to the faults. Throws InputError if it is no TOML.
StudyFile read_study_file(StudyFaults& faults);

// Names of parameter sets become names of files.
inline constexpr std::string_view kNameLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_+=";
bool is_safe_name(const std::string& name);

}  // namespace isostat
