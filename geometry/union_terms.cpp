#include "geometry/union_terms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "geometry/base/index.hpp"
#include "geometry/overlap_points.hpp"

namespace isostat {
namespace {

struct Pair {
  std::int32_t i, j;
  Vec2 branch;  // to the image of j
};

// All overlapping pairs by bins, or nothing where bins do not help (small cells, very unequal disks).
std::optional<std::vector<Pair>> overlapping_pairs(std::span<const Vec2> centre, std::span<const double> radius,
                                                   const PeriodicCell<2>& cell) {
  constexpr double kMostPerBin = 40;
  const double largest = *std::max_element(radius.begin(), radius.end());
  if (!(largest > 0)) return std::vector<Pair>{};
  const Vec2 spacing = cell.spacing();
  const double bins_x = std::floor(spacing[0] / (2 * largest)), bins_y = std::floor(spacing[1] / (2 * largest));
  if (bins_x < 3 || bins_y < 3 || static_cast<double>(centre.size()) > kMostPerBin * bins_x * bins_y)
    return std::nullopt;
  const double most = std::ceil(std::sqrt(static_cast<double>(centre.size()))) + 3;
  const int nx = static_cast<int>(std::min(bins_x, most)), ny = static_cast<int>(std::min(bins_y, most));
  std::vector<Vec2> at(centre.begin(), centre.end());
  std::vector<std::int32_t> bin(at.size()), first(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) + 1, 0),
      member(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    at[i] = cell.wrap(at[i]);
    const Vec2 f = cell.fractions(at[i]);
    const int x = std::clamp(static_cast<int>(f[0] * nx), 0, nx - 1),
              y = std::clamp(static_cast<int>(f[1] * ny), 0, ny - 1);
    bin[i] = y * nx + x;
    ++first[idx(bin[i]) + 1];
  }
  for (std::size_t b = 1; b < first.size(); ++b) first[b] += first[b - 1];
  auto fill = first;
  for (std::size_t i = 0; i < at.size(); ++i) member[idx(fill[idx(bin[i])]++)] = static_cast<std::int32_t>(i);
  std::vector<Pair> pairs;
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int ox = x + dx, oy = y + dy;
          const Vec2 move = cell.offset({ox < 0 ? -1 : ox >= nx ? 1 : 0, oy < 0 ? -1 : oy >= ny ? 1 : 0});
          const auto here = idx(y * nx + x), there = idx(((oy + ny) % ny) * nx + (ox + nx) % nx);
          for (auto a = first[here]; a < first[here + 1]; ++a)
            for (auto b = first[there]; b < first[there + 1]; ++b) {
              const auto i = member[idx(a)], j = member[idx(b)];
              if (j <= i) continue;
              const Vec2 s = at[idx(j)] + move - at[idx(i)];
              const double reach = radius[idx(i)] + radius[idx(j)];
              if (dot(s, s) < reach * reach) pairs.push_back({i, j, s});
            }
        }
  return pairs;
}

// True if some disk may reach into the lens of two others, or lies inside another.
bool deep_overlaps(const std::vector<Pair>& pairs, std::span<const double> radius) {
  std::vector<std::vector<std::pair<std::int32_t, Vec2>>> around(radius.size());
  for (const auto& p : pairs)
    around[idx(p.i)].push_back({p.j, p.branch}), around[idx(p.j)].push_back({p.i, -1.0 * p.branch});
  for (const auto& p : pairs) {
    const double r = radius[idx(p.i)], q = radius[idx(p.j)], d = norm(p.branch);
    if (d <= std::abs(r - q)) return true;
    const double foot = (d * d + (r - q) * (r + q)) / (2 * d), s = std::sqrt(std::max(0.0, (r - foot) * (r + foot)));
    const double lens = std::max(s, r + q - d);  // radius of a circle about the foot that holds the lens
    for (const auto& [k, branch] : around[idx(p.i)]) {
      const Vec2 apart = branch - (foot / d) * p.branch;
      if ((k != p.j || norm(branch - p.branch) > 0.5 * d) && norm(apart) < radius[idx(k)] + lens) return true;
    }
  }
  return false;
}

}  // namespace

std::optional<UnionTerms> union_terms(std::span<const Vec2> centre, std::span<const double> radius,
                                      const PeriodicCell<2>& cell, double k_max, double tolerance) {
  UnionTerms out;
  out.disk_weight.assign(centre.size(), 1);
  if (centre.empty()) return out;
  const auto pairs = overlapping_pairs(centre, radius, cell);
  if (!pairs || deep_overlaps(*pairs, radius)) return std::nullopt;
  OverlapPoints points(out, k_max, tolerance);
  for (const auto& p : *pairs) {
    const auto whole = points.lens(centre[idx(p.i)], p.branch, radius[idx(p.i)], radius[idx(p.j)], -1);
    out.disk_weight[idx(p.i)] += whole[0], out.disk_weight[idx(p.j)] += whole[1];
  }
  return out;
}

}  // namespace isostat
