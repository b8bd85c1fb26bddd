#include "apps/study/study_tables.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/ensemble.hpp"
#include "analysis/report_text.hpp"
#include "analysis/version.hpp"
#include "apps/json_output.hpp"
#include "apps/study/curve_tables.hpp"
#include "apps/study/state_report.hpp"
#include "dem/scene/keys.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

// The states of one parameter set after one stage.
struct Ensemble {
  const ParameterSet* set = nullptr;
  std::optional<std::size_t> stage;
  std::string name;
  std::vector<std::string> states;     // file names
  std::vector<std::uint64_t> seeds;    // of the samples,
  std::vector<SampleNumbers> numbers;  // and their numbers; both only where something is derived from them
  Json report;                         // merged; null without samples
  std::vector<std::pair<std::string, Json>> scalars;
};

bool is_statistic(const Json& v) { return v.is_object(); }
bool has_error_bar(const Json& v) { return is_statistic(v) || (v.is_number() && !v.is_boolean()); }

// Sections that an earlier call of the study asked for stay out of the tables of this one.
Json only_sections(const Json& report, const std::vector<std::string>& sections) {
  Json kept;
  for (const auto& [key, value] : report.items())
    if (!value.is_object() || key == "units" || std::find(sections.begin(), sections.end(), key) != sections.end())
      kept[key] = value;
  return kept;
}

// Those of its report, of the scene keys that the study sets, and of the stage.
SampleNumbers numbers_of(const Study& study, const ParameterSet& set, std::optional<std::size_t> stage,
                         const Json& report) {
  SampleNumbers numbers;
  const auto add = [&numbers](const std::string& name, const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc{} && end == text.data() + text.size()) numbers[name] = value;
  };
  for (const SceneKey& key : scene_keys(set.scene.system)) {
    const std::string name(key.name);
    add(name, belongs_to_stage(key) ? stage_value(set, stage, name) : value_of(set, name));
  }
  for (const auto& [name, value] : report_scalars(report))
    if (value.is_number()) numbers[name] = value.get<double>();
  add_derived(study.derived, numbers);
  return numbers;
}

Json statistic_json(const Statistic& s) {
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(); };
  return {{"mean", number(s.mean)}, {"sd", number(s.sd)}, {"se", number(s.se)}, {"n", s.n}};
}

std::vector<Ensemble> ensembles_of(const Study& study, const std::vector<StudyRun>& runs,
                                   const std::vector<RunRecord>& records) {
  std::vector<Ensemble> all;
  for (const ParameterSet& set : study.sets)
    for (const auto stage : analysed_stages(set)) {
      Ensemble e{&set, stage, set.name + (stage ? ".stage" + std::to_string(*stage) : ""), {}, {}, {}, {}, {}};
      std::vector<Json> reports;
      for (std::size_t k = 0; k < runs.size(); ++k) {
        if (runs[k].set != &set || records[k].status != RunStatus::ok) continue;
        const auto report = stored_report(runs[k].report(stage), runs[k].state(stage), study.analysis.options);
        if (!report || !has_sections(*report, study.analysis.sections)) continue;
        reports.push_back(only_sections(*report, study.analysis.sections));
        e.states.push_back(fs::path(runs[k].state(stage)).filename().string());
        if (study.derived.empty() && study.slopes.empty()) continue;
        e.seeds.push_back(runs[k].seed);
        e.numbers.push_back(numbers_of(study, set, stage, reports.back()));
      }
      if (!reports.empty()) e.report = merge_reports(reports), e.scalars = report_scalars(e.report);
      for (const DerivedColumn& column : study.derived) {
        std::vector<double> values;
        for (const SampleNumbers& numbers : e.numbers) values.push_back(numbers.at(column.name));
        e.scalars.emplace_back(column.name, statistic_json(statistic(values)));
      }
      all.push_back(std::move(e));
    }
  return all;
}

std::string scene_name(const ParameterSet& set) { return fs::path(set.scene_path).filename().string(); }

std::string study_csv(const Study& study, const std::vector<Ensemble>& ensembles) {
  std::vector<std::string> columns;
  std::map<std::string, bool> error_bar;
  bool stages = false, scenes = false;
  for (const Ensemble& e : ensembles) {
    stages = stages || e.stage;
    scenes = scenes || e.set->scene_path != study.sets.front().scene_path;
    for (const auto& [key, value] : e.scalars) {
      if (!error_bar.contains(key)) columns.push_back(key);
      error_bar[key] = error_bar[key] || has_error_bar(value);
    }
  }
  const std::vector<std::string> of_stage = stages ? stage_columns(study) : std::vector<std::string>();
  std::string text = "row";
  if (stages) text += ",stage";
  for (const std::string& key : of_stage) text += "," + key;
  if (scenes) text += ",scene";
  for (const std::string& key : study.keys) text += "," + csv_field(key);
  text += ",runs,n";
  for (const std::string& c : columns) text += "," + c + (error_bar[c] ? "," + c + "_sd," + c + "_se" : "");
  text += '\n';
  for (const Ensemble& e : ensembles) {
    text += csv_field(e.set->name);
    if (stages) text += "," + (e.stage ? std::to_string(*e.stage) : std::string());
    for (const std::string& key : of_stage) text += "," + csv_field(stage_value(*e.set, e.stage, key));
    if (scenes) text += "," + csv_field(scene_name(*e.set));
    for (const std::string& key : study.keys) text += "," + csv_field(value_of(*e.set, key));
    text += "," + std::to_string(e.set->seeds.size()) + "," + std::to_string(e.states.size());
    for (const std::string& c : columns) {
      const auto it = std::find_if(e.scalars.begin(), e.scalars.end(), [&](const auto& s) { return s.first == c; });
      const Json value = it == e.scalars.end() ? Json() : it->second;
      if (is_statistic(value))
        text += "," + csv_field(value.at("mean")) + "," + csv_field(value.at("sd")) + "," + csv_field(value.at("se"));
      else
        text += "," + csv_field(value) + (error_bar[c] ? ",," : "");
    }
    text += '\n';
  }
  return text;
}

