// Rows times grid: the parameter sets of a study, each with its scene resolved.
#pragma once
#include "apps/study/study.hpp"
#include "apps/study/study_faults.hpp"
#include "apps/study/study_file.hpp"

namespace isostat {

// Fills study.sets and study.keys; adds the faults of names, stages and scenes.
void make_parameter_sets(const StudyFile& file, Study& study, StudyFaults& faults);

}  // namespace isostat
