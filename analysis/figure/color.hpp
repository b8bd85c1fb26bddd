// Colours of the figures: the force convention of Gilabert 2007, Fig. 2, a qualitative set for curves and clusters, and
// a diverging map for signed fields.
#pragma once
#include <array>
#include <cstddef>

namespace isostat {

struct Color {
  double red = 0, green = 0, blue = 0;  // sRGB, 0 to 1
  friend constexpr bool operator==(const Color&, const Color&) = default;
};

constexpr Color rgb(int hex) { return {((hex >> 16) & 255) / 255.0, ((hex >> 8) & 255) / 255.0, (hex & 255) / 255.0}; }

constexpr Color blend(const Color& a, const Color& b, double t) {
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green), a.blue + t * (b.blue - a.blue)};
}

inline constexpr Color kBlack = rgb(0x000000), kWhite = rgb(0xffffff), kInk = rgb(0x262626), kFaint = rgb(0x9a9a9a);

// Links (Fig. 2): compressive red, tensile green, distant (or below the threshold) blue.
inline constexpr Color kCompressive = rgb(0xd7191c), kTensile = rgb(0x12964a), kDistant = rgb(0x2b6fdb),
                       kBeam = rgb(0x8e3b9e);

// Disks: plain, with thin outline; rattlers grey (Fig. 2); only touched by links below the threshold, light grey (Fig.
// 11).
inline constexpr Color kDisk = rgb(0xffffff), kDiskOutline = rgb(0x787878), kRattler = rgb(0xa8a8a8),
                       kUnstressed = rgb(0xdedede), kGrain = rgb(0xecdcb9), kGrainOutline = rgb(0x7d6b45),
                       kWall = rgb(0xc3c9d1);

// Distinguishable also for the most common colour blindness, and in order of use.
inline constexpr std::array<Color, 8> kCurves = {rgb(0x1f5fa8), rgb(0xd95f02), rgb(0x1b8a5a), rgb(0x8e3b9e),
                                                 rgb(0xc2185b), rgb(0x6d6d6d), rgb(0xb58900), rgb(0x17a2b8)};
constexpr Color curve_color(std::size_t index) { return kCurves[index % kCurves.size()]; }

// -1 blue, 0 nearly white, +1 orange-red; outside it saturates.
constexpr Color diverging(double t) {
  constexpr Color cold = rgb(0x3b6db5), cool = rgb(0xa3c3e4), middle = rgb(0xf8f7f3), warm = rgb(0xf6bd98),
                  hot = rgb(0xcf4a3c);
  if (t >= 1) return hot;
  if (t >= .5) return blend(warm, hot, 2 * t - 1);
  if (t >= 0) return blend(middle, warm, 2 * t);
  if (t >= -.5) return blend(middle, cool, -2 * t);
  if (t > -1) return blend(cool, cold, -2 * t - 1);
  return cold;
}

// 0 pale, 1 dark: densities.
constexpr Color sequential(double t) {
  constexpr Color pale = rgb(0xe3ebf5), middle = rgb(0x4f87c2), dark = rgb(0x14224d);
  if (t <= 0) return pale;
  if (t < .5) return blend(pale, middle, 2 * t);
  return t < 1 ? blend(middle, dark, 2 * t - 1) : dark;
}

}  // namespace isostat