// A line a parameter set and slope: the mean over the samples whose stages are all there.
std::string slopes_csv(const Study& study, const std::vector<Ensemble>& ensembles) {
  std::string text = "row,slope,stages,n,mean,sd,se\n";
  for (const ParameterSet& set : study.sets)
    for (const PathSlope& slope : study.slopes) {
      std::map<std::uint64_t, std::vector<const SampleNumbers*>> stages_of_sample;
      for (const Ensemble& e : ensembles)
        if (e.set == &set && e.stage && std::count(slope.stages.begin(), slope.stages.end(), *e.stage))
          for (std::size_t k = 0; k < e.seeds.size(); ++k) stages_of_sample[e.seeds[k]].push_back(&e.numbers[k]);
      std::vector<double> values;
      for (const auto& [seed, stages] : stages_of_sample)
        if (stages.size() == slope.stages.size()) values.push_back(slope_of(slope, stages));
      const Statistic s = statistic(values);
      std::string stages;
      for (const std::size_t stage : slope.stages) stages += (stages.empty() ? "" : " ") + std::to_string(stage);
      text += csv_field(set.name) + "," + slope.name + "," + stages + "," + std::to_string(s.n);
      for (const char* key : {"mean", "sd", "se"}) text += "," + csv_field(statistic_json(s)[key]);
      text += '\n';
    }
  return text;
}

// Of a run that has not ended only that is told, and what it has cost.
Json run_json(const StudyRun& run, const RunRecord& r) {
  const auto number = [](std::optional<double> x) { return x ? Json(*x) : Json(); };
  const bool known = !r.hash.empty();
  return {{"row", run.set->name},
          {"seed", run.seed},
          {"status", status_name(r.status)},
          {"reason", r.reason},
          {"cpu_seconds", number(r.cpu_seconds)},
          {"steps", known ? Json(r.steps) : Json()},
          {"time", known ? Json(r.time) : Json()},
          {"certified", known ? Json(r.certified) : Json()},
          {"Phi", number(r.solid_fraction)},
          {"z", number(r.z)},
          {"hash", r.hash}};
}

std::string runs_csv(const Json& runs) {
  std::string text = "row,seed,status,reason,cpu_seconds,steps,time,certified,Phi,z,hash\n";
  for (const Json& run : runs) {
    std::string line;
    for (const auto& [key, value] : run.items()) line += (key == "row" ? "" : ",") + csv_field(value);
    text += line + '\n';
  }
  return text;
}

// A TOML literal of a scene key is a JSON literal too, but for inf and nan.
Json json_of(const std::string& literal) {
  const Json value = Json::parse(literal, nullptr, false);
  return value.is_discarded() ? Json(literal) : value;
}

Json row_json(const Ensemble& e) {
  Json settings = Json::object(), scalars = Json::object();
  for (const auto& [key, value] : e.set->settings) settings[key] = json_of(value);
  for (const auto& [key, value] : e.scalars) scalars[key] = value;
  Json row{{"row", e.set->name}};
  if (e.stage) row["stage"] = *e.stage;
  row["scene_file"] = scene_name(*e.set);
  row["set"] = settings;
  row["seeds"] = e.set->seeds;
  row["n"] = e.states.size();
  row["states"] = e.states;
  row["report"] = e.report.is_null() ? Json() : Json(e.name + ".report.json");
  row["scalars"] = scalars;
  row["scene"] = scene_to_toml(e.set->scene);
  return row;
}

}  // namespace

TableFiles study_tables(const Study& study, const std::vector<StudyRun>& runs, const std::vector<RunRecord>& records,
                        const std::string& directory) {
  const std::vector<Ensemble> ensembles = ensembles_of(study, runs, records);
  TableFiles tables;
  Json json{{"isostat", version()},
            {"study", fs::path(study.path).filename().string()},
            {"analyze", study.analysis.sections},
            {"keys", study.keys},
            {"rows", Json::array()},
            {"runs", Json::array()}};
  for (const Ensemble& e : ensembles) {
    const std::string path = (fs::path(directory) / (e.name + ".report.json")).string();
    if (e.report.is_null())
      tables.stale.push_back(path);
    else
      tables.files.emplace_back(path, json_text(e.report, 1));
    json["rows"].push_back(row_json(e));
  }
  for (std::size_t k = 0; k < runs.size(); ++k) json["runs"].push_back(run_json(runs[k], records[k]));
  const auto add = [&](const char* name, std::string text) {
    tables.files.emplace_back((fs::path(directory) / name).string(), std::move(text));
  };
  add("study.csv", study_csv(study, ensembles));
  if (!study.slopes.empty()) add("slopes.csv", slopes_csv(study, ensembles));
  for (auto& [name, text] : curve_tables(study, runs, records)) add(name.c_str(), std::move(text));
  add("runs.csv", runs_csv(json["runs"]));
  add("study.json", json_text(json, 1));
  return tables;
}

}  // namespace isostat
