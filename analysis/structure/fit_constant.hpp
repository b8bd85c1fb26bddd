// What the constant of a fit of Eq. 28 (Gilabert 2007) may be.
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace isostat {

// The constant of Eq. 28: any, not below 0, or none. An intensity cannot be negative, but where the window ends below
// the range in which I(k) is fractal a free constant goes below 0 and takes d_F with it.
enum class FitConstant { free, nonnegative, zero };
inline constexpr std::array<std::string_view, 3> kFitConstantNames{"free", "nonnegative", "zero"};
constexpr std::string_view name_of(FitConstant c) { return kFitConstantNames[static_cast<std::size_t>(c)]; }

constexpr std::optional<FitConstant> fit_constant_named(std::string_view name) {  // none: no such choice
  for (std::size_t k = 0; k < kFitConstantNames.size(); ++k)
    if (kFitConstantNames[k] == name) return static_cast<FitConstant>(k);
  return std::nullopt;
}

}  // namespace isostat
