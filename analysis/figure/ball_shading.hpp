// How a sphere is lit: shades from a bright spot to the dark rim. Written once, for canvases of all formats.
#pragma once
#include <array>

#include "analysis/figure/color.hpp"
#include "geometry/vec.hpp"

namespace isostat {

struct BallShade {
  double offset;  // 0 at the bright spot, 1 at the rim
  Color color;
};

inline constexpr Vec2 kBallSpot{{-0.34, -0.4}};  // [radius] from the centre on the page: light from the upper left

constexpr std::array<BallShade, 3> ball_shades(const Color& color) {
  return {{{0, blend(color, kWhite, 0.7)}, {0.55, color}, {1, blend(color, kBlack, 0.34)}}};
}

}  // namespace isostat
