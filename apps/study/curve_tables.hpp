// Tables of the curves of a study: curve.NAME.csv, the mean over the samples of each parameter set at each x, and
// peaks.csv, the largest y of each sample and where it is, in the mean.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "apps/study/run_record.hpp"
#include "apps/study/study.hpp"

namespace isostat {

// Names and contents; none without curves. `records` has one entry a run; only runs that are ok enter. Throws
// InputError where a series is not there or lacks a column.
std::vector<std::pair<std::string, std::string>> curve_tables(const Study& study, const std::vector<StudyRun>& runs,
                                                              const std::vector<RunRecord>& records);

}  // namespace isostat
