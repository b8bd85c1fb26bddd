// From a file to the input of an analysis.
#pragma once
#include <string>

#include "analysis/input.hpp"

namespace isostat {

// Any packing file (dem/files/packing_file.hpp). Throws InputError if it cannot be read, or for --cell free without a
// cell.
AnalysisInput load_input(const std::string& path, const AnalysisOptions& options);

}  // namespace isostat
