// Reports of several inputs merged into one: each number becomes {"mean", "sd", "se"} over the inputs.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/report.hpp"

namespace isostat {

// sd is the sample standard deviation (n - 1), se = sd / sqrt(n); both null for n = 1. Inputs where a number is null or
// absent do not count; "n" is then added. Objects and arrays of one shape are merged entry by entry, with these
// exceptions: "inputs" and "warnings" are concatenated; "x" is padded with zeros; equal strings, booleans and bin edges
// stay as they are; histograms ({"edges", "density"} and further numbers by bin) of equal bin width are aligned, a bin
// outside a sample's range being empty (its further numbers undefined); arrays of different lengths, lists of objects,
// ids, and differing strings become one entry an input. Quantities with a standard error beside them do not count where
// their fit says "identifiable": false. A section with its own `align` and `pooled` is aligned first, and gets its
// pooled value.
nlohmann::ordered_json merge_reports(const std::vector<nlohmann::ordered_json>& reports);

}  // namespace isostat
