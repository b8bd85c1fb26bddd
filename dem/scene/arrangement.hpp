// How the grains of a scene stand at the start, in every system.
#pragma once
#include <array>
#include <string_view>

namespace isostat {

enum class Arrangement { random, collision };
inline constexpr std::array<std::string_view, 2> kArrangementNames{"random", "collision"};

}  // namespace isostat
