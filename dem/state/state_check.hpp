// What every stored State obeys: array sizes, finite numbers, indices in range.
#pragma once
#include <optional>
#include <string>

#include "dem/state/state.hpp"

namespace isostat {

struct StateFault {
  std::string field;  // as in the state file: "links/i"
  std::string rule;
};

// The first broken rule, if any.
template <int D>
std::optional<StateFault> packing_fault(const Packing<D>& packing);
std::optional<StateFault> state_fault(const State& state);

}  // namespace isostat
