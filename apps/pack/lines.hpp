// What `pack` tells on stderr: before a run the dimensionless numbers that it begins with, after it where it ended.
#pragma once
#include <cstdint>
#include <string>

#include "apps/sample_run.hpp"
#include "dem/scene/scene.hpp"
#include "dem/systems.hpp"

namespace isostat {

// What marches: the fixed or driven grains of walls are left out.
struct Bulk {
  std::int64_t grains = 0, triangles = 0;
};
Bulk bulk(const AnyState& state);

std::string first_lines(const Scene& scene, const AnyState& state);
// One line, with its newline: FILE: Phi, z, equilibrium or not, time of the run, seconds that it took.
std::string last_line(const std::string& path, const AnyState& state, const SampleOutcome& outcome);

}  // namespace isostat
