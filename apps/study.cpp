// isostat study STUDY.toml -o DIR: what is there stays, what is missing is run, the tables follow from the files.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <regex>
#include <thread>

#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "apps/file_rule.hpp"
#include "apps/interrupt.hpp"
#include "apps/sample_run.hpp"
#include "apps/study/process_pool.hpp"
#include "apps/study/run_record.hpp"
#include "apps/study/run_task.hpp"
#include "apps/study/state_digest.hpp"
#include "apps/study/study.hpp"
#include "apps/study/study_progress.hpp"
#include "apps/study/study_tables.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

namespace fs = std::filesystem;

// One study at a time in a folder. The runs inherit the lock: it lasts until the last of them has written its files.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder) : file_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (file_ < 0 || ::flock(file_, LOCK_EX | LOCK_NB) != 0) {
      if (file_ >= 0) ::close(file_);
      throw InputError(folder, 0, "-o", "", "is in use by another isostat study");
    }
  }
  ~FolderLock() { ::close(file_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

// Files of a run beside its state that one of another scene or seed would leave wrong.
void remove_run(const StudyRun& run) {
  const fs::path base(run.base);
  const std::string name = base.filename().string();
  const std::regex stages_and_snapshots(R"(\.(stage|snapshot)\d+(\.h5|\.analysis\.json))");
  std::vector<fs::path> gone{run.state(), partial_name(run.state()), run.record(), run.report({}),
                             run.base + ".series.csv"};
  for (const auto& entry : fs::directory_iterator(base.parent_path()))
    if (const std::string file = entry.path().filename().string();
        file.starts_with(name) && std::regex_match(file.substr(name.size()), stages_and_snapshots))
      gone.push_back(entry.path());
  for (const fs::path& path : gone) fs::remove(path);
}

// States and partial files in the folder must be of the runs of this study: listed otherwise, or with --fresh removed.
void check_existing(const std::vector<StudyRun>& runs, bool fresh) {
  std::vector<Fault> faults;
  for (const StudyRun& run : runs)
    for (const std::string& path : {run.state(), partial_name(run.state())}) {
      if (!fs::exists(path)) continue;
      std::string difference;
      try {
        const StateDigest& state = state_digest(path);
        if (state.seed != run.seed)
          difference = "seed = " + std::to_string(state.seed) + ", not " + std::to_string(run.seed);
        else
          difference = first_difference(state.scene, run.scene());
      } catch (const InputError& error) {
        if (!fresh) faults.insert(faults.end(), error.faults().begin(), error.faults().end());
        difference = "unreadable";
        if (!fresh) continue;
      }
      if (difference.empty()) continue;
      if (fresh)
        remove_run(run);
      else
        faults.push_back({path, 0, "", "", "is of another study: it has " + difference + "; --fresh runs it again"});
    }
  if (!faults.empty()) throw InputError(std::move(faults));
}

// A study that lies in its own folder, or whose scenes and grains do, must not write over them.
void refuse_own_inputs(const Study& study, const std::vector<StudyRun>& runs, const std::string& folder) {
  FileRule rule;
  rule.reads("STUDY.toml", study.path);
  for (const ParameterSet& set : study.sets) rule.reads("the scene", set.scene_path);
  for (const StudyRun& run : runs) rule.reads("grains.file", run.scene().grains.file);
  for (const char* table : {"study.csv", "runs.csv", "study.json"})
    rule.writes("a table of the study", (fs::path(folder) / table).string());
  for (const StudyRun& run : runs)
    for (const std::string& path : {run.state(), partial_name(run.state()), run.record(), run.series()})
      rule.writes("a file of the run " + fs::path(run.base).filename().string(), path);
  rule.require();
}

// What a killed study may have left half written.
void remove_temporaries(const std::string& folder) {
  const std::regex temporary(R"(.*\.tmp\.\d+\.\d+)");
  std::vector<fs::path> gone;
  for (const auto& entry : fs::directory_iterator(folder))
    if (std::regex_match(entry.path().filename().string(), temporary)) gone.push_back(entry.path());
  for (const fs::path& path : gone) fs::remove(path);
}

std::string name_of(const StudyRun& run) { return fs::path(run.base).filename().string(); }

// The longest runs first: none of them is left over when the others are done.
std::vector<std::size_t> order_of(const std::vector<double>& work, std::vector<std::size_t> tasks) {
  std::stable_sort(tasks.begin(), tasks.end(), [&](std::size_t a, std::size_t b) { return work[a] > work[b]; });
  return tasks;
}

class StudyRunner {
 public:
  StudyRunner(const Study& study, std::string folder, std::size_t at_a_time)
      : study_(study),
        folder_(std::move(folder)),
        at_a_time_(at_a_time),
        runs_(runs_of(study, folder_)),
        errors_(runs_.size()) {}

  const std::vector<StudyRun>& runs() const { return runs_; }

  void forget_reports() {
    for (const StudyRun& run : runs_)
      for (const auto stage : analysed_stages(*run.set)) fs::remove(run.report(stage));
  }

  void run() {
    std::vector<double> work(runs_.size(), 0);
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      if (is_settled(runs_[k], study_.analysis)) continue;
      open.push_back(k);
      work[k] = runs_[k].set->scene.grains.count;
    }
    StudyProgress progress(work, runs_.size(), runs_.size() - open.size(), at_a_time_);
    PoolWatch watch;
    watch.stop = InterruptGuard::requested;
    watch.started = [&](std::size_t k) { progress.started(k); };
    watch.tick = [&] { progress.show(); };
    watch.line = [&](std::size_t k, const std::string& line) {
      constexpr std::string_view kError = "error: ";
      if (line.starts_with(kError))
        errors_[k] = line.substr(kError.size());
      else
        progress.tells(k, name_of(runs_[k]), line);
    };
    watch.ended = [&](std::size_t k, int code) {
      if (code < 0) errors_[k] = "its process was ended by signal " + std::to_string(-code);
      if (code == exit_interrupted) return;
      const auto record = settled_record(runs_[k]);
      progress.ended(k, name_of(runs_[k]),
                     !errors_[k].empty() ? "failed" : std::string(record ? status_name(record->status) : "failed"));
    };
    run_in_processes(
        order_of(work, open), at_a_time_,
        [&](std::size_t k) { return do_run(runs_[k], study_.analysis, progress.on_terminal()); }, watch);
  }

  // Writes the tables; the exit code.
  ExitCode conclude(bool interrupted) const {
    std::vector<RunRecord> records;
    bool all_ok = true;
    std::size_t counts[4] = {};
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      records.push_back(final_record(k));
      const RunRecord& r = records.back();
      ++counts[static_cast<std::size_t>(r.status)];
      if (r.status == RunStatus::ok && r.reason.empty()) continue;
      all_ok = false;
      if (r.status != RunStatus::pending)
        std::cerr << "isostat study: " << name_of(runs_[k]) << ": " << status_name(r.status) << ": " << r.reason
                  << '\n';
    }
    const TableFiles tables = study_tables(study_, runs_, records, folder_);
    write_files_atomically(tables.files);
    for (const std::string& path : tables.stale) fs::remove(path);
    std::cerr << "isostat study: " << runs_.size() << " runs: " << counts[0] << " ok, " << counts[1] << " unfinished, "
              << counts[2] << " failed, " << counts[3] << " pending; tables in " << folder_ << '\n';
    if (interrupted && counts[3] > 0) std::cerr << "isostat study: interrupted; the same command goes on from here\n";
    if (interrupted) return exit_interrupted;
    return all_ok ? exit_done : exit_unfinished;
  }

 private:
  RunRecord final_record(std::size_t k) const {
    const StudyRun& run = runs_[k];
    if (auto record = settled_record(run)) {
      if (!errors_[k].empty()) record->reason = "analysis: " + errors_[k];
      return *record;
    }
    RunRecord record;
    if (const auto kept = read_record(run.record()); kept && fs::exists(partial_name(run.state()))) record = *kept;
    record.status = errors_[k].empty() ? RunStatus::pending : RunStatus::failed;
    record.reason = errors_[k];
    return record;
  }

  const Study& study_;
  std::string folder_;
  std::size_t at_a_time_;
  std::vector<StudyRun> runs_;
  std::vector<std::string> errors_;  // of this call, one a run: what is not in the record
};

}  // namespace

