#include "apps/study/state_report.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "analysis/load_input.hpp"
#include "analysis/report.hpp"
#include "analysis/version.hpp"
#include "apps/json_output.hpp"
#include "apps/study/state_digest.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

// All that a report depends on beside its sections.
Json key_of(const std::string& state_path, const AnalysisOptions& options) {
  const StateDigest& state = state_digest(state_path);
  const auto optional = [](const auto& value) { return value ? Json(*value) : Json(); };
  return {{"isostat", version()},
          {"hash", state.hash},
          {"scene", scene_to_toml(state.scene)},
          {"law", options.law ? Json(static_cast<int>(*options.law)) : Json()},
          {"cell_free", options.cell_free},
          {"gap_tolerance", optional(options.gap_tolerance)},
          {"k_max", options.k_max},
          {"k_window", optional(options.k_window)},
          {"r_window", optional(options.r_window)},
          {"pore_window", optional(options.pore_window)},
          {"pore_size", optional(options.pore_size)},
          {"threshold", optional(options.threshold)},
          {"force", static_cast<int>(options.force_measure)},
          {"fit_constant", name_of(options.fit_constant)},
          {"window_scan", options.window_scan}};
}

std::optional<Json> stored(const std::string& path, const Json& key) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    Json file = Json::parse(read_whole_file(path));
    if (file.at("of") != key) return std::nullopt;
    return file.at("report");
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // no report of ours: computed anew
  }
}

}  // namespace

bool has_sections(const Json& report, const std::vector<std::string>& sections) {
  return std::all_of(sections.begin(), sections.end(), [&](const std::string& s) { return report.contains(s); });
}

std::optional<Json> stored_report(const std::string& path, const std::string& state_path,
                                  const AnalysisOptions& options) {
  if (!std::filesystem::exists(state_path)) return std::nullopt;
  return stored(path, key_of(state_path, options));
}

void update_report(const std::string& path, const std::string& state_path, const StudyAnalysis& analysis) {
  const Json key = key_of(state_path, analysis.options);
  const Json old = stored(path, key).value_or(Json::object());
  std::vector<std::string> missing;
  for (const std::string& s : analysis.sections)
    if (!old.contains(s)) missing.push_back(s);
  if (missing.empty()) return;
  const AnalysisInput input = load_input(state_path, analysis.options);
  Json computed = analyze(input, analysis.options, missing), report;
  for (const char* head : {"isostat", "inputs", "units"}) report[head] = computed.at(head);
  report["inputs"] = {std::filesystem::path(state_path).filename().string()};  // the folder may move
  for (const Section& s : sections()) {
    const std::string name(s.name);
    if (computed.contains(name) || old.contains(name))
      report[name] = computed.contains(name) ? computed.at(name) : old.at(name);
  }
  write_file_atomically(path, json_text(Json{{"of", key}, {"report", report}}, 1));
}

}  // namespace isostat
