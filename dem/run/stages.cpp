#include "dem/run/stages.hpp"

#include <algorithm>

namespace isostat {

bool RunOutcome::all_met() const {
  return std::all_of(stages.begin(), stages.end(), [](const StageOutcome& s) { return s.met; });
}

}  // namespace isostat
