#include "apps/sample_run.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include "analysis/finishing/newton_finishing.hpp"
#include "analysis/version.hpp"
#include "dem/disks/series.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/files/state_file.hpp"
#include "dem/input_error.hpp"
#include "dem/run/loading.hpp"
#include "dem/run_error.hpp"
#include "dem/scene/text.hpp"
#include "dem/spheres/series.hpp"
#include "dem/triangles/series.hpp"

namespace isostat {
namespace {

constexpr double kCheckpointSeconds = 60;

// Appends rows to the series; after a resume it goes on where the file stood at the checkpoint.
class SeriesFile {
 public:
  SeriesFile(const std::string& path, const std::vector<SeriesColumn>& columns, double resumed_at) : path_(path) {
    std::string kept = series_header(columns);
    if (resumed_at >= 0 && std::filesystem::exists(path)) {
      std::ifstream in(path);
      std::string line;
      std::getline(in, line);
      if (line + "\n" != kept)
        throw InputError(path, 0, "output.series", path,
                         "has other columns than this run: move it away, or begin anew");
      while (std::getline(in, line))
        if (std::strtod(line.c_str(), nullptr) <= resumed_at) kept += line + "\n";
    }
    write_file_atomically(path, kept);
    out_.open(path, std::ios::app);
  }
  void add(const std::vector<SeriesColumn>& columns) {
    out_ << series_row(columns) << std::flush;
    if (!out_) throw InputError(path_, 0, "output.series", path_, "cannot be written");
  }

 private:
  std::string path_;
  std::ofstream out_;
};

// What solves the statics of a system; nothing does for triangles and spheres.
std::unique_ptr<StaticSolver<Disks>> static_solver(const State<Disks>&) { return std::make_unique<NewtonFinishing>(); }
std::unique_ptr<StaticSolver<TriangleGrains>> static_solver(const State<TriangleGrains>&) { return nullptr; }
std::unique_ptr<StaticSolver<Spheres>> static_solver(const State<Spheres>&) { return nullptr; }

// STATE.LABEL.h5
std::string beside(const std::string& output, const std::string& label) {
  const std::filesystem::path p(output);
  return (p.parent_path() / (p.stem().string() + "." + label + p.extension().string())).string();
}

// Why a state is not the end of its run; empty: it is.
std::string what_is_missing(const AnyState& any) {
  return std::visit(
      [](const auto& s) -> std::string {
        const auto stages = static_cast<std::int32_t>(s.scene.stages.size());
        if (!s.progress.unmet.empty()) return s.progress.unmet;
        if (s.progress.stage < stages)
          return "it is in stage " + std::to_string(s.progress.stage) + " of " + std::to_string(stages);
        return "";
      },
      any);
}

// Which stages loaded a network too fast, or did not hold the stress that they imposed; empty: none.
std::string not_quasi_static(const std::vector<StageOutcome>& stages) {
  const StageOutcome *fastest = nullptr, *worst = nullptr;
  std::string which;
  for (const StageOutcome& s : stages) {
    const bool fast = s.inertial_number > kQuasiStatic, loose = s.stress_error > kStressHeld;
    if (fast && (!fastest || s.inertial_number > fastest->inertial_number)) fastest = &s;
    if (loose && (!worst || s.stress_error > worst->stress_error)) worst = &s;
    if (fast || loose) which += (which.empty() ? "" : ", ") + std::to_string(s.stage);
  }
  if (which.empty()) return "";
  char fast[80] = "", loose[80] = "";
  if (fastest)
    std::snprintf(fast, sizeof fast, " inertial number up to %.2g (quasi-static below %g)%s", fastest->inertial_number,
                  kQuasiStatic, worst ? "," : "");
  if (worst) std::snprintf(loose, sizeof loose, " stress off by up to %.2g times what is imposed", worst->stress_error);
  return "not quasi-static, stage " + which + ":" + fast + loose + "; docs/measured/loading.md says what helps";
}

// What makes the same state: the scene but for what is watched of it.
std::string makes(Scene scene) {
  scene.output = {};
  return scene_to_toml(scene);
}

class SampleRun {
 public:
  SampleRun(const SampleJob& job, const SampleWatch& watch) : job_(job), watch_(watch) {}

