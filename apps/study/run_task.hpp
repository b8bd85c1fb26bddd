// What is done for one run of a study: its state, the record of it, the reports of its states. All of it is kept in
// files, so that whatever has been done is not done again.
#pragma once
#include <optional>

#include "apps/study/run_record.hpp"
#include "apps/study/study.hpp"

namespace isostat {

// The record of a run whose state is there; none if it is not. A state without its record (made by `pack`) gets one.
std::optional<RunRecord> settled_record(const StudyRun& run);

// Whether state, record and reports are there.
bool is_settled(const StudyRun& run, const StudyAnalysis& analysis);

// In a process of its own (TaskLink): makes what is not there. The exit code of the run.
int do_run(const StudyRun& run, const StudyAnalysis& analysis, bool tell_progress);

}  // namespace isostat
