// How many contacts a packing has when they are found by touching, as a function of the gap that still touches: only a
// plateau of that curve is a measurement of contacts.
#pragma once
#include <string>
#include <vector>

#include "analysis/input.hpp"

namespace isostat {

struct ContactTolerance {
  double used = 0;                     // gap up to which the contacts of the input were found [length]
  std::vector<double> tolerance;       // two a decade, from 1e-9 to 1e-1 of the mean radius [length]
  std::vector<std::int64_t> contacts;  // with at most this gap
  std::vector<double> z;               // 2 contacts / grains
  double low = 0, high = 0;            // tolerances that could as well have been used [length]
  double z_used = 0, z_low = 0, z_high = 0;

  // z changes by more than a fifth (and by more than 0.1) between `low` and `high`. These are a third and three times
  // the tolerance used; `high` is at least as far above it as the gaps of the contacts found are wide (their root mean
  // square: positions with an error make as many small gaps as small overlaps, contacts of soft grains do not), and at
  // least a thousandth of the mean radius, which any measurement resolves at best.
  bool in_doubt() const;
};

// Of an input with touching_tolerance.
ContactTolerance contact_tolerance(const AnalysisInput& input);

// The sentence about it; empty where the contacts were given, or do not hang on the tolerance.
std::string contact_warning(const AnalysisInput& input);

}  // namespace isostat
