#include "dem/state/density_profile.hpp"

#include <algorithm>

namespace isostat {

std::vector<double> density_profile(std::span<const Vec2> position, std::span<const double> weight, double low,
                                    double high, std::size_t slices) {
  std::vector<std::vector<double>> members(slices);
  const double thickness = (high - low) / static_cast<double>(slices);
  for (std::size_t k = 0; k < position.size(); ++k) {
    const double y = position[k][1];
    if (!(y >= low && y < high)) continue;
    const auto slice = static_cast<std::size_t>((y - low) / thickness);
    members[std::min(slice, slices - 1)].push_back(weight[k]);
  }
  std::vector<double> profile(slices, 0.0);
  for (std::size_t s = 0; s < slices; ++s) {
    std::sort(members[s].begin(), members[s].end());  // storage order must not show in the last bit
    for (const double w : members[s]) profile[s] += w / thickness;
  }
  return profile;
}

}  // namespace isostat
