#include "apps/study/parameter_sets.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "dem/scene/file.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

constexpr const char* kStatesKey = "output.stages";  // scene key that keeps a state after each stage

class SetMaker {
 public:
  SetMaker(const StudyFile& file, Study& study, StudyFaults& faults) : file_(file), study_(study), faults_(faults) {}

  void make() {
    std::size_t points = 1;
    for (const GridAxis& axis : file_.grid) points = std::min(points * axis.choices.size(), kMostRuns + 1);
    if (points * file_.rows.size() > kMostRuns)
      return faults_.add(0, "grid", "", "makes more than " + std::to_string(kMostRuns) + " parameter sets");
    std::set<std::string> names;
    for (const StudyRow& row : file_.rows) {
      if (row.scene.empty() || row.name.empty()) continue;  // faults of the file
      for (std::size_t point = 0; point < points; ++point) {
        std::string name = row.name;
        std::vector<Setting> settings = row.settings;
        std::size_t rest = point, block = points;
        for (const GridAxis& axis : file_.grid) {  // the last axis runs fastest
          block /= axis.choices.size();
          settings.push_back(axis.choices[rest / block]);
          name += name_part(axis, rest / block);
          rest %= block;
        }
        add_set(row, name, std::move(settings));
        const ParameterSet& set = study_.sets.back();
        bool fresh = names.insert(set.name).second;
        for (const std::size_t stage : set.stages)
          fresh = names.insert(set.name + ".stage" + std::to_string(stage)).second && fresh;
        if (!fresh) faults_.add(row.line, "name", quoted_text(set.name), "names two parameter sets");
        if (!is_safe_name(set.name))
          faults_.add(row.line, "name", quoted_text(set.name), "too long, or no name of a file");
      }
    }
  }

 private:
  // The part of a name that tells a choice: friction=0.15, or the whole key where its last component is not enough.
  std::string name_part(const GridAxis& axis, std::size_t choice) const {
    const auto leaf = [](const std::string& key) { return key.substr(key.rfind('.') + 1); };
    const auto same = std::count_if(file_.grid.begin(), file_.grid.end(),
                                    [&](const GridAxis& other) { return leaf(other.key) == leaf(axis.key); });
    std::string text = (same > 1 ? axis.key : leaf(axis.key)) + "=" + axis.choices[choice].value;
    std::string safe;
    for (const char c : text)
      if (c != '"') safe += kNameLetters.find(c) == std::string_view::npos ? '_' : c;
    return "-" + safe;
  }

  void add_set(const StudyRow& row, std::string name, std::vector<Setting> settings) {
    ParameterSet set;
    set.name = std::move(name);
    set.scene_path = (std::filesystem::path(faults_.path()).parent_path() / row.scene).string();
    set.seeds = row.seeds;
    set.stages = row.stages;
    for (const Setting& s : settings)
      if (std::find(study_.keys.begin(), study_.keys.end(), s.key) == study_.keys.end()) study_.keys.push_back(s.key);
    std::optional<Scene> scene = resolved(set, settings);
    if (scene && row.all_stages)
      for (std::size_t k = 0; k < scene->stages.size(); ++k) set.stages.push_back(k);
    if (scene && !set.stages.empty() && check_stages(row, set.name, set.stages, scene->stages.size() - 1)) {
      std::erase_if(settings, [](const Setting& s) { return s.key == kStatesKey; });
      settings.push_back({kStatesKey, "true", row.line});
      scene = resolved(set, settings);
    }
    if (scene) set.scene = *scene;
    for (Setting& s : settings) set.settings.emplace_back(std::move(s.key), std::move(s.value));
    study_.sets.push_back(std::move(set));
  }

  // Whether states after other stages than the last are needed, and there are such stages.
  bool check_stages(const StudyRow& row, const std::string& name, const std::vector<std::size_t>& stages,
                    std::size_t last) {
    bool between = false, possible = true;
    for (const std::size_t stage : stages) {
      between = between || stage < last;
      if (stage <= last) continue;
      possible = false;
      faults_.add(row.line, "stages", std::to_string(stage),
                  "no such stage in " + name + ": the last is " + std::to_string(last) + ", counted from 0");
    }
    return between && possible;
  }

  // Faults of a setting stand at its line of the study.
  std::optional<Scene> resolved(const ParameterSet& set, const std::vector<Setting>& settings) {
    std::vector<std::string> overrides;
    for (const Setting& s : settings) overrides.push_back(s.key + "=" + s.value);
    try {
      return read_scene(set.scene_path, overrides);
    } catch (const InputError& error) {
      add(error, set, settings);
    }
    if (!std::filesystem::exists(set.scene_path)) check_alone(overrides, set, settings);
    return std::nullopt;
  }

  void add(const InputError& error, const ParameterSet& set, const std::vector<Setting>& settings) {
    for (Fault f : error.faults()) {
      if (f.file == "--set") {
        f.file = faults_.path();
        for (const Setting& s : settings)
          if (s.key == f.key) f.line = s.line;
      }
      faults_.add_of_scene(std::move(f), set.name);
    }
  }

  // Without its scene a setting can still be seen to be no key, or no value of its key; which stages there would be and
  // of which system the scene is, nobody knows.
  void check_alone(const std::vector<std::string>& overrides, const ParameterSet& set,
                   const std::vector<Setting>& settings) {
    for (std::size_t k = 0; k < overrides.size(); ++k) {
      if (settings[k].key.starts_with("stage.")) continue;
      bool sound = false;
      std::optional<InputError> first;
      for (const std::string_view system : kSystemNames) try {
          (void)parse_scene("system = \"" + std::string(system) + "\"\n", set.scene_path, {overrides[k]},
                            SceneChecks::keys);
          sound = true;
        } catch (const InputError& error) {
          if (!first) first = error;
        }
      if (!sound) add(*first, set, settings);
    }
  }

  const StudyFile& file_;
  Study& study_;
  StudyFaults& faults_;
};

}  // namespace

void make_parameter_sets(const StudyFile& file, Study& study, StudyFaults& faults) {
  SetMaker(file, study, faults).make();
}

}  // namespace isostat
