// The study's TOML file: rows, grid and seeds, with every fault of its own keys. All of it here, for toml++ takes long
// to compile and stays out of headers.
#include "apps/study/study_file.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <sstream>

#include "analysis/report.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/scene/deep_keys.hpp"
#include "dem/scene/keys.hpp"
#include "dem/scene/suggestion.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

// Keys as TOML has them: values of a kind, and the faults of those that are of another.
class TomlKeys {
 public:
  explicit TomlKeys(StudyFaults& faults) : faults_(faults) {}

 protected:
  static int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }
  static std::string literal(const toml::node& node);
  static bool is_all(const toml::node& node) { return node.value<std::string>() == "all"; }

  void fault(int line, const std::string& key, const std::string& value, const std::string& rule) {
    faults_.add(line, key, value, rule);
  }
  void unknown(int line, const std::string& key, const std::vector<std::string>& known);

  // What is of another kind is a fault, and comes back empty (positive: NaN).
  std::string text_of(const toml::node& node, const std::string& key);
  std::vector<std::size_t> stages_of(const toml::node& node, const std::string& key);
  double positive(const toml::node& node, const std::string& key, const std::string& unit);
  template <class Integer>
  std::vector<Integer> distinct_integers(const toml::node& node, const std::string& key, const std::string& rule);

  StudyFaults& faults_;
};

std::string TomlKeys::literal(const toml::node& node) {
  if (const auto* real = node.as_floating_point()) return real_text(real->get());
  if (const auto* text = node.as_string()) return quoted_text(text->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* array = node.as_array()) {
    std::string text;
    for (const toml::node& element : *array) text += (text.empty() ? "" : ", ") + literal(element);
    return "[" + text + "]";
  }
  std::ostringstream out;
  out << toml::node_view<const toml::node>(&node);
  return out.str();
}

void TomlKeys::unknown(int line, const std::string& key, const std::vector<std::string>& known) {
  std::vector<std::string> names = known;
  for (const SceneKey& k : scene_keys()) names.push_back(full_name(k, 0));
  const std::string hint = did_you_mean(key, names);
  fault(line, key, "", "unknown key; " + (hint.empty() ? "docs/study.md lists all keys" : hint));
}

std::string TomlKeys::text_of(const toml::node& node, const std::string& key) {
  if (const auto* text = node.as_string(); text && !text->get().empty()) return text->get();
  fault(line_of(node), key, literal(node), "a text that is not empty");
  return "";
}

template <class Integer>
std::vector<Integer> TomlKeys::distinct_integers(const toml::node& node, const std::string& key,
                                                 const std::string& rule) {
  std::vector<Integer> list;
  const auto* array = node.as_array();
  for (std::size_t k = 0; array && k < array->size(); ++k) {
    const auto* value = array->get(k)->as_integer();
    if (!value || value->get() < 0 ||
        std::find(list.begin(), list.end(), static_cast<Integer>(value->get())) != list.end()) {
      list.clear();
      break;
    }
    list.push_back(static_cast<Integer>(value->get()));
  }
  if (list.empty()) fault(line_of(node), key, literal(node), rule);
  return list;
}

std::vector<std::size_t> TomlKeys::stages_of(const toml::node& node, const std::string& key) {
  if (const auto* one = node.as_integer(); one && one->get() >= 0) return {static_cast<std::size_t>(one->get())};
  return distinct_integers<std::size_t>(node, key, "a stage, a list of different stages, counted from 0, or \"all\"");
}

double TomlKeys::positive(const toml::node& node, const std::string& key, const std::string& unit) {
  const auto number = node.value<double>();
  if (number && *number > 0 && std::isfinite(*number)) return *number;
  fault(line_of(node), key, literal(node), "a real > 0" + (unit.empty() ? "" : " " + unit));
  return std::numeric_limits<double>::quiet_NaN();
}

// [analysis]: the options of `isostat analyze`.
class AnalysisKeys : TomlKeys {
 public:
  using TomlKeys::TomlKeys;

