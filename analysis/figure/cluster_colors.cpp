#include "analysis/figure/cluster_colors.hpp"

#include <algorithm>
#include <set>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

constexpr double kStrong = 0.35, kPale = 0.75;  // part of white in a hyperstatic and in an isostatic cluster

}  // namespace

std::vector<std::size_t> cluster_colors(std::size_t clusters, const std::vector<std::array<std::int32_t, 2>>& meet) {
  std::vector<std::set<std::int32_t>> neighbours(clusters);
  for (const auto& [a, b] : meet)
    if (a >= 0 && b >= 0 && a != b) neighbours[idx(a)].insert(b), neighbours[idx(b)].insert(a);
  std::vector<std::size_t> color(clusters, kCurves.size());
  for (std::size_t c = 0; c < clusters; ++c) {
    std::array<bool, kCurves.size()> used{};
    for (const std::int32_t n : neighbours[c])
      if (color[idx(n)] < kCurves.size()) used[color[idx(n)]] = true;
    const auto first = static_cast<std::size_t>(std::find(used.begin(), used.end(), false) - used.begin());
    color[c] = first < used.size() ? first : c % kCurves.size();
  }
  return color;
}

std::vector<Color> cluster_fills() {
  std::vector<Color> fills{kDisk};
  for (const Color& c : kCurves)
    for (const double white : {kStrong, kPale}) fills.push_back(blend(c, kWhite, white));
  return fills;
}

std::vector<LegendItem> cluster_legend(double em, const std::vector<std::int32_t>& of_body,
                                       const std::vector<bool>& hyperstatic) {
  const Stroke outline{kDiskOutline, 0.5, {}};
  const auto with = [&](bool h) { return std::find(hyperstatic.begin(), hyperstatic.end(), h) != hyperstatic.end(); };
  std::vector<LegendItem> items;
  if (with(true))
    items.push_back(disk_item(em, {blend(kCurves[0], kWhite, kStrong), outline}, plain("hyperstatic cluster")));
  if (with(false))
    items.push_back(disk_item(em, {blend(kCurves[0], kWhite, kPale), outline}, plain("isostatic cluster")));
  if (std::find(of_body.begin(), of_body.end(), -1) != of_body.end())
    items.push_back(disk_item(em, {kDisk, outline}, plain("single")));
  return items;
}

}  // namespace isostat
