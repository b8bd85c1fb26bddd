// What a restart needs to make the neighbour lists as they were (dem/solver/neighbours.hpp).
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/periodic_cell.hpp"

namespace isostat {

// The positions at which the two nested lists were built, and how much of their skins is used up.
template <int D>
struct ListMemory {
  std::vector<Vec<D>> outer_position, inner_position;  // [a] at the last rebuild of each list
  Vec<D> outer_length{}, inner_length{};               // [a] cell edges then; 0 without a cell
  double outer_tilt = 0, inner_tilt = 0;               // [a]
  double outer_skin = 0, inner_skin = 0;               // [a]
  double outer_travel = 0, inner_travel = 0;           // [a] part of the skin that motion may have used since
};

template <int D>
std::optional<PeriodicCell<D>> listed_cell(const Vec<D>& length, double tilt) {
  return length == Vec<D>{} ? std::nullopt : std::optional(PeriodicCell<D>{length, tilt});
}

// What a listed pair carries from step to step; pairs without history are not kept.
template <class History, int D = 2>
struct PairMemory {
  std::int32_t i = 0, j = 0;
  ImageShift<D> shift{};
  History history{};
};

}  // namespace isostat
