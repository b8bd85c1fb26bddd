#include "analysis/compare/rigid_regions.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"
#include "geometry/union_find.hpp"

namespace isostat {
namespace {

// A kept contact as seen from its grains, `first` to `second`, before and after.
template <int D>
struct KeptLink {
  std::int32_t first, second;  // matched grains
  Vec<D> before, after;
};

double turn(const KeptLink<2>& l) {
  return std::atan2(l.before[0] * l.after[1] - l.before[1] * l.after[0], dot(l.before, l.after));
}

// How much the angle between two links at a grain has changed [rad].
double bending(const KeptLink<2>& a, const KeptLink<2>& b, std::int32_t) {
  return std::abs(std::remainder(turn(a) - turn(b), 2 * std::acos(-1.0)));
}
double angle(const Vec3& a, const Vec3& b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }
double bending(const KeptLink<3>& a, const KeptLink<3>& b, std::int32_t grain) {
  const double sign = (a.first == grain) == (b.first == grain) ? 1 : -1;
  return std::abs(angle(a.before, sign * b.before) - angle(a.after, sign * b.after));
}

template <int D>
std::vector<KeptLink<D>> kept_links(const Packing<D>& before, const Packing<D>& after, const Matching& grains,
                                    const LinkChanges& contacts) {
  std::vector<KeptLink<D>> kept;
  for (std::size_t k = 0; k < contacts.kept_before.size(); ++k) {
    const Link<D>& was = before.links[contacts.kept_before[k]];
    const Link<D>& is = after.links[contacts.kept_after[k]];
    const std::int32_t i = grains.of_before[idx(was.i)], j = grains.of_before[idx(was.j)];
    const double sign = grains.of_after[idx(is.i)] == i ? 1 : -1;
    kept.push_back({i, j, ends(before, was).branch, sign * ends(after, is).branch});
  }
  return kept;
}

// Root mean square distance of the grains from the best rigid motion (Kabsch 1976), along a spanning tree of the links.
template <int D>
double misfit(const std::vector<KeptLink<D>>& links, const std::vector<std::size_t>& of_region) {
  std::vector<std::pair<std::int32_t, std::size_t>> at;  // grain, link
  for (const std::size_t l : of_region) at.push_back({links[l].first, l}), at.push_back({links[l].second, l});
  std::sort(at.begin(), at.end());
  std::vector<std::int32_t> grains;
  for (const auto& [g, l] : at)
    if (grains.empty() || grains.back() != g) grains.push_back(g);
  const auto place = [&](std::int32_t g) { return std::lower_bound(grains.begin(), grains.end(), g) - grains.begin(); };
  using Points = Eigen::Matrix<double, D, Eigen::Dynamic>;
  const auto n = static_cast<Eigen::Index>(grains.size());
  Points x = Points::Zero(D, n), y = Points::Zero(D, n);
  std::vector<bool> seen(grains.size());
  std::queue<std::int32_t> next;
  next.push(grains[0]), seen[0] = true;
  while (!next.empty()) {
    const std::int32_t g = next.front();
    next.pop();
    for (auto it = std::lower_bound(at.begin(), at.end(), std::pair<std::int32_t, std::size_t>{g, 0});
         it != at.end() && it->first == g; ++it) {
      const KeptLink<D>& l = links[it->second];
      const std::int32_t other = l.first == g ? l.second : l.first;
      const double sign = l.first == g ? 1 : -1;
      const auto to = place(other);
      if (seen[static_cast<std::size_t>(to)]) continue;
      seen[static_cast<std::size_t>(to)] = true;
      for (int k = 0; k < D; ++k) {
        x(k, to) = x(k, place(g)) + sign * l.before[k];
        y(k, to) = y(k, place(g)) + sign * l.after[k];
      }
      next.push(other);
    }
  }
  const Eigen::Matrix<double, D, 1> mean_x = x.rowwise().mean(), mean_y = y.rowwise().mean();
  x.colwise() -= mean_x, y.colwise() -= mean_y;
  using Square = Eigen::Matrix<double, D, D>;
  const Square covariance = y * x.transpose();
  const Eigen::JacobiSVD<Square> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Square proper = Square::Identity();
  proper(D - 1, D - 1) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Square rotation = svd.matrixU() * proper * svd.matrixV().transpose();
  return std::sqrt((y - rotation * x).squaredNorm() / static_cast<double>(n));
}

}  // namespace

std::size_t RigidRegions::grains_in_regions() const {
  return static_cast<std::size_t>(std::count_if(of_grain.begin(), of_grain.end(), [](auto r) { return r >= 0; }));
}

double RigidRegions::mean_size_weighted() const {
  double sum = 0;
  for (const std::int32_t r : of_grain)
    if (r >= 0) sum += static_cast<double>(regions[idx(r)].grains.size());
  return sum / static_cast<double>(grains_in_regions());
}

template <int D>
RigidRegions rigid_regions(const Packing<D>& before, const Packing<D>& after, const Matching& grains,
                           const LinkChanges& contacts, double tolerance) {
  const std::vector<KeptLink<D>> links = kept_links(before, after, grains, contacts);
  std::vector<std::vector<std::size_t>> at(grains.size());
  for (std::size_t l = 0; l < links.size(); ++l)
    if (std::abs(norm(links[l].after) - norm(links[l].before)) <= tolerance * norm(links[l].before)) {
      at[idx(links[l].first)].push_back(l);
      at[idx(links[l].second)].push_back(l);
    }
  UnionFind joined(links.size());
  for (std::size_t g = 0; g < at.size(); ++g)
    for (const std::size_t a : at[g])
      for (const std::size_t b : at[g])
        if (a < b && bending(links[a], links[b], static_cast<std::int32_t>(g)) <= tolerance) joined.join(a, b);

  struct Found {
    RigidRegion region;
    std::vector<std::size_t> links;
  };
  std::vector<Found> found;
  for (const std::vector<std::size_t>& set : joined.sets()) {
    RigidRegion region;
    for (const std::size_t l : set) region.grains.insert(region.grains.end(), {links[l].first, links[l].second});
    std::sort(region.grains.begin(), region.grains.end());
    region.grains.erase(std::unique(region.grains.begin(), region.grains.end()), region.grains.end());
    if (region.grains.size() < 3) continue;
    region.misfit = misfit(links, set);
    found.push_back({std::move(region), set});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.region.grains.size() > b.region.grains.size(); });
  RigidRegions all;
  all.of_grain.assign(grains.size(), -1);
  all.of_kept_link.assign(links.size(), -1);
  for (Found& one : found) {
    const auto number = static_cast<std::int32_t>(all.regions.size());
    for (const std::int32_t g : one.region.grains)
      if (all.of_grain[idx(g)] < 0) all.of_grain[idx(g)] = number;
    for (const std::size_t l : one.links) all.of_kept_link[l] = number;
    all.regions.push_back(std::move(one.region));
  }
  return all;
}

template RigidRegions rigid_regions(const Packing<2>&, const Packing<2>&, const Matching&, const LinkChanges&, double);
template RigidRegions rigid_regions(const Packing<3>&, const Packing<3>&, const Matching&, const LinkChanges&, double);

}  // namespace isostat