  void read(const toml::node& node, AnalysisOptions& options) {
    const toml::table* table = node.as_table();
    if (!table) return fault(line_of(node), "analysis", literal(node), "is a table: write [analysis]");
    for (const auto& [name, value] : *table) {
      const std::string leaf(name.str()), key = "analysis." + leaf;
      const auto text = value.value<std::string>();
      const auto number = value.value<double>();
      if (leaf == "law") {
        options.law = network_law_named(text.value_or(""));
        if (!options.law)
          fault(line_of(value), key, literal(value), "one of \"frictionless\", \"friction\", \"rolling\"");
      } else if (leaf == "cell") {
        options.cell_free = text == "free";
        if (text != "free" && text != "fixed") fault(line_of(value), key, literal(value), "one of \"fixed\", \"free\"");
      } else if (leaf == "gap_tolerance") {
        options.gap_tolerance = number;
        if (!number || !(*number >= 0)) fault(line_of(value), key, literal(value), "a real >= 0 [a]");
      } else if (leaf == "k_max") {
        options.k_max = positive(value, key, "[1/a]");
      } else if (leaf == "k_window") {
        options.k_window = window_of(value, key, true);
      } else if (leaf == "r_window") {
        options.r_window = window_of(value, key, true);
      } else if (leaf == "pore_window") {
        options.pore_window = window_of(value, key, false);
      } else if (leaf == "pore_size") {
        options.pore_size = positive(value, key, "[a]");
      } else if (leaf == "threshold") {
        options.threshold = positive(value, key, "[F0]");
      } else if (leaf == "fit_constant") {
        const auto constant = fit_constant_named(text.value_or(""));
        options.fit_constant = constant.value_or(options.fit_constant);
        if (!constant) fault(line_of(value), key, literal(value), "one of \"free\", \"nonnegative\", \"zero\"");
      } else if (leaf == "force") {
        options.force_measure = text == "normal" ? ForceMeasure::normal : ForceMeasure::total;
        if (text != "normal" && text != "total")
          fault(line_of(value), key, literal(value), "one of \"total\", \"normal\"");
      } else if (leaf == "window_scan") {
        options.window_scan = value.value<bool>().value_or(false);
        if (!value.is_boolean()) fault(line_of(value), key, literal(value), "true or false");
      } else {
        std::vector<std::string> known;
        for (const char* k : {"law", "cell", "gap_tolerance", "k_max", "k_window", "r_window", "pore_window",
                              "pore_size", "threshold", "force", "fit_constant", "window_scan"})
          known.push_back(std::string("analysis.") + k);
        unknown(line_of(value), key, known);
      }
    }
  }

 private:
  // [LOW, HIGH] with 0 <= LOW < HIGH, LOW > 0 where 0 is no end.
  AnalysisOptions::Window window_of(const toml::node& node, const std::string& key, bool from_zero) {
    const auto* array = node.as_array();
    std::vector<double> ends;
    for (std::size_t k = 0; array && k < array->size(); ++k)
      if (const auto end = array->get(k)->value<double>()) ends.push_back(*end);
    if (array && array->size() == 2 && ends.size() == 2 && (from_zero ? ends[0] >= 0 : ends[0] > 0) &&
        ends[0] < ends[1] && std::isfinite(ends[1]))
      return std::array{ends[0], ends[1]};
    fault(line_of(node), key, literal(node),
          from_zero ? "is [LOW, HIGH] with 0 <= LOW < HIGH" : "is [LOW, HIGH] with 0 < LOW < HIGH");
    return std::nullopt;
  }
};

// [derived], [[slope]] and [[curve]]: what is computed from the numbers and series of the samples.
class ComputedKeys : TomlKeys {
 public:
  ComputedKeys(const toml::table& top, StudyFile& file, StudyFaults& faults)
      : TomlKeys(faults), top_(top), file_(file) {}

  void read() {
    read_derived();
    read_slopes();
    read_curves();
  }

