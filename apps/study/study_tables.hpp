// The tables of a study: an ensemble row a parameter set (and stage), a line a run.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "apps/study/run_record.hpp"
#include "apps/study/study.hpp"

namespace isostat {

struct TableFiles {
  std::vector<std::pair<std::string, std::string>> files;  // path, content
  std::vector<std::string> stale;                          // reports of ensembles that have no sample any more
};

// study.csv, runs.csv, study.json and NAME.report.json of every ensemble, from the files of the runs. `records` has one
// entry a run; only runs that are ok enter an ensemble, and of these the ones whose report is there.
TableFiles study_tables(const Study& study, const std::vector<StudyRun>& runs, const std::vector<RunRecord>& records,
                        const std::string& directory);

}  // namespace isostat
