// Why `analyze` does not compute a section of an input.
#pragma once
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "analysis/report.hpp"
#include "dem/input_error.hpp"

namespace isostat::oracle {

inline std::string refusal(const AnalysisInput& input, const char* section, const AnalysisOptions& options = {}) {
  try {
    analyze(input, options, {section});
  } catch (const InputError& error) {
    return error.faults().at(0).rule;
  }
  return "taken";
}

}  // namespace isostat::oracle