 private:
  void read_derived() {
    const toml::node* node = top_.get("derived");
    if (!node) return;
    const toml::table* table = node->as_table();
    if (!table) return fault(line_of(*node), "derived", literal(*node), "is a table: write [derived]");
    for (const auto& [name, value] : *table)
      file_.derived.push_back(
          {std::string(name.str()), text_of(value, "derived." + std::string(name.str())), line_of(value)});
    std::sort(file_.derived.begin(), file_.derived.end(),
              [](const DerivedText& a, const DerivedText& b) { return a.line < b.line; });
  }

  void read_slopes() {
    for (const toml::table* table : tables("slope", {"name", "x", "y", "stages"})) {
      SlopeText slope;
      slope.line = line_of(*table);
      for (const auto& [name, value] : *table) {
        const std::string leaf(name.str()), key = "slope." + leaf;
        if (leaf == "stages")
          slope.stages = stages_of(value, key);
        else if (leaf == "name" || leaf == "x" || leaf == "y")
          (leaf == "name" ? slope.name : leaf == "x" ? slope.x : slope.y) = text_of(value, key);
      }
      file_.slopes.push_back(std::move(slope));
    }
  }

  void read_curves() {
    for (const toml::table* table : tables("curve", {"name", "x", "y", "step", "stage"})) {
      CurveText curve;
      curve.line = line_of(*table);
      for (const auto& [name, value] : *table) {
        const std::string leaf(name.str()), key = "curve." + leaf;
        const auto number = value.value<std::int64_t>();
        if (leaf == "step")
          curve.step = positive(value, key, "in the unit of x");
        else if (leaf == "stage" && value.is_integer() && *number >= 0)
          curve.stage = static_cast<std::size_t>(*number);
        else if (leaf == "stage")
          fault(line_of(value), key, literal(value), "a stage, counted from 0");
        else if (leaf == "name" || leaf == "x" || leaf == "y")
          (leaf == "name" ? curve.name : leaf == "x" ? curve.x : curve.y) = text_of(value, key);
      }
      file_.curves.push_back(std::move(curve));
    }
  }

  // Those of an array of tables whose keys are these, each of them there.
  std::vector<const toml::table*> tables(const std::string& name, const std::vector<std::string>& keys) {
    std::vector<const toml::table*> all;
    const toml::node* node = top_.get(name);
    if (!node) return all;
    const toml::array* array = node->as_array();
    if (!array || array->empty() || !array->is_array_of_tables()) {
      fault(line_of(*node), name, "", name + "s are an array of tables: write [[" + name + "]]");
      return all;
    }
    std::vector<std::string> known;
    for (const std::string& key : keys) known.push_back(name + "." + key);
    for (std::size_t k = 0; k < array->size(); ++k) {
      const toml::table& table = *array->get_as<toml::table>(k);
      for (const auto& [leaf, value] : table)
        if (std::find(keys.begin(), keys.end(), leaf.str()) == keys.end())
          unknown(line_of(value), name + "." + std::string(leaf.str()), known);
      for (std::size_t i = 0; i < keys.size(); ++i)
        if (!table.contains(keys[i])) fault(line_of(table), known[i], "", "missing");
      all.push_back(&table);
    }
    return all;
  }

  const toml::table& top_;
  StudyFile& file_;
};

class StudyParser : TomlKeys {
 public:
  using TomlKeys::TomlKeys;

  StudyFile read() {
    const std::string text = read_whole_file(faults_.path());
    refuse_deep_keys(text, faults_.path());
    try {
      table_ = toml::parse(text, std::string_view(faults_.path()));
    } catch (const toml::parse_error& error) {
      throw InputError(faults_.path(), static_cast<int>(error.source().begin.line), "", "",
                       "not valid TOML: " + std::string(error.description()));
    }
    read_top();
    read_rows();
    read_grid();
    ComputedKeys(table_, file_, faults_).read();
    return std::move(file_);
  }

 private:
  // --- the keys of the study itself ---

