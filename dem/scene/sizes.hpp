// What a user asks of the sizes of grains, of every system of round bodies.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace isostat {

enum class SizeLaw { uniform, bidisperse, lognormal, power_law, table };
inline constexpr std::array<std::string_view, 5> kSizeLawNames{"uniform", "bidisperse", "lognormal", "power-law",
                                                               "table"};

// What shares and laws count: grains, or their volume (in the plane their area), as sieves and light scattering do.
enum class ShareOf { number, volume };
inline constexpr std::array<std::string_view, 2> kShareOfNames{"number", "volume"};

// Keys of [grains].
struct SizesScene {
  double diameter_min = 0.5;  // [a]
  double diameter_max = 1.0;  // [a]
  SizeLaw sizes = SizeLaw::uniform;
  ShareOf share_of = ShareOf::number;
  std::optional<double> exponent;  // b of N(d) ~ d^-b; given alone it makes `uniform` a power law
  double large_share = 0.5;        // of the larger grains of two sizes
  double density_ratio = 1;        // [-] density of the larger over that of the smaller ones
  double log_deviation = 0.25;     // standard deviation of ln d
  std::optional<double> median;    // [a] of the log-normal law before its cuts; absent: sqrt(diameter_min diameter_max)
  std::string size_table;          // CSV file of a measured distribution
  SizeLaw law() const { return sizes == SizeLaw::uniform && exponent ? SizeLaw::power_law : sizes; }
  friend bool operator==(const SizesScene&, const SizesScene&) = default;
};

}  // namespace isostat
