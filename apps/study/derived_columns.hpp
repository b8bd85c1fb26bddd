// The derived columns and slopes of a study file, read and checked.
#pragma once
#include "apps/study/study.hpp"
#include "apps/study/study_faults.hpp"
#include "apps/study/study_file.hpp"

namespace isostat {

// Fills study.derived and study.slopes; adds the faults of names and expressions.
void make_derived_columns(const StudyFile& file, Study& study, StudyFaults& faults);

}  // namespace isostat
