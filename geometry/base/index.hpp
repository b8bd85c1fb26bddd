// Bodies, links and sites are numbered by std::int32_t, arrays by std::size_t.
#pragma once
#include <concepts>
#include <cstddef>

namespace isostat {

// A number that is not negative, as an index into an array.
constexpr std::size_t idx(std::integral auto i) { return static_cast<std::size_t>(i); }

}  // namespace isostat
