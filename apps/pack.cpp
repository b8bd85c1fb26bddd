// isostat pack SCENE.toml -o STATE.h5: runs the scene's stages, for one sample or several side by side.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "apps/interrupt.hpp"
#include "apps/progress_line.hpp"
#include "apps/sample_run.hpp"
#include "dem/disks/scales.hpp"
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

// What marches: the fixed or driven grains of walls are left out.
struct Bulk {
  std::int64_t grains = 0, triangles = 0;
};
Bulk bulk(const State<Disks>& state) { return {static_cast<std::int64_t>(state.packing.bodies.size()), 0}; }
Bulk bulk(const State<Spheres>& state) { return {static_cast<std::int64_t>(state.packing.bodies.size()), 0}; }
Bulk bulk(const State<TriangleGrains>& state) {
  const Grains& g = state.packing.grains;
  Bulk b;
  for (std::size_t k = 0; k < g.size(); ++k)
    if (g.part[k] == GrainPart::free) ++b.grains, b.triangles += g.begin[k + 1] - g.begin[k];
  return b;
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
  watch.ended = [&](const AnyState& any, const SampleOutcome&) {
    size = std::visit([](const auto& s) { return bulk(s); }, any);
  };
  const SampleOutcome outcome = run_sample(sample, watch);
  const std::scoped_lock hold(lock);
  total.run.steps += outcome.run.steps, total.run.times += outcome.run.times;
  total.run.cpu_seconds += outcome.run.cpu_seconds;
  total.run.wall_seconds = std::max(total.run.wall_seconds, outcome.run.wall_seconds);
  total.grain_steps += outcome.run.steps * size.grains;
  total.triangle_steps += outcome.run.steps * size.triangles;
  for (const std::string& text : outcome.messages) std::cerr << "isostat pack: " << output << ": " << text << '\n';
  return outcome.code;
}

std::string text(std::optional<double> x) {
  char buffer[32];
  if (!x) return "-";
  std::snprintf(buffer, sizeof buffer, "%.4g", *x);
  return buffer;
}

void print_scales(const PackJob& job, const State<TriangleGrains>& state) {
  const Bulk b = bulk(state);
  const std::size_t walls = state.packing.grains.size() - static_cast<std::size_t>(b.grains);
  std::cerr << b.grains << " grains of " << b.triangles << " triangles";
  if (walls > 0) std::cerr << ", " << walls << " grains of walls";
  std::cerr << "  omega_max " << text(job.scene.step.fraction / state.time_step) << " 1/s  dt " << text(state.time_step)
            << " s; units cm, g, s\n";
}

void print_scales(const PackJob&, const State<Spheres>& state) {
  const auto [smallest, largest] =
      std::minmax_element(state.packing.bodies.radius.begin(), state.packing.bodies.radius.end());
  std::cerr << state.packing.bodies.size() << " spheres  d " << text(2 * *smallest) << " to " << text(2 * *largest)
            << " a  dt " << text(state.time_step) << " T0\n";
}

void print_scales(const PackJob& job, const State<Disks>& state) {
  State<Disks> first = state;
  first.imposed_stress = job.scene.stages.empty() ? ImposedStress<2>{} : imposed_stress<2>(job.scene.stages.front());
  const Scales s = scales(first);
  std::cerr << "kappa " << text(s.kappa) << "  P* " << text(s.reduced_pressure) << "  h0/D0 "
            << text(s.overlap_over_range) << "  e_N " << text(s.restitution) << "  V* " << text(s.velocity) << "  T0 "
            << text(s.time) << "  dt " << text(s.time_step) << " T0  dt/dt_critical "
            << text(s.time_step / s.critical_time_step) << '\n';
  if (job.scene.units) {
    const SiScales si = si_scales(*job.scene.units);
    std::cerr << "SI: a " << text(si.length) << " m  F0 " << text(si.force) << " N  T0 " << text(si.time) << " s  V* "
              << text(s.velocity ? std::optional(*s.velocity * si.velocity()) : std::nullopt) << " m/s  F0/a "
              << text(si.pressure()) << " N/m\n";
  }
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
  write_file_atomically(path, json.dump(2) + "\n");
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
  const Arguments args(argc, argv,
                       {{"-o", "STATE.h5", "where the final state goes"},
                        {"--seed", "N", "seed of the random initial state; default: the scene's"},
                        {"--threads", "N", "threads; the result does not depend on them (default 1)"},
                        {"--samples", "N", "run N samples with seeds N, N+1, ... -> STATE.0001.h5 ..."},
                        {"--set", "KEY=VALUE", "override a scene key", true},
                        {"--max-time", "T", "stop, unfinished, when the run's time reaches T [T0; triangles: s]"},
                        {"--resume", "", "go on from STATE.h5.partial"},
                        {"--timings", "FILE.json", "where the time of the step loop went"}},
                       {"SCENE.toml -o STATE.h5", "Runs the stages of a scene and writes the state it ends in."});
  args.require_inputs(1, 1, "one scene file");
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
  for (int k = 0; k < job.samples; ++k) require_writable(numbered(job.output, k, job.samples));
  if (!job.scene.output.series.empty())
    for (int k = 0; k < job.samples; ++k) require_writable(numbered(job.scene.output.series, k, job.samples));
  if (const auto path = args.value("--timings")) require_writable(*path);

  const InterruptGuard guard;
  std::visit([&job](const auto& state) { print_scales(job, state); }, initial_state(job.scene, job.seed));
  Totals total;
  const int code = run_samples(job, total);
  if (const auto path = args.value("--timings")) write_timings(*path, total, job.scene.system);
  return code;
}

}  // namespace isostat
