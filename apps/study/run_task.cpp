#include "apps/study/run_task.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/progress_line.hpp"
#include "apps/sample_run.hpp"
#include "apps/study/process_pool.hpp"
#include "apps/study/state_digest.hpp"
#include "apps/study/state_report.hpp"
#include "dem/files/state_file.hpp"
#include "dem/solver/clocks.hpp"

namespace isostat {
namespace {

constexpr double kTellSeconds = 0.25;

// A state that came without a record: what it says of its own end.
template <class System>
RunRecord adopted(const State<System>& state) {
  RunRecord record = record_of(state);
  const bool all_stages = state.progress.stage == static_cast<std::int32_t>(state.scene.stages.size());
  if (all_stages && (!waits_for_equilibrium(state.scene.stages.back().until) || record.certified)) {
    record.status = RunStatus::ok;
  } else {
    record.status = RunStatus::unfinished;
    record.reason = "the state is not at the end of its last stage; there is no record of its run";
  }
  return record;
}

// Tells the parent how far the run is, a few times a second.
class Teller {
 public:
  void operator()(const Progress& p, const Scene& scene) {
    const double now = wall_seconds();
    if (now - last_ < kTellSeconds) return;
    last_ = now;
    TaskLink::send("stage " + std::to_string(p.stage + 1) + "/" + std::to_string(scene.stages.size()) + "  " +
                   time_text(p.time, scene.system) + solid_fraction_text(p.solid_fraction) + "  " +
                   missing_text(p, scene.stages[static_cast<std::size_t>(p.stage)]));
  }

 private:
  double last_ = -kTellSeconds;  // [s]
};

RunRecord make_state(const StudyRun& run, bool tell_progress) {
  const SampleJob job{run.scene(), run.seed, run.state(), run.series(), run.command(), 1, 0, true};
  double spent = 0;  // [s] in the parts before an interruption
  if (std::filesystem::exists(partial_name(job.output)))
    if (const auto before = read_record(run.record())) spent = before->cpu_seconds.value_or(0);
  RunRecord record;
  Teller tell;
  SampleWatch watch;
  watch.interrupted = TaskLink::stop_requested;
  if (tell_progress) watch.progress = [&](const Progress& p) { tell(p, job.scene); };
  // Before the state: a record without its state is not believed, a state without its record would have lost something.
  watch.ended = [&](const AnyState& any, const SampleOutcome& outcome) {
    record = std::visit([](const auto& state) { return record_of(state); }, any);
    record.status = outcome.code == exit_done          ? RunStatus::ok
                    : outcome.code == exit_interrupted ? RunStatus::pending
                    : outcome.blew_up                  ? RunStatus::failed
                                                       : RunStatus::unfinished;
    if (!outcome.blew_up) record.cpu_seconds = spent + outcome.run.cpu_seconds;
    if (record.status == RunStatus::failed || record.status == RunStatus::unfinished)
      for (const std::string& m : outcome.messages) record.reason += (record.reason.empty() ? "" : "; ") + m;
    write_record(record, run.record());
  };
  run_sample(job, watch);
  return record;
}

}  // namespace

std::optional<RunRecord> settled_record(const StudyRun& run) {
  if (!std::filesystem::exists(run.state())) return std::nullopt;
  if (auto record = read_record(run.record());
      record && record->hash == state_digest(run.state()).hash && record->status != RunStatus::pending)
    return record;
  const RunRecord record = std::visit([](const auto& s) { return adopted(s); }, read_state(run.state()));
  write_record(record, run.record());
  return record;
}

bool is_settled(const StudyRun& run, const StudyAnalysis& analysis) {
  const auto record = settled_record(run);
  if (!record) return false;
  if (record->status != RunStatus::ok) return true;
  for (const auto stage : analysed_stages(*run.set)) {
    const auto report = stored_report(run.report(stage), run.state(stage), analysis.options);
    if (!report || !has_sections(*report, analysis.sections)) return false;
  }
  return true;
}

int do_run(const StudyRun& run, const StudyAnalysis& analysis, bool tell_progress) {
  auto record = settled_record(run);
  if (!record) record = make_state(run, tell_progress);
  if (record->status == RunStatus::pending) return exit_interrupted;
  if (record->status != RunStatus::ok) return exit_unfinished;
  TaskLink::may_be_cut_short();
  for (const auto stage : analysed_stages(*run.set)) update_report(run.report(stage), run.state(stage), analysis);
  return exit_done;
}

}  // namespace isostat
