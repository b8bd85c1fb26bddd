// Which links of a network lie on a closed loop.
#pragma once
#include <cstdint>
#include <vector>

#include "dem/state/packing.hpp"

namespace isostat {

struct LoopCount {
  std::vector<char> on_loop;     // by link: some closed way along links passes it once; a beam counts as a link
  std::int64_t independent = 0;  // loops: links - bodies + components (all held bodies are one), windings included
  std::int64_t components = 0;   // connected parts of the network, lone bodies included
};

// A loop may wind around the cell, or close through walls. A link on none is a bridge: it cuts the network in two when
// it is cut, and by the balance of either part it bears nothing, whatever the cell bears.
template <int D>
LoopCount count_loops(const Packing<D>& packing);

}  // namespace isostat
