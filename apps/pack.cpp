// isostat pack SCENE.toml -o STATE.h5: runs the scene's stages, for one sample or several side by side.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "analysis/version.hpp"
#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "apps/interrupt.hpp"
#include "apps/progress_line.hpp"
#include "dem/atomic_file.hpp"
#include "dem/input_error.hpp"
#include "dem/protocol.hpp"
#include "dem/run_error.hpp"
#include "dem/sample.hpp"
#include "dem/scales.hpp"
#include "dem/scene_file.hpp"
#include "dem/scene_keys.hpp"
#include "dem/series.hpp"
#include "dem/state_file.hpp"

namespace isostat {
namespace {

constexpr double kCheckpointSeconds = 60;

// What all samples share.
struct PackJob {
  Scene scene;
  std::string scene_path, output;
  std::vector<std::string> overrides;
  std::uint64_t seed = 1;
  int samples = 1, threads = 1;
  double max_time = 0;  // [T0]
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

// Appends rows to the series; after a resume it goes on where the file stood at the checkpoint.
class SeriesFile {
 public:
  SeriesFile(const std::string& path, bool energies, double resumed_at) : path_(path), energies_(energies) {
    std::string kept = series_header(energies);
    if (resumed_at >= 0 && std::filesystem::exists(path)) {
      std::ifstream in(path);
      std::string line;
      std::getline(in, line);
      while (std::getline(in, line))
        if (std::strtod(line.c_str(), nullptr) <= resumed_at) kept += line + "\n";
    }
    write_file_atomically(path, kept);
    out_.open(path, std::ios::app);
  }
  void add(const State& state) {
    out_ << series_row(state, energies_) << std::flush;
    if (!out_) throw InputError(path_, 0, "output.series", path_, "cannot be written");
  }

 private:
  std::string path_;
  bool energies_;
  std::ofstream out_;
};

class SampleRun {
 public:
  SampleRun(const PackJob& job, int sample)
      : job_(job),
        sample_(sample),
        output_(numbered(job.output, sample, job.samples)),
        seed_(job.seed + static_cast<std::uint64_t>(sample)) {}

  // The exit code; adds to the timings.
  int run(ProgressLine& line, RunOutcome& total, std::int64_t& grain_steps, std::mutex& lock) {
    if (job_.resume && !std::filesystem::exists(partial()) && std::filesystem::exists(output_)) {
      check_same(read_state(output_), output_);
      return exit_done;
    }
    State state = start();
    RunHooks hooks = make_hooks(line, state);
    SolverOptions options;
    options.threads = job_.samples > 1 ? 1 : job_.threads;
    options.energies = job_.scene.output.energies;
    RunOutcome outcome;
    try {
      outcome = run_stages(state, options, hooks);
    } catch (const RunError& e) {
      write(state, output_);
      say(lock, std::string("the run blew up: ") + e.what() + "; the last sane state is in " + output_);
      return exit_unfinished;
    }
    {
      const std::scoped_lock hold(lock);
      total.steps += outcome.steps, total.times += outcome.times;
      total.cpu_seconds += outcome.cpu_seconds;
      total.wall_seconds = std::max(total.wall_seconds, outcome.wall_seconds);
      grain_steps += outcome.steps * static_cast<std::int64_t>(state.packing.bodies.size());
    }
    if (outcome.interrupted) {
      write(state, partial());
      say(lock, "interrupted at t = " + std::to_string(state.time) +
                    " T0; the same command with --resume goes on from " + partial());
      return exit_interrupted;
    }
    write(state, output_);
    std::filesystem::remove(partial());
    for (const StageOutcome& s : outcome.stages)
      if (!s.met) say(lock, "stage " + std::to_string(s.stage) + " did not meet its end: " + s.reason);
    return outcome.all_met() && state.progress.stage == static_cast<std::int32_t>(job_.scene.stages.size())
               ? exit_done
               : exit_unfinished;
  }

 private:
  std::string partial() const { return output_ + ".partial"; }

  void say(std::mutex& lock, const std::string& text) const {
    const std::scoped_lock hold(lock);
    std::cerr << "isostat pack: " << output_ << ": " << text << '\n';
  }

  void write(const State& state, const std::string& path) const {
    write_state(state, path, {std::string(version()), {}, command_text(job_)});
  }

  void check_same(const State& found, const std::string& path) const {
    if (found.seed != seed_)
      throw InputError(path, 0, "seed", std::to_string(found.seed),
                       "--resume needs the command line that made it: seed is now " + std::to_string(seed_));
    if (scene_to_toml(found.scene) != scene_to_toml(job_.scene))
      throw InputError(path, 0, "scene", "", "--resume needs the command line that made it: the scene differs");
  }

