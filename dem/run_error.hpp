// A run that blows up: stops with the step, the grain, the cause and the scene key to turn.
#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>

namespace isostat {

class RunError : public std::runtime_error {
 public:
  RunError(std::int64_t step, std::int64_t grain, const std::string& cause, const std::string& advice)
      : std::runtime_error("step " + std::to_string(step) + (grain >= 0 ? ", grain " + std::to_string(grain) : "") +
                           ": " + cause + "; " + advice) {}
};

}  // namespace isostat