  void read_top() {
    const std::vector<std::string> known{"scene", "seeds", "stages",  "analyze", "analysis", "set",
                                         "row",   "grid",  "derived", "slope",   "curve"};
    std::vector<std::string> sections{"counts"};
    for (const auto& [name, node] : table_) {
      const std::string key(name.str());
      if (key == "scene") {
        scene_ = text_of(node, key);
      } else if (key == "seeds") {
        seeds_ = seeds_of(node, key);
      } else if (key == "stages") {
        all_stages_ = is_all(node);
        if (!all_stages_) stages_ = stages_of(node, key);
      } else if (key == "analyze") {
        sections = sections_of(node, key);
      } else if (key == "analysis") {
        AnalysisKeys(faults_).read(node, file_.analysis.options);
      } else if (key == "set") {
        read_settings(node, key, set_);
      } else if (key != "row" && key != "grid" && key != "derived" && key != "slope" && key != "curve") {
        unknown(line_of(node), key, known);
      }
    }
    file_.analysis.sections = sections;
  }

  std::vector<std::uint64_t> seeds_of(const toml::node& node, const std::string& key) {
    const std::string rule = "a number of samples (seeds 1, 2, ...) or a list of different seeds >= 0";
    const auto* count = node.as_integer();
    if (!count) return distinct_integers<std::uint64_t>(node, key, rule);
    std::vector<std::uint64_t> seeds;
    if (count->get() < 1 || count->get() > static_cast<std::int64_t>(kMostRuns))
      fault(line_of(node), key, literal(node), rule);
    else
      for (std::int64_t k = 1; k <= count->get(); ++k) seeds.push_back(static_cast<std::uint64_t>(k));
    return seeds;
  }

