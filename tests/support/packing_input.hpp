// A list of disks as input of the sections of `analyze`.
#pragma once
#include "analysis/input.hpp"
#include "tests/support/disk_packings.hpp"

namespace isostat::oracle {

inline AnalysisInput input_of(const Disks& d) {
  AnalysisInput input;
  input.path = "test";
  input.state.packing.cell = d.cell;
  Bodies<2>& bodies = input.state.packing.bodies;
  bodies.resize(d.centre.size());
  for (std::size_t i = 0; i < d.centre.size(); ++i) {
    bodies.id[i] = static_cast<std::int64_t>(i);
    bodies.position[i] = d.centre[i];
    bodies.radius[i] = d.radius[i];
  }
  return input;
}

}  // namespace isostat::oracle