int study_command(int argc, char** argv) {
  const Arguments args(argc, argv,
                       {{"-o", "DIR", "folder of the states and tables; made if there is none"},
                        {"-j", "N", "runs at a time, one thread each; default: the number of cores"},
                        {"--fresh", "", "run again what is in DIR from another scene or seed"},
                        {"--reanalyze", "", "compute the reports of all states anew"}},
                       {"STUDY.toml -o DIR",
                        "Runs parameter sets times seeds, and makes an ensemble row of each set (docs/study.md). What "
                        "is in DIR already is not done again: the same command resumes."});
  args.require_inputs(1, 1, "one study file");
  const std::string folder = args.required("-o");
  const auto cores = std::max(1u, std::thread::hardware_concurrency());
  const auto at_a_time = static_cast<std::size_t>(args.integer("-j", 1, 1024).value_or(cores));
  const Study study = read_study(args.inputs()[0]);

  const bool there = fs::is_directory(folder);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder, 0, "-o", "", "cannot be made: " + error.message());
  const FolderLock lock(folder);
  StudyRunner runner(study, folder, at_a_time);
  refuse_own_inputs(study, runner.runs(), folder);
  if (there) check_existing(runner.runs(), args.has("--fresh"));
  require_writable((fs::path(folder) / "study.csv").string());
  remove_temporaries(folder);
  if (args.has("--reanalyze")) runner.forget_reports();

  const InterruptGuard guard;
  runner.run();
  return runner.conclude(InterruptGuard::requested());
}

}  // namespace isostat
