// The systems that Isostat knows. To add one: its folder, its part of the scene (dem/scene/scene.hpp), a line here and
// in systems.cpp, its instantiations in dem/files/state_file.cpp, its static solver in apps/sample_run.cpp, a fixture
// in tests/systems. A state of an unknown system stands only where files and commands meet one; everything else is told
// by template.
#pragma once
#include <cstdint>
#include <string_view>
#include <variant>

#include "dem/disks/disks.hpp"
#include "dem/spheres/spheres.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

using AnyState = std::variant<State<Disks>, State<TriangleGrains>, State<Spheres>>;

// The state that a scene begins with (one of grains.file: at time 0 under the scene's law).
// Throws InputError where the scene cannot be begun.
AnyState initial_state(const Scene& scene, std::uint64_t seed);

}  // namespace isostat
