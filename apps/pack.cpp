// isostat pack SCENE.toml -o STATE.h5: runs the scene's stages, for one sample or several side by side.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "apps/file_rule.hpp"
#include "apps/interrupt.hpp"
#include "apps/json_output.hpp"
#include "apps/pack/lines.hpp"
#include "apps/progress_line.hpp"
#include "apps/sample_run.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"
#include "dem/run/stages.hpp"
#include "dem/scene/file.hpp"
#include "dem/solver/team.hpp"

namespace isostat {
namespace {

// What all samples share.
struct PackJob {
  Scene scene;
  std::string scene_path, output;
  std::vector<std::string> overrides;
  std::uint64_t seed = 1;
  int samples = 1, threads = 1;
  double max_time = 0;  // [T0], triangles [s]
  bool resume = false;
};

// NAME.h5 -> NAME.0001.h5 when there are several samples.
std::string numbered(const std::string& path, int sample, int samples) {
  if (samples == 1 || path.empty()) return path;
  char number[16];
  std::snprintf(number, sizeof number, ".%04d", sample + 1);
  const std::filesystem::path p(path);
  return (p.parent_path() / (p.stem().string() + number + p.extension().string())).string();
}

std::string command_text(const PackJob& job) {
  std::string text = "pack " + job.scene_path;
  for (const std::string& o : job.overrides) text += " --set " + o;
  return text;
}

// Of all samples: steps, and steps times what was there at the end.
struct Totals {
  RunOutcome run;
  std::int64_t grain_steps = 0, triangle_steps = 0;
};

// Adds the run of one sample to the timings of all; the exit code.
ExitCode run_one(const PackJob& job, int k, ProgressLine& line, Totals& total, std::mutex& lock) {
  const std::string output = numbered(job.output, k, job.samples);
  const SampleJob sample{job.scene,
                         job.seed + static_cast<std::uint64_t>(k),
                         output,
                         numbered(job.scene.output.series, k, job.samples),
                         command_text(job),
                         job.samples > 1 ? 1 : job.threads,
                         job.max_time,
                         job.resume};
  Bulk size;
  SampleWatch watch;
  watch.interrupted = InterruptGuard::requested;
  watch.progress = [&](const Progress& p) { line.update(p, job.scene, k); };
  std::string last;
  watch.ended = [&](const AnyState& any, const SampleOutcome& ended) {
    size = bulk(any);
    last = last_line(ended.code == exit_interrupted ? partial_name(output) : output, any, ended);
  };
  const SampleOutcome outcome = run_sample(sample, watch);
  const std::scoped_lock hold(lock);
  total.run.steps += outcome.run.steps, total.run.times += outcome.run.times;
  total.run.cpu_seconds += outcome.run.cpu_seconds;
  total.run.wall_seconds = std::max(total.run.wall_seconds, outcome.run.wall_seconds);
  total.grain_steps += outcome.run.steps * size.grains;
  total.triangle_steps += outcome.run.steps * size.triangles;
  std::string told;
  for (const std::string& text : outcome.messages) told += "isostat pack: " + output + ": " + text + "\n";
  line.tell(told + last);
  return outcome.code;
}

void write_timings(const std::string& path, const Totals& total, SceneSystem system) {
  nlohmann::ordered_json stages;
  for (std::size_t k = 0; k < StepTimes::kNames.size(); ++k)
    stages[std::string(StepTimes::kNames[k])] = total.run.times.seconds[k];
  nlohmann::ordered_json json = {{"grain_steps", total.grain_steps}};
  if (system == SceneSystem::triangles) json["triangle_steps"] = total.triangle_steps;
  json["steps"] = total.run.steps;
  json["cpu_seconds"] = total.run.cpu_seconds;
  json["wall_seconds"] = total.run.wall_seconds;
  json["stages"] = stages;
  write_file_atomically(path, json_text(json, 2));
}

// Every file that the run may write. None of them may be one that it reads.
std::vector<std::string> files_of(const PackJob& job, const std::optional<std::string>& timings) {
  FileRule rule;
  std::vector<std::string> all;
  const auto writes = [&](const char* role, const std::string& path) {
    rule.writes(role, path);
    if (!path.empty()) all.push_back(path);
  };
  rule.reads("the scene", job.scene_path);
  rule.reads("grains.file", job.scene.grains.file);
  const OutputScene& o = job.scene.output;
  for (int k = 0; k < job.samples; ++k) {
    const std::string output = numbered(job.output, k, job.samples);
    if (o.keeps_snapshots()) rule.writes_numbered("the snapshots", output, "snapshot");
    writes("-o", output);
    writes("-o, the partial state", partial_name(output));
    for (std::size_t stage = 0; o.stages && stage + 1 < job.scene.stages.size(); ++stage)
      writes("output.stages", stage_name(output, stage));
    writes("output.series", numbered(o.series, k, job.samples));
  }
  writes("--timings", timings.value_or(""));
  rule.require();
  return all;
}

// What somebody may still want is not replaced unasked: an interrupted run, and a finished state unless this very run
// makes it again.
void refuse_to_lose(const PackJob& job) {
  std::vector<Fault> faults;
  for (int k = 0; k < job.samples; ++k) {
    const std::string output = numbered(job.output, k, job.samples), partial = partial_name(output);
    if (std::filesystem::exists(partial))
      faults.push_back({partial, 0, "", "", "an interrupted run: --resume goes on from it, --force begins anew"});
    else if (std::filesystem::is_regular_file(output))
      if (const std::string what = lost_with(output, job.scene, job.seed + static_cast<std::uint64_t>(k), job.max_time);
          !what.empty())
        faults.push_back({output, 0, "-o", "", what + "; --force replaces it"});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

// One thread a sample, at most `threads` at a time. The worst exit code wins; bad input of one stops all.
int run_samples(const PackJob& job, Totals& total) {
  ProgressLine line(static_cast<int>(job.scene.stages.size()), job.samples);
  std::mutex lock;
  std::vector<ExitCode> codes(static_cast<std::size_t>(job.samples), exit_done);
  Team team(std::min(job.threads, job.samples));
  team.run(job.samples, [&](int k) {
    codes[static_cast<std::size_t>(k)] =
        InterruptGuard::requested() ? exit_interrupted : run_one(job, k, line, total, lock);
  });
  return *std::max_element(codes.begin(), codes.end());
}

}  // namespace

int pack_command(int argc, char** argv) {
  const Arguments args(
      argc, argv,
      {{"-o", "STATE.h5", "where the final state goes"},
       {"--seed", "N", "seed of the random initial state; default: the scene's"},
       {"--threads", "N", "threads; the result does not depend on them (default 1)"},
       {"--samples", "N", "run N samples with seeds N, N+1, ... -> STATE.0001.h5 ..."},
       {"--set", "KEY=VALUE", "override a scene key", true},
       {"--max-time", "T", "stop, unfinished, when the run's time reaches T [T0; triangles: s]"},
       {"--resume", "", "go on from STATE.h5.partial"},
       {"--force", "", "replace a finished state of another scene or seed; begin an interrupted run anew"},
       {"--timings", "FILE.json", "where the time of the step loop went"}},
      {"SCENE.toml -o STATE.h5", "Runs the stages of a scene and writes the state it ends in."});
  args.require_inputs(1, 1, "one scene file");
  const InterruptGuard guard;
  PackJob job;
  job.scene_path = args.inputs()[0];
  job.output = args.required("-o");
  job.overrides = args.values("--set");
  job.samples = static_cast<int>(args.integer("--samples", 1, 1000000).value_or(1));
  job.threads = static_cast<int>(args.integer("--threads", 1, 1024).value_or(1));
  job.max_time = args.number("--max-time").value_or(0);
  if (args.has("--max-time") && !(job.max_time > 0))
    throw InputError("command line", 0, "--max-time", *args.value("--max-time"), "must be positive");
  job.resume = args.has("--resume");
  job.scene = read_scene(job.scene_path, job.overrides);
  job.seed =
      static_cast<std::uint64_t>(args.integer("--seed", 0, INT64_MAX).value_or(static_cast<long long>(job.scene.seed)));
  if (std::filesystem::path(job.output).extension() != ".h5")
    throw InputError("command line", 0, "-o", job.output, "a state file's name ends in .h5");
  const std::vector<std::string> written = files_of(job, args.value("--timings"));
  require_writable(written);
  remove_abandoned(written);
  if (!job.resume && !args.has("--force")) refuse_to_lose(job);

  std::cerr << first_lines(job.scene, initial_state(job.scene, job.seed));
  Totals total;
  const int code = run_samples(job, total);
  if (const auto path = args.value("--timings")) write_timings(*path, total, job.scene.system);
  return code;
}

}  // namespace isostat
