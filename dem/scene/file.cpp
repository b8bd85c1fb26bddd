#include "dem/scene/file.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <deque>
#include <optional>
#include <set>
#include <sstream>

#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"
#include "dem/scene/check.hpp"
#include "dem/scene/deep_keys.hpp"
#include "dem/scene/keys.hpp"
#include "dem/scene/suggestion.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

// One key as given, by the file or by --set.
struct Given {
  std::string key;  // full name
  const toml::node* node;
  std::string file;
  int line;
};

std::string text_of(const toml::node& node) {
  if (const auto* real = node.as_floating_point()) return real_text(real->get());
  if (const auto* text = node.as_string()) return quoted_text(text->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  std::ostringstream out;
  out << toml::node_view<const toml::node>(&node);
  return out.str();
}

// Table keys joined by dots; a key with unusual characters keeps its quotes and so can match no known key.
std::string path_of(const std::string& parent, std::string_view key) {
  const bool bare = !key.empty() && key.find_first_not_of(
                                        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                        "0123456789_-") == std::string_view::npos;
  return (parent.empty() ? "" : parent + ".") + (bare ? std::string(key) : quoted_text(key));
}

// The form in which the table lists a full name: stage.3.pressure -> stage.pressure.
std::string listed_name(const std::string& key) {
  if (!key.starts_with("stage.")) return key;
  const std::size_t end = key.find_first_not_of("0123456789", 6);
  return end == std::string::npos || end == 6 || key[end] != '.' ? key : "stage" + key.substr(end);
}

std::optional<std::size_t> stage_of(const std::string& key) {
  if (!key.starts_with("stage.") || key.size() < 7 || key[6] < '0' || key[6] > '9') return std::nullopt;
  std::size_t stage = 0;
  for (std::size_t k = 6; k < key.size() && key[k] >= '0' && key[k] <= '9'; ++k) {
    if (stage > 1000000) return std::nullopt;
    stage = 10 * stage + static_cast<std::size_t>(key[k] - '0');
  }
  return stage;
}

bool is_table_name(const std::string& name) {
  return std::any_of(scene_keys().begin(), scene_keys().end(),
                     [&](const SceneKey& key) { return key.name.starts_with(name + "."); });
}

class Parser {
 public:
  Parser(std::string name) : name_(std::move(name)) {}

  void read(std::string_view text) {
    refuse_deep_keys(text, name_);
    try {
      tables_.push_back(toml::parse(text, std::string_view(name_)));
    } catch (const toml::parse_error& error) {
      throw InputError(name_, static_cast<int>(error.source().begin.line), "", "",
                       "not valid TOML: " + std::string(error.description()));
    }
    flatten(tables_.back(), "");
  }

  void override_by(const std::string& setting) {
    const std::size_t equals = setting.find('=');
    std::string key = setting.substr(0, equals);
    key.erase(std::remove(key.begin(), key.end(), ' '), key.end());
    if (equals == std::string::npos || key.empty()) {
      fault("--set", 0, "", setting, "a dotted key and a TOML value: KEY=VALUE");
      return;
    }
    const std::string value = setting.substr(equals + 1);
    const std::string rule =
        "not a TOML value: a number, true, false, or a text in quotes (in a shell: '" + key + "=\"text\"')";
    if (value.find_first_of("\r\n") != std::string::npos) {
      fault("--set", 0, key, value, rule);
      return;
    }
    const std::string line = "value = " + value;
    try {
      tables_.push_back(toml::parse(std::string_view(line), std::string_view("--set")));
    } catch (const toml::parse_error&) {
      fault("--set", 0, key, value, rule);
      return;
    }
    const toml::node* node = tables_.back().get("value");
    if (node->is_table())
      fault("--set", 0, key, value, "a single value; set the keys of a table one by one");
    else if (const auto stage = stage_of(key); stage && *stage >= stages_)
      fault("--set", 0, key, value, "no such stage: the scene has " + std::to_string(stages_) + ", counted from 0");
    else
      given_.push_back({key, node, "--set", 0});
  }

  Scene scene(SceneChecks checks) {
    keep_last();
    system_ = system();
    Scene scene = default_scene(system_, stages_);
    if ((units_line_ || has_given("units.")) && scene.system == SceneSystem::disks) scene.units.emplace();
    report_unknown();
    assign_all(scene, false);
    assign_all(scene, true);  // needs to know which keys apply
    if (checks == SceneChecks::all) refuse_empty_paths(scene);
    if (scene.units) require_units();
    if (checks == SceneChecks::all) report_conflicts(scene);
    if (faults_.empty() && checks == SceneChecks::all) expand_load_paths(scene);
    if (!faults_.empty()) {
      std::stable_sort(faults_.begin(), faults_.end(), [](const Fault& a, const Fault& b) {
        return (a.file == "--set") != (b.file == "--set") ? b.file == "--set" : a.line < b.line;
      });
      throw InputError(faults_);
    }
    return scene;
  }

 private:
  void fault(const std::string& file, int line, const std::string& key, const std::string& value,
             const std::string& rule) {
    faults_.push_back({file, line, key, value, rule});
    if (faults_.size() < kMostFaults) return;
    faults_.push_back({name_, 0, "", "", "more faults are not listed"});
    throw InputError(std::move(faults_));
  }

  void flatten(const toml::table& table, const std::string& parent) {
    for (const auto& [name, node] : table) {
      const std::string key = path_of(parent, name.str());
      const int line = static_cast<int>(node.source().begin.line);
      const toml::array* array = node.as_array();
      if (key == "stage" && array && array->is_array_of_tables()) {
        stages_ = array->size();
        for (std::size_t k = 0; k < stages_; ++k) flatten(*array->get_as<toml::table>(k), "stage." + std::to_string(k));
      } else if (key == "stage") {
        fault(name_, line, key, "", "stages are an array of tables: write [[stage]]");
      } else if (const toml::table* inner = node.as_table()) {
        if (inner->empty() && !is_table_name(key)) fault(name_, line, key, "", unknown(key));
        if (key == "units") units_line_ = line;
        flatten(*inner, key);
      } else {
        given_.push_back({key, &node, name_, line});
      }
    }
  }

  // --set replaces what the file says, and a later --set an earlier one.
  void keep_last() {
    std::set<std::string> seen;
    std::vector<Given> kept;
    for (auto g = given_.rbegin(); g != given_.rend(); ++g)
      if (seen.insert(g->key).second) kept.push_back(*g);
    given_.assign(kept.rbegin(), kept.rend());
  }

  const Given* find(const std::string& key) const {
    const auto at = std::find_if(given_.begin(), given_.end(), [&](const Given& g) { return g.key == key; });
    return at == given_.end() ? nullptr : &*at;
  }

  std::string unknown(const std::string& key) const {
    if (is_table_name(key)) return "is a table: write [" + key + "]";
    std::vector<std::string> names;
    for (const SceneKey& row : scene_keys(system_)) {
      names.push_back(full_name(row, stage_of(key).value_or(0)));
      if (std::string table = table_of(row); !table.empty() && !belongs_to_stage(row))
        names.push_back(std::move(table));
    }
    const std::string hint = did_you_mean(key, names);
    return "unknown key; " + (hint.empty() ? "docs/scene.md lists all keys" : hint);
  }

  // Known before everything else, for keys and defaults depend on it: a value that names no system is the only fault.
  SceneSystem system() const {
    Scene scene;
    const SceneKey& key = *row_of("system", scene_keys());
    if (const Given* g = find("system"); g && !assign(key, key.field(scene, 0), *g->node))
      throw InputError(g->file, g->line, g->key, text_of(*g->node), rule_text(key));
    return scene.system;
  }

  static const SceneKey* row_of(const std::string& key, const std::vector<SceneKey>& rows) {
    const auto at = std::find_if(rows.begin(), rows.end(), [&](const SceneKey& row) {
      return row.name == listed_name(key) && belongs_to_stage(row) == stage_of(key).has_value();
    });
    return at == rows.end() ? nullptr : &*at;
  }

  void report_unknown() {
    for (const Given& g : given_) {
      if (row_of(g.key, scene_keys(system_))) continue;
      std::string rule = unknown(g.key);
      if (const SceneKey* other = row_of(g.key, scene_keys()))
        rule = "a key of " + names_of(other->systems) + ", and this scene is of " + std::string(name(system_)) +
               ": the key system says so (without it: disks)";
      fault(g.file, g.line, g.key, text_of(*g.node), rule);
    }
    if (units_line_ && !row_of("units.a", scene_keys(system_)) && !has_given("units."))
      fault(name_, units_line_, "units", "", "a table of disks, and this scene is of " + std::string(name(system_)));
  }

  bool has_given(const std::string& start) const {
    return std::any_of(given_.begin(), given_.end(), [&](const Given& g) { return g.key.starts_with(start); });
  }

  void assign_all(Scene& scene, bool conditional) {
    for (const SceneKey& key : scene_keys(scene.system)) {
      if ((key.condition.holds != nullptr) != conditional || !applies(key, scene)) continue;
      const std::size_t copies = belongs_to_stage(key) ? stages_ : 1;
      for (std::size_t stage = 0; stage < copies; ++stage)
        if (const Given* g = find(full_name(key, stage)); g && !assign(key, key.field(scene, stage), *g->node))
          fault(g->file, g->line, g->key, text_of(*g->node),
                rule_text(key) + (key.unit.empty() ? "" : " [" + std::string(unit_text(key, scene.system)) + "]"));
    }
  }

  // Stores the value if it has the type of the key and obeys its rule.
  static bool assign(const SceneKey& key, const SceneField& field, const toml::node& node) {
    return std::visit([&](auto* target) { return store(key, *target, node); }, field);
  }
  static bool store(const SceneKey&, bool& target, const toml::node& node) {
    const auto* value = node.as_boolean();
    if (value) target = value->get();
    return value;
  }
  template <class Integer>
  requires std::is_integral_v<Integer>
  static bool store(const SceneKey& key, Integer& target, const toml::node& node) {
    const auto* value = node.as_integer();
    if (!value || !key.range.contains(static_cast<double>(value->get()))) return false;
    target = static_cast<Integer>(value->get());
    return true;
  }
  static bool store(const SceneKey& key, double& target, const toml::node& node) {
    double value = 0;
    if (const auto* integer = node.as_integer())
      value = static_cast<double>(integer->get());
    else if (const auto* real = node.as_floating_point())
      value = real->get();
    else
      return false;
    if (!key.range.contains(value)) return false;
    target = value;
    return true;
  }
  static bool store(const SceneKey& key, std::optional<double>& target, const toml::node& node) {
    double value = 0;
    if (!store(key, value, node)) return false;
    target = value;
    return true;
  }
  static bool store(const SceneKey& key, std::string& target, const toml::node& node) {
    const auto* value = node.as_string();
    if (!value) return false;
    const bool allowed =
        key.choices.empty() || std::find(key.choices.begin(), key.choices.end(), value->get()) != key.choices.end();
    if (allowed) target = value->get();
    return allowed;
  }
  static bool store(const SceneKey& key, std::vector<double>& target, const toml::node& node) {
    const auto* array = node.as_array();
    if (!array) return false;
    std::vector<double> values(array->size());
    for (std::size_t k = 0; k < values.size(); ++k)
      if (!store(key, values[k], *array->get(k))) return false;
    target = std::move(values);
    return true;
  }
  template <class Choice>
  requires std::is_enum_v<Choice>
  static bool store(const SceneKey& key, Choice& target, const toml::node& node) {
    std::string name;
    if (!store(key, name, node)) return false;
    target = static_cast<Choice>(std::find(key.choices.begin(), key.choices.end(), name) - key.choices.begin());
    return true;
  }

  static void expand_load_paths(Scene& scene) {
    std::vector<StageScene> stages;
    for (const StageScene& stage : scene.stages) {
      StageScene one = stage;
      one.pressures.clear();
      if (stage.pressures.empty()) stages.push_back(one);
      for (const double p : stage.pressures) {
        one.pressure = p;
        stages.push_back(one);
        one.velocity = 0;
      }
    }
    scene.stages = std::move(stages);
  }

  // An empty list would leave the cell fixed, which a stage without any stress does.
  void refuse_empty_paths(const Scene& scene) {
    for (std::size_t stage = 0; stage < scene.stages.size(); ++stage)
      if (const Given* g = find("stage." + std::to_string(stage) + ".pressures");
          g && g->node->is_array() && scene.stages[stage].pressures.empty())
        fault(g->file, g->line, g->key, text_of(*g->node), "at least one pressure, at which the path ends");
  }

  void require_units() {
    for (const SceneKey& key : scene_keys(system_))
      if (belongs_to_units(key) && !find(std::string(key.name)))
        fault(name_, units_line_, std::string(key.name), "", "missing: [units] needs all of its keys");
  }

  // A rule between keys says nothing when one of them is already at fault.
  void report_conflicts(const Scene& scene) {
    std::set<std::string> at_fault;
    for (const Fault& f : faults_) at_fault.insert(f.key);
    for (const SceneConflict& conflict : conflicts(scene)) {
      if (std::any_of(conflict.involved.begin(), conflict.involved.end(),
                      [&](const std::string& key) { return at_fault.contains(key); }))
        continue;
      const Given* g = find(conflict.key);
      fault(g ? g->file : name_, g ? g->line : 0, conflict.key, conflict.value, conflict.rule);
    }
  }

  static constexpr std::size_t kMostFaults = 100;

  std::string name_;
  std::deque<toml::table> tables_;  // nodes stay where they are
  std::vector<Given> given_;
  std::vector<Fault> faults_;
  SceneSystem system_ = SceneSystem::disks;
  std::size_t stages_ = 0;
  int units_line_ = 0;
};

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, const std::vector<std::string>& overrides,
                  SceneChecks checks) {
  Parser parser(name);
  parser.read(text);
  for (const std::string& setting : overrides) parser.override_by(setting);
  return parser.scene(checks);
}

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  return parse_scene(read_whole_file(path), path, overrides);
}

}  // namespace isostat
