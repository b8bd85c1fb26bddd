#include "apps/study/run_record.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "analysis/report.hpp"
#include "apps/json_output.hpp"
#include "dem/disks/physical_hash.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"
#include "dem/spheres/physical_hash.hpp"
#include "dem/state/solid_fraction.hpp"
#include "dem/triangles/physical_hash.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::array<std::string_view, 4> kNames{"ok", "unfinished", "failed", "pending"};

Json number(std::optional<double> x) { return x ? Json(*x) : Json(); }
std::optional<double> number(const Json& json) {
  return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

}  // namespace

std::string_view status_name(RunStatus status) { return kNames[static_cast<std::size_t>(status)]; }

namespace {

template <class System>
RunRecord common_record(const State<System>& state) {
  RunRecord record;
  record.steps = state.step;
  record.time = state.time;
  record.certified = state.certificate.equilibrated;
  record.hash = physical_hash(state);
  return record;
}

}  // namespace

RunRecord record_of(const State<TriangleGrains>& state) { return common_record(state); }

RunRecord record_of(const State<Spheres>& state) {
  RunRecord record = common_record(state);
  if (state.packing.cell) record.solid_fraction = solid_fraction(state.packing);
  return record;
}

RunRecord record_of(const State<Disks>& state) {
  RunRecord record = common_record(state);
  AnalysisInput input;
  input.state = state;
  input.links_given = true;
  const Json counts = analyze(input, {}, {"counts"}).at("counts");
  record.solid_fraction = number(counts.at("solid_fraction"));
  record.z = number(counts.at("z"));
  return record;
}

void write_record(const RunRecord& r, const std::string& path) {
  const Json json = {{"status", status_name(r.status)},
                     {"reason", r.reason},
                     {"cpu_seconds", number(r.cpu_seconds)},
                     {"steps", r.steps},
                     {"time", r.time},
                     {"certified", r.certified},
                     {"solid_fraction", number(r.solid_fraction)},
                     {"z", number(r.z)},
                     {"hash", r.hash}};
  write_file_atomically(path, json_text(json, 1));
}

std::optional<RunRecord> read_record(const std::string& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    const Json json = Json::parse(read_whole_file(path));
    const auto name = std::find(kNames.begin(), kNames.end(), json.at("status").get<std::string>());
    if (name == kNames.end()) return std::nullopt;
    RunRecord r;
    r.status = static_cast<RunStatus>(name - kNames.begin());
    r.reason = json.at("reason").get<std::string>();
    r.cpu_seconds = number(json.at("cpu_seconds"));
    r.steps = json.at("steps").get<std::int64_t>();
    r.time = json.at("time").get<double>();
    r.certified = json.at("certified").get<bool>();
    r.solid_fraction = number(json.at("solid_fraction"));
    r.z = number(json.at("z"));
    r.hash = json.at("hash").get<std::string>();
    return r;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace isostat
