#include "apps/study/study.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string_view>

#include "apps/study/derived_columns.hpp"
#include "apps/study/parameter_sets.hpp"
#include "apps/study/study_file.hpp"
#include "dem/scene/keys.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

std::string stage_suffix(std::optional<std::size_t> stage) {
  return stage ? ".stage" + std::to_string(*stage) : std::string();
}

std::string unquoted(std::string text) {
  return text.size() >= 2 && text.front() == '"' ? text.substr(1, text.size() - 2) : text;
}

std::string four_digits(std::uint64_t seed) {
  char number[32];
  std::snprintf(number, sizeof number, "%04llu", static_cast<unsigned long long>(seed));
  return number;
}

std::string with_seed(std::string text, std::uint64_t seed) {
  constexpr std::string_view kSeed = "{seed}";
  for (std::size_t at = 0; (at = text.find(kSeed, at)) != std::string::npos;)
    text.replace(at, kSeed.size(), four_digits(seed));
  return text;
}

}  // namespace

Study read_study(const std::string& path) {
  StudyFaults faults(path);
  const StudyFile file = read_study_file(faults);
  Study study;
  study.path = path;
  study.analysis = file.analysis;
  make_parameter_sets(file, study, faults);
  make_derived_columns(file, study, faults);
  faults.raise();
  return study;
}

Scene StudyRun::scene() const {
  Scene own = set->scene;
  own.grains.file = with_seed(own.grains.file, seed);
  return own;
}

std::string StudyRun::state(std::optional<std::size_t> stage) const {
  return stage && *stage + 1 == set->scene.stages.size() ? state() : base + stage_suffix(stage) + ".h5";
}

std::string StudyRun::report(std::optional<std::size_t> stage) const {
  return base + stage_suffix(stage) + ".analysis.json";
}

std::string StudyRun::command() const {
  std::string text = "pack " + set->scene_path;
  for (const auto& [key, value] : set->settings)
    text += " --set " + key + "=" + (key == "grains.file" ? with_seed(value, seed) : value);
  return text;
}

std::vector<StudyRun> runs_of(const Study& study, const std::string& directory) {
  std::vector<StudyRun> runs;
  for (const ParameterSet& set : study.sets)
    for (const std::uint64_t seed : set.seeds)
      runs.push_back({&set, seed, (std::filesystem::path(directory) / (set.name + "." + four_digits(seed))).string()});
  return runs;
}

std::vector<std::optional<std::size_t>> analysed_stages(const ParameterSet& set) {
  std::vector<std::optional<std::size_t>> stages(set.stages.begin(), set.stages.end());
  if (stages.empty()) stages.emplace_back();
  return stages;
}

// A setting of a stage is told as given: the resolved scene may have other stages than the file.
std::string value_of(const ParameterSet& set, const std::string& name) {
  const auto given =
      std::find_if(set.settings.begin(), set.settings.end(), [&](const auto& s) { return s.first == name; });
  for (const SceneKey& key : scene_keys(set.scene.system)) {
    const std::size_t copies = belongs_to_stage(key) ? set.scene.stages.size() : 1;
    for (std::size_t stage = 0; stage < copies; ++stage) {
      if (full_name(key, stage) != name) continue;
      if (!applies(key, set.scene)) return "";
      if (belongs_to_stage(key) && given != set.settings.end()) return unquoted(given->second);
      return unquoted(value_text(key, set.scene, stage));
    }
  }
  return given == set.settings.end() ? "" : unquoted(given->second);
}

std::string stage_value(const ParameterSet& set, std::optional<std::size_t> stage, const std::string& column) {
  const std::size_t last = set.scene.stages.size() - 1;
  for (const SceneKey& key : scene_keys(set.scene.system))
    if (key.name == column && applies(key, set.scene)) return value_text(key, set.scene, stage.value_or(last));
  return "";
}

std::vector<std::string> stage_columns(const Study& study) {
  std::vector<std::string> columns;
  for (const SceneKey& key : scene_keys()) {
    if (!belongs_to_stage(key)) continue;
    std::string first;
    bool any = false, differs = false;
    for (const ParameterSet& set : study.sets)
      for (const auto stage : analysed_stages(set)) {
        const std::string value = stage_value(set, stage, std::string(key.name));
        differs = differs || (any && value != first);
        if (!any) first = value;
        any = true;
      }
    const std::string name(key.name);
    if (differs && std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
  }
  return columns;
}

std::string first_difference(const Scene& there, const Scene& here) {
  const std::size_t stages = std::min(there.stages.size(), here.stages.size());
  for (const SceneKey& key : scene_keys(here.system)) {
    const std::size_t copies = belongs_to_stage(key) ? stages : 1;
    for (std::size_t stage = 0; stage < copies; ++stage) {
      const std::string old_value = applies(key, there) ? value_text(key, there, stage) : "";
      const std::string new_value = applies(key, here) ? value_text(key, here, stage) : "";
      if (old_value == new_value) continue;
      const auto shown = [](const std::string& text) { return text.empty() ? std::string("absent") : text; };
      return full_name(key, stage) + " = " + shown(old_value) + ", not " + shown(new_value);
    }
  }
  if (there.stages.size() == here.stages.size()) return "";
  return std::to_string(there.stages.size()) + " stages, not " + std::to_string(here.stages.size());
}

}  // namespace isostat
