// The legend of a picture of forces, of disks and of spheres.
#pragma once
#include <array>
#include <vector>

#include "analysis/figure/legend.hpp"
#include "analysis/figure/picture_content.hpp"

namespace isostat {

inline constexpr std::array<Color, 3> kLinkColors = {kCompressive, kTensile, kDistant};  // by LinkColor
inline constexpr std::array<Color, 3> kShades = {kDisk, kRattler, kUnstressed};          // by DiskShade

// Which colours of links and shades of grains there are.
struct ForceMarks {
  std::array<bool, 3> color{}, shade{};
};

// width_of_scale [pt]: of a force F1.
std::vector<LegendItem> force_legend(const ForceOptions& options, const ForceMarks& marks, double width_of_scale,
                                     double em);

}  // namespace isostat