  State start() {
    if (job_.resume && std::filesystem::exists(partial())) {
      State state = read_state(partial());
      check_same(state, partial());
      resumed_at_ = state.time;
      return state;
    }
    return initial_state(job_.scene, seed_);
  }

  RunHooks make_hooks(ProgressLine& line, const State& state) {
    RunHooks hooks;
    hooks.interrupted = InterruptGuard::requested;
    hooks.progress = [this, &line](const Progress& p) { line.update(p, job_.scene, sample_); };
    hooks.checkpoint = [this](const State& s) { write(s, partial()); };
    hooks.checkpoint_seconds = kCheckpointSeconds;
    hooks.max_time = job_.max_time;
    const OutputScene& o = job_.scene.output;
    if (!o.series.empty()) {
      series_ = std::make_unique<SeriesFile>(numbered(o.series, sample_, job_.samples), o.energies, resumed_at_);
      hooks.observe = [this](const State& s) { series_->add(s); };
      hooks.observe_interval = o.series_interval;
    }
    if (!o.snapshot_times.empty() || !o.snapshot_solid_fractions.empty())
      hooks.snapshot = [this, count = snapshots_before(state)](const State& s) mutable {
        char number[24];
        std::snprintf(number, sizeof number, ".snapshot%04d", ++count);
        const std::filesystem::path p(output_);
        write(s, (p.parent_path() / (p.stem().string() + number + p.extension().string())).string());
      };
    return hooks;
  }

  // A resumed run numbers its snapshots on.
  int snapshots_before(const State& state) const {
    int count = 0;
    if (resumed_at_ < 0) return 0;
    const std::filesystem::path p(output_), folder = p.parent_path().empty() ? "." : p.parent_path();
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(p.stem().string() + ".snapshot") && read_state(entry.path().string()).time <= state.time)
        ++count;
    }
    return count;
  }

  const PackJob& job_;
  int sample_;
  std::string output_;
  std::uint64_t seed_;
  double resumed_at_ = -1;  // [T0]
  std::unique_ptr<SeriesFile> series_;
};

void print_scales(const PackJob& job, const State& state) {
  State first = state;
  first.imposed_pressure = job.scene.stages.empty() ? std::nullopt : job.scene.stages.front().pressure;
  const Scales s = scales(first);
  auto text = [](std::optional<double> x) {
    char buffer[32];
    if (!x) return std::string("-");
    std::snprintf(buffer, sizeof buffer, "%.4g", *x);
    return std::string(buffer);
  };
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

void write_timings(const std::string& path, const RunOutcome& total, std::int64_t grain_steps) {
  nlohmann::ordered_json stages;
  for (std::size_t k = 0; k < StepTimes::kNames.size(); ++k)
    stages[std::string(StepTimes::kNames[k])] = total.times.seconds[k];
  const nlohmann::ordered_json json = {{"grain_steps", grain_steps},
                                       {"steps", total.steps},
                                       {"cpu_seconds", total.cpu_seconds},
                                       {"wall_seconds", total.wall_seconds},
                                       {"stages", stages}};
  write_file_atomically(path, json.dump(2) + "\n");
}

// One thread a sample, at most `threads` at a time. The worst exit code wins; bad input of one stops all.
int run_samples(const PackJob& job, RunOutcome& total, std::int64_t& grain_steps) {
  ProgressLine line(static_cast<int>(job.scene.stages.size()), job.samples);
  std::mutex lock;
  std::vector<int> codes(static_cast<std::size_t>(job.samples), exit_done);
  Team team(std::min(job.threads, job.samples));
  team.run(job.samples, [&](int k) {
    codes[static_cast<std::size_t>(k)] =
        InterruptGuard::requested() ? exit_interrupted : SampleRun(job, k).run(line, total, grain_steps, lock);
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
                        {"--max-time", "T", "stop, unfinished, when the run's time reaches T [T0]"},
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
    throw InputError("command line", 0, "--max-time", *args.value("--max-time"), "must be positive [T0]");
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
  print_scales(job, initial_state(job.scene, job.seed));
  RunOutcome total;
  std::int64_t grain_steps = 0;
  const int code = run_samples(job, total, grain_steps);
  if (const auto path = args.value("--timings")) write_timings(*path, total, grain_steps);
  return code;
}

}  // namespace isostat
