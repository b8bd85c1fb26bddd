// Options of `isostat analyze` as the analysis takes them.
#pragma once
#include <string>
#include <vector>

#include "analysis/input.hpp"
#include "apps/arguments.hpp"

namespace isostat {

// Both throw InputError for a value out of its range. Those that say what a file without contacts, cell or law is taken
// to mean (`draw` has them, too), and all of them.
AnalysisOptions reading_options(const Arguments& arguments);
AnalysisOptions analysis_options(const Arguments& arguments);

// Throws InputError for an option about a section that is not among those named.
void refuse_options_of_other_sections(const Arguments& arguments, const std::vector<std::string>& only);

}  // namespace isostat
