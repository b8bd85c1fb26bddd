// The hash of the physical state of spheres (docs/formats.md).
#pragma once
#include <string>

#include "dem/spheres/spheres.hpp"

namespace isostat {

// 32 digits; the same for any order of storage, and whatever the solver remembers.
std::string physical_hash(const State<Spheres>& state);

}  // namespace isostat