  SampleOutcome run() {
    if (job_.resume && !std::filesystem::exists(partial()) && std::filesystem::exists(job_.output)) return found();
    start();
    return std::visit([this](auto& state) { return march(state); }, state_);
  }

 private:
  template <class System>
  SampleOutcome march(State<System>& state) {
    SampleOutcome outcome;
    const RunHooks<System> hooks = make_hooks(state);
    const auto finisher = static_solver(state);
    SolverOptions options;
    options.threads = job_.threads;
    options.energies = job_.scene.output.energies;
    try {
      outcome.run = run_stages(state, options, hooks, finisher.get());
    } catch (const RunError& e) {
      outcome.code = exit_unfinished;
      outcome.blew_up = true;
      outcome.messages = {std::string("the run blew up: ") + e.what() + "; the last sane state is kept"};
      state.progress.add_unmet(std::string("the run blew up: ") + e.what());
      end(state, outcome, job_.output);
      return outcome;
    }
    if (outcome.run.interrupted) {
      outcome.code = exit_interrupted;
      outcome.messages = {"interrupted at t = " + std::to_string(state.time) + " " +
                          std::string(time_unit(job_.scene.system)) + "; the same command with --resume goes on from " +
                          partial()};
      end(state, outcome, partial());
      return outcome;
    }
    for (const StageOutcome& s : outcome.run.stages) {
      const std::string stage = "stage " + std::to_string(s.stage);
      if (!s.met)
        outcome.messages.push_back(stage + " did not meet its end: " + s.reason);
      else if (s.nothing_touches)
        outcome.messages.push_back(stage + " meets the criteria of equilibrium with no contact at all: what acts is " +
                                   "below the tolerances, a part of F1 = max(F0, a P)");
      else if (s.moving > 0)
        outcome.messages.push_back(stage + " meets the criteria of equilibrium, but " + std::to_string(s.moving) +
                                   " grains still move in floppy or soft modes" +
                                   (job_.scene.finish.method == Finish::newton
                                        ? ""
                                        : "; finish.method = \"newton\" follows these to their end"));
    }
    if (const std::string why = not_quasi_static(outcome.run.stages); !why.empty()) outcome.messages.push_back(why);
    const bool all_stages = state.progress.stage == static_cast<std::int32_t>(job_.scene.stages.size());
    outcome.code = outcome.run.all_met() && all_stages ? exit_done : exit_unfinished;
    end(state, outcome, job_.output);
    std::filesystem::remove(partial());
    return outcome;
  }

  std::string partial() const { return partial_name(job_.output); }

  // There is a final state, and nothing to resume.
  SampleOutcome found() const {
    const AnyState any = read_state(job_.output);
    check_same(any, job_.output);
    SampleOutcome outcome;
    if (const std::string why = what_is_missing(any); !why.empty()) {
      outcome.code = exit_unfinished;
      outcome.messages = {"is there, unfinished, with nothing to resume from: " + why +
                          "; --force in place of --resume begins anew"};
    }
    if (watch_.ended) watch_.ended(any, outcome);
    return outcome;
  }

  template <class System>
  void write(const State<System>& state, const std::string& path) const {
    write_state(state, path, {std::string(version()), {}, job_.command});
  }

  template <class System>
  void end(const State<System>& state, const SampleOutcome& outcome, const std::string& path) const {
    if (watch_.ended) watch_.ended(state_, outcome);
    write(state, path);
  }