  std::vector<std::string> sections_of(const toml::node& node, const std::string& key) {
    std::vector<std::string> names, known;
    for (const Section& s : sections()) known.emplace_back(s.name);
    const auto* array = node.as_array();
    if (!array || array->empty()) fault(line_of(node), key, literal(node), "a list of sections of `isostat analyze`");
    for (std::size_t k = 0; array && k < array->size(); ++k) {
      const auto* text = array->get(k)->as_string();
      const std::string name = text ? text->get() : literal(*array->get(k));
      const std::string hint = did_you_mean(name, known);
      std::string all;
      for (const std::string& s : known) all += (all.empty() ? "" : ", ") + s;
      if (std::find(known.begin(), known.end(), name) == known.end())
        fault(line_of(*array->get(k)), key, quoted_text(name),
              "no section; " + (hint.empty() ? "sections are " + all : hint));
      else if (std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
    }
    return names;
  }

  // --- settings of scene keys ---

  // A key with points may be written as such in quotes or as nested tables.
  void flatten(const toml::node& node, const std::string& key,
               const std::function<void(const std::string&, const toml::node&)>& leaf) {
    const toml::table* table = node.as_table();
    if (!table) return leaf(key, node);
    for (const auto& [name, inner] : *table)
      flatten(inner, (key.empty() ? "" : key + ".") + std::string(name.str()), leaf);
  }

  bool is_setting(const std::string& key, const toml::node& node) {
    if (key == "seed") fault(line_of(node), key, literal(node), "the seeds of a study are its key seeds");
    return key != "seed";
  }

  void add_setting(std::vector<Setting>& settings, const std::string& key, const toml::node& node) {
    if (!is_setting(key, node)) return;
    if (std::any_of(settings.begin(), settings.end(), [&](const Setting& s) { return s.key == key; }))
      fault(line_of(node), key, literal(node), "given twice");
    settings.push_back({key, literal(node), line_of(node)});
  }

  void read_settings(const toml::node& node, const std::string& table, std::vector<Setting>& settings) {
    if (!node.is_table()) return fault(line_of(node), table, literal(node), "is a table: write [" + table + "]");
    flatten(node, "", [&](const std::string& key, const toml::node& value) { add_setting(settings, key, value); });
  }

  void read_rows() {
    const toml::node* node = table_.get("row");
    const toml::array* array = node ? node->as_array() : nullptr;
    if (node && (!array || array->empty() || !array->is_array_of_tables()))
      return fault(line_of(*node), "row", "", "rows are an array of tables: write [[row]]");
    for (std::size_t k = 0; array && k < array->size(); ++k) read_row(*array->get_as<toml::table>(k));
    if (!node)
      file_.rows.push_back(
          {std::filesystem::path(scene_).stem().string(), scene_, set_, seeds_, stages_, all_stages_, 0});
    for (const StudyRow& row : file_.rows) {
      if (row.scene.empty() && !table_.contains("scene"))
        fault(row.line, "scene", "", "missing: the scene file, at the top or in the row");
      if (row.seeds.empty() && !table_.contains("seeds"))
        fault(row.line, "seeds", "", "missing: how many samples, or which seeds, at the top or in the row");
    }
  }

  void read_row(const toml::table& table) {
    const std::vector<std::string> known{"name", "scene", "seeds", "stages"};
    StudyRow row{"", scene_, {}, seeds_, stages_, all_stages_, line_of(table)};
    for (const auto& [name, node] : table) {
      const std::string key(name.str());
      if (key == "name") {
        row.name = text_of(node, key);
        if (!row.name.empty() && !is_safe_name(row.name))
          fault(line_of(node), key, quoted_text(row.name),
                "names files: at most 150 of the letters a-z A-Z 0-9 . - _ + =, not starting with . or -");
      } else if (key == "scene") {
        row.scene = text_of(node, key);
      } else if (key == "seeds") {
        row.seeds = seeds_of(node, key);
      } else if (key == "stages" || (key == "stage" && !node.is_table())) {
        row.all_stages = is_all(node);
        row.stages = row.all_stages ? std::vector<std::size_t>{} : stages_of(node, key);
      } else if (key.find('.') == std::string::npos && !node.is_table() && key != "seed") {
        unknown(line_of(node), key, known);
      } else {
        flatten(node, key, [&](const std::string& k, const toml::node& v) { add_setting(row.settings, k, v); });
      }
    }
    if (!table.contains("name")) fault(row.line, "name", "", "missing: every [[row]] has a name");
    std::vector<Setting> all;  // what the row says replaces what holds for all rows
    for (const Setting& s : set_)
      if (std::none_of(row.settings.begin(), row.settings.end(), [&](const Setting& r) { return r.key == s.key; }))
        all.push_back(s);
    all.insert(all.end(), row.settings.begin(), row.settings.end());
    row.settings = std::move(all);
    file_.rows.push_back(std::move(row));
  }

  void read_grid() {
    const toml::node* node = table_.get("grid");
    if (!node) return;
    if (!node->is_table()) return fault(line_of(*node), "grid", literal(*node), "is a table: write [grid]");
    flatten(*node, "", [&](const std::string& key, const toml::node& value) {
      if (!is_setting(key, value)) return;
      const toml::array* array = value.as_array();
      if (!array || array->empty()) return fault(line_of(value), "grid." + key, literal(value), "a list of values");
      GridAxis axis{key, {}};
      for (const toml::node& choice : *array) {
        const std::string text = literal(choice);
        if (std::any_of(axis.choices.begin(), axis.choices.end(), [&](const Setting& s) { return s.value == text; }))
          fault(line_of(choice), "grid." + key, text, "given twice");
        axis.choices.push_back({key, text, line_of(choice)});
      }
      for (const StudyRow& row : file_.rows)
        for (const Setting& s : row.settings)
          if (s.key == key)
            fault(line_of(value), "grid." + key, "",
                  "also set in line " + std::to_string(s.line) + ": which one is meant?");
      file_.grid.push_back(std::move(axis));
    });
  }

  StudyFile file_;
  toml::table table_;
  // What holds for every row that does not say otherwise.
  std::string scene_;
  std::vector<std::uint64_t> seeds_;
  std::vector<std::size_t> stages_;
  bool all_stages_ = false;
  std::vector<Setting> set_;
};

}  // namespace

StudyFile read_study_file(StudyFaults& faults) { return StudyParser(faults).read(); }

bool is_safe_name(const std::string& name) {
  return !name.empty() && name.size() <= 150 && name.front() != '.' && name.front() != '-' &&
         name.find_first_not_of(kNameLetters) == std::string::npos;
}

}  // namespace isostat
