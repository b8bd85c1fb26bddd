#include "dem/sample/free_volume.hpp"

#include <algorithm>
#include <cmath>

namespace isostat {
namespace {

constexpr double kFinestEdge = 1.0 / 3;  // [radius of the next grain] cells are not divided below
constexpr double kMostRoots = 64;        // along an axis of a long box

}  // namespace

template <int D>
FreeVolume<D>::FreeVolume(const Enclosure<D>& enclosure, const GrainIndex<D>& grains, double radius_first,
                          double radius_last)
    : enclosure_(enclosure),
      grains_(grains),
      frame_(enclosure.frame()),
      radius_(radius_first),
      radius_last_(radius_last),
      parked_(radius_first, radius_last) {
  double shortest = frame_.length[0];
  for (int k = 1; k < D; ++k) shortest = std::min(shortest, frame_.length[k]);
  std::array<std::uint32_t, D> roots;
  std::size_t all = 1;
  for (int k = 0; k < D; ++k) {
    auto& n = roots[static_cast<std::size_t>(k)];
    n = static_cast<std::uint32_t>(std::min(std::round(frame_.length[k] / shortest), kMostRoots));
    edge_[0][k] = frame_.length[k] / n;
    all *= n;
  }
  for (std::size_t level = 0; level < kLevels; ++level) {
    if (level > 0) edge_[level] = 0.5 * edge_[level - 1];
    weight_[level] = 1 / enclosure.measure();
    for (int k = 0; k < D; ++k) weight_[level] *= edge_[level][k];
  }
  for (std::size_t i = 0; i < all; ++i) {
    Cell cell{{}, 0};
    std::size_t rest = i;
    for (std::size_t u = 0; u < D; ++u) cell.at[u] = static_cast<std::uint32_t>(rest % roots[u]), rest /= roots[u];
    admit(cell, neighbours(cell));
  }
}

template <int D>
Vec<D> FreeVolume<D>::middle(const Cell& cell) const {
  const Vec<D> e = edge_[cell.level];
  Vec<D> m;
  for (int k = 0; k < D; ++k) m[k] = frame_.origin[k] + (cell.at[static_cast<std::size_t>(k)] + 0.5) * e[k];
  return m;
}

// The radius above which the grain refuses every point of the cell.
template <int D>
double FreeVolume<D>::threshold(const Cell& cell, const Grain& grain) const {
  const Vec<D> e = edge_[cell.level], d = enclosure_.separation(middle(cell), grain.centre);
  Vec<D> farthest;
  for (int k = 0; k < D; ++k) farthest[k] = std::abs(d[k]) + e[k] / 2;
  return norm(farthest) - grain.radius;
}

// The radius above which the shell does.
template <int D>
double FreeVolume<D>::shell_threshold(const Cell& cell) const {
  if (enclosure_.cell) return INFINITY;
  const Vec<D> e = edge_[cell.level], m = middle(cell);
  Vec<D> nearest;
  for (int k = 0; k < D; ++k) nearest[k] = std::max(std::abs(m[k]) - e[k] / 2, 0.0);
  return enclosure_.shell_radius - norm(nearest);
}

// A candidate lies in the enclosure, so that measures of cells are chances of trials.
template <int D>
bool FreeVolume<D>::inside(const Cell& cell) const {
  if (enclosure_.cell) return true;
  const Vec<D> e = edge_[cell.level], m = middle(cell);
  Vec<D> farthest;
  for (int k = 0; k < D; ++k) farthest[k] = std::abs(m[k]) + e[k] / 2;
  return norm(farthest) <= enclosure_.shell_radius;
}

// Grains that may refuse a point of the cell to the grain that comes next.
template <int D>
auto FreeVolume<D>::neighbours(const Cell& cell) const -> std::vector<Grain> {
  std::vector<Grain> near;
  grains_.any_within(middle(cell), radius_ + norm(edge_[cell.level]) / 2, [&](std::size_t g, double) {
    near.push_back(grains_.grains()[g]);
    return false;
  });
  return near;
}

template <int D>
void FreeVolume<D>::admit(const Cell& cell, const std::vector<Grain>& near) {
  double least = shell_threshold(cell);
  for (const Grain& g : near) least = std::min(least, threshold(cell, g));
  if (least < radius_)
    park(cell, least);
  else if (inside(cell))
    open(cell);
  else
    divide(cell, near);
}

template <int D>
void FreeVolume<D>::open(const Cell& cell) {
  active_[cell.level].push_back(cell);
  ++candidates_;
}

template <int D>
void FreeVolume<D>::divide(const Cell& cell, const std::vector<Grain>& near) {
  for (unsigned corner = 0; corner < 1u << D; ++corner) {
    Cell child{{}, cell.level + 1};
    for (std::size_t u = 0; u < D; ++u) child.at[u] = 2 * cell.at[u] + (corner >> u & 1);
    admit(child, near);
  }
}

template <int D>
void FreeVolume<D>::park(const Cell& cell, double at) {
  if (at <= radius_last_) return;  // no grain to come fits
  parked_.push(at, cell);
}

// Whether grains that came meanwhile refuse the cell is found out when a point in it is refused.
template <int D>
void FreeVolume<D>::descend(double radius) {
  radius_ = radius;
  for (Cell cell; parked_.pop(radius, cell);)
    if (shell_threshold(cell) >= radius && inside(cell))
      open(cell);
    else
      admit(cell, neighbours(cell));
}

template <int D>
double FreeVolume<D>::fraction() const {
  double sum = 0;
  for (std::size_t l = 0; l < kLevels; ++l) sum += static_cast<double>(active_[l].size()) * weight_[l];
  return sum;
}

template <int D>
auto FreeVolume<D>::draw(Random& random) const -> Point {
  double rest = random.uniform() * fraction();
  std::size_t level = 0;
  for (; level + 1 < kLevels; ++level) {
    const double here = static_cast<double>(active_[level].size()) * weight_[level];
    if (rest < here) break;
    rest -= here;
  }
  while (active_[level].empty()) --level;  // the sum's rounding led beyond the last
  const std::size_t place = std::min(static_cast<std::size_t>(rest / weight_[level]), active_[level].size() - 1);
  const Cell& cell = active_[level][place];
  const Vec<D> e = edge_[level];
  Point p{{}, level, place};
  for (int k = 0; k < D; ++k)
    p.position[k] = frame_.origin[k] + (cell.at[static_cast<std::size_t>(k)] + random.uniform()) * e[k];
  return p;
}

template <int D>
void FreeVolume<D>::refine(const Point& refused, const Grain* by) {
  std::vector<Cell>& list = active_[refused.level];
  const Cell cell = list[refused.place];
  const double at = by ? threshold(cell, *by) : shell_threshold(cell);
  const Vec<D> e = edge_[refused.level];
  const bool divisible = *std::max_element(e.c.begin(), e.c.end()) > kFinestEdge * radius_ && cell.level + 1 < kLevels;
  if (at >= radius_ && !divisible) return;
  list[refused.place] = list.back();
  list.pop_back();
  --candidates_;
  if (at < radius_)
    park(cell, at);
  else
    divide(cell, neighbours(cell));
}

template class FreeVolume<2>;
template class FreeVolume<3>;

}  // namespace isostat