  void check_same(const AnyState& found, const std::string& path) const {
    const auto [seed, scene] =
        std::visit([](const auto& s) { return std::pair(s.seed, scene_to_toml(s.scene)); }, found);
    if (seed != job_.seed)
      throw InputError(path, 0, "seed", std::to_string(seed),
                       "--resume needs the command line that made it: seed is now " + std::to_string(job_.seed));
    if (scene != scene_to_toml(job_.scene))
      throw InputError(path, 0, "scene", "", "--resume needs the command line that made it: the scene differs");
  }

  static double time_of(const AnyState& state) {
    return std::visit([](const auto& s) { return s.time; }, state);
  }

  void start() {
    if (job_.resume && std::filesystem::exists(partial())) {
      state_ = read_state(partial());
      check_same(state_, partial());
      resumed_at_ = time_of(state_);
    } else {
      state_ = initial_state(job_.scene, job_.seed);
    }
  }

  template <class System>
  RunHooks<System> make_hooks(const State<System>& state) {
    RunHooks<System> hooks;
    hooks.interrupted = watch_.interrupted;
    hooks.progress = watch_.progress;
    hooks.checkpoint = [this](const State<System>& s) { write(s, partial()); };
    hooks.checkpoint_seconds = kCheckpointSeconds;
    hooks.max_time = job_.max_time;
    const OutputScene& o = job_.scene.output;
    if (o.stages)
      hooks.stage_end = [this](const State<System>& s) {
        const auto next = static_cast<std::size_t>(s.progress.stage);
        if (next < job_.scene.stages.size()) write(s, stage_name(job_.output, next - 1));
      };
    if (!job_.series.empty()) {
      series_ = std::make_unique<SeriesFile>(job_.series, series_columns(state, o.energies), resumed_at_);
      hooks.observe = [this](const State<System>& s) { series_->add(series_columns(s, job_.scene.output.energies)); };
      hooks.observe_interval = o.series_interval;
    }
    if (o.keeps_snapshots())
      hooks.snapshot = [this, count = snapshots_before(state.time)](const State<System>& s) mutable {
        write(s, snapshot(++count));
      };
    return hooks;
  }

  std::string snapshot(int number) const {
    char label[24];
    std::snprintf(label, sizeof label, "snapshot%04d", number);
    return beside(job_.output, label);
  }

  // A resumed run numbers its snapshots on from the last one before the checkpoint. They are numbered in order of time:
  // from the last file back, only those are read that are written anew.
  int snapshots_before(double time) const {
    int last = 0;
    if (resumed_at_ < 0) return 0;
    while (std::filesystem::exists(snapshot(last + 1))) ++last;
    while (last > 0 && time_of(read_state(snapshot(last))) > time) --last;
    return last;
  }

  const SampleJob& job_;
  const SampleWatch& watch_;
  AnyState state_;
  double resumed_at_ = -1;  // [T0]
  std::unique_ptr<SeriesFile> series_;
};

}  // namespace

std::string partial_name(const std::string& output) { return output + ".partial"; }

std::string stage_name(const std::string& output, std::size_t stage) {
  return beside(output, "stage" + std::to_string(stage));
}

std::string lost_with(const std::string& path, const Scene& scene, std::uint64_t seed, double max_time) {
  try {
    const AnyState any = read_state(path);
    if (!what_is_missing(any).empty()) return "";
    const auto [old_seed, old_scene] = std::visit([](const auto& s) { return std::pair(s.seed, makes(s.scene)); }, any);
    if (old_seed != seed) return "holds the finished state of seed " + std::to_string(old_seed);
    if (old_scene != makes(scene)) return "holds the finished state of another scene";
    if (max_time > 0 && std::visit([](const auto& s) { return s.time; }, any) > max_time)
      return "holds the finished state, and --max-time may stop this run before";
    return "";
  } catch (const InputError&) {
    return "is no state that can be read";
  }
}

SampleOutcome run_sample(const SampleJob& job, const SampleWatch& watch) { return SampleRun(job, watch).run(); }

}  // namespace isostat
