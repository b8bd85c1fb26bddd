#include "dem/triangles/touching_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "geometry/base/index.hpp"
#include "geometry/union_find.hpp"

namespace isostat {
namespace {

struct Box {
  Vec2 low, high;
  bool meets(const Box& o) const {
    return low[0] <= o.high[0] && o.low[0] <= high[0] && low[1] <= o.high[1] && o.low[1] <= high[1];
  }
  Box moved(const Vec2& by) const { return {low + by, high + by}; }
};

Box box_of(const Triangle& t) {
  Box b{t.corner[0], t.corner[0]};
  for (const Vec2& c : t.corner)
    for (int k = 0; k < 2; ++k) b.low[k] = std::min(b.low[k], c[k]), b.high[k] = std::max(b.high[k], c[k]);
  return b;
}

// Boxes filed under every square of a grid that they meet: a wall of two long triangles costs as many entries as
// squares, and no pair of small ones is looked at for its sake.
class BoxGrid {
 public:
  explicit BoxGrid(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
    if (boxes_.empty()) return;
    region_ = boxes_[0];
    double extent = 0;
    for (const Box& b : boxes_)
      for (int k = 0; k < 2; ++k) {
        region_.low[k] = std::min(region_.low[k], b.low[k]), region_.high[k] = std::max(region_.high[k], b.high[k]);
        extent += b.high[k] - b.low[k];
      }
    const auto n = static_cast<double>(boxes_.size());
    const Vec2 size = region_.high - region_.low;
    // Not below the mean extent of a box, and not more squares than four a box.
    edge_ = std::max({extent / (2 * n), std::sqrt(size[0] * size[1] / (4 * n)), size[0] / (4 * n), size[1] / (4 * n)});
    for (int k = 0; k < 2; ++k) count_[idx(k)] = edge_ > 0 ? static_cast<int>(size[k] / edge_) + 1 : 1;
    start_.assign(idx(count_[0]) * idx(count_[1]) + 1, 0);
    for (const Box& b : boxes_) each_square(b, [&](std::size_t s) { ++start_[s + 1]; });
    for (std::size_t s = 1; s < start_.size(); ++s) start_[s] += start_[s - 1];
    entry_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t b = 0; b < boxes_.size(); ++b)
      each_square(boxes_[b], [&](std::size_t s) { entry_[next[s]++] = static_cast<std::int32_t>(b); });
  }

  // Every box that meets this one, some more than once.
  template <class F>
  void each_meeting(const Box& box, F&& f) const {
    each_square(box, [&](std::size_t s) {
      for (std::size_t e = start_[s]; e < start_[s + 1]; ++e)
        if (boxes_[idx(entry_[e])].meets(box)) f(idx(entry_[e]));
    });
  }

 private:
  template <class F>
  void each_square(const Box& b, F&& f) const {
    std::array<int, 2> from{}, to{};
    for (int k = 0; k < 2; ++k) {
      const auto square = [&](double x) {
        const double at = edge_ > 0 ? (x - region_.low[k]) / edge_ : 0;
        return static_cast<int>(std::clamp(std::floor(at), 0.0, static_cast<double>(count_[idx(k)] - 1)));
      };
      from[idx(k)] = square(b.low[k]), to[idx(k)] = square(b.high[k]);
    }
    for (int y = from[1]; y <= to[1]; ++y)
      for (int x = from[0]; x <= to[0]; ++x) f(idx(y) * idx(count_[0]) + idx(x));
  }

  std::vector<Box> boxes_;
  Box region_{};
  double edge_ = 0;
  std::array<int, 2> count_{1, 1};
  std::vector<std::size_t> start_;
  std::vector<std::int32_t> entry_;
};

// A box and which image of its triangle it is, against where the triangle stands.
struct Copy {
  std::int32_t triangle;
  ImageShift<2> shift;
};

// Boxes with room for the rounding of an image, the triangles brought into the cell first, then the images of them that
// come near it: with `home` the first `triangles` of the copies.
void make_copies(const TrianglePacking& p, std::span<const Triangle> triangles, std::vector<Copy>& copies,
                 std::vector<Box>& boxes) {
  Box all{};
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Box b = box_of(triangles[t]);
    ImageShift<2> home{};
    if (p.cell)
      for (int k = 0; k < 2; ++k) home[idx(k)] = -static_cast<int>(std::floor(b.low[k] / p.cell->length[k]));
    if (p.cell) b = b.moved(p.cell->offset(home));
    for (int k = 0; k < 2; ++k) {
      const double room = 1e-12 * (std::abs(triangles[t].corner[0][k]) + std::abs(b.low[k]) + std::abs(b.high[k]));
      b.low[k] -= room, b.high[k] += room;
      all.low[k] = t == 0 ? b.low[k] : std::min(all.low[k], b.low[k]);
      all.high[k] = t == 0 ? b.high[k] : std::max(all.high[k], b.high[k]);
    }
    copies.push_back({static_cast<std::int32_t>(t), home});
    boxes.push_back(b);
  }
  if (!p.cell) return;
  const std::size_t homes = copies.size();
  std::array<int, 2> reach{};
  for (int k = 0; k < 2; ++k)
    reach[idx(k)] = static_cast<int>(std::ceil((all.high[k] - all.low[k]) / p.cell->length[k]));
  for (std::size_t h = 0; h < homes; ++h)
    for (int y = -reach[1]; y <= reach[1]; ++y)
      for (int x = -reach[0]; x <= reach[0]; ++x) {
        if (x == 0 && y == 0) continue;
        const Box b = boxes[h].moved(p.cell->offset({x, y}));
        if (!b.meets(all)) continue;
        copies.push_back({copies[h].triangle, {copies[h].shift[0] + x, copies[h].shift[1] + y}});
        boxes.push_back(b);
      }
}

}  // namespace

std::vector<Triangle> placed_triangles(const TrianglePacking& packing) {
  std::vector<Triangle> all(packing.bodies.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = {corners_of(packing, k)};
  return all;
}

Triangle image_of(const Triangle& t, const std::optional<PeriodicCell<2>>& cell, const ImageShift<2>& shift) {
  if (shift == ImageShift<2>{} || !cell) return t;
  Triangle image = t;
  for (Vec2& c : image.corner) c += cell->offset(shift);
  return image;
}

std::vector<TriangleTouch> touching_triangles(const TrianglePacking& p, std::span<const Triangle> triangles) {
  const std::vector<std::int32_t> grain = grain_of(p.grains);
  std::vector<Copy> copies;
  std::vector<Box> boxes;
  make_copies(p, triangles, copies, boxes);
  const BoxGrid grid(boxes);
  const auto order = [&](const TriangleTouch& t) {
    return std::tuple(grain[idx(t.i)], grain[idx(t.j)], t.shift, t.i, t.j);
  };
  std::vector<TriangleTouch> found;
  for (std::size_t h = 0; h < triangles.size(); ++h)
    grid.each_meeting(boxes[h], [&](std::size_t c) {
      TriangleTouch t{copies[h].triangle,
                      copies[c].triangle,
                      {copies[c].shift[0] - copies[h].shift[0], copies[c].shift[1] - copies[h].shift[1]}};
      const std::int32_t a = grain[idx(t.i)], b = grain[idx(t.j)];
      if (a > b) return;  // met from the other side
      const ImageShift<2> back{-t.shift[0], -t.shift[1]};
      if (a == b && t.shift <= back) return;  // inside the grain, or met from the other side
      if (p.grains.part[idx(a)] != GrainPart::free && p.grains.part[idx(b)] != GrainPart::free) return;
      found.push_back(t);
    });
  std::sort(found.begin(), found.end(), [&](const auto& x, const auto& y) { return order(x) < order(y); });
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::erase_if(found, [&](const TriangleTouch& t) {
    const OverlapType type = overlap_type(triangles[idx(t.i)], image_of(triangles[idx(t.j)], p.cell, t.shift));
    return type == OverlapType::separate || type == OverlapType::touch;
  });
  return found;
}

bool share_an_edge(const Triangle& a, const Triangle& b) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Triangle* t : {&a, &b})
    for (std::size_t k = 0; k < 3; ++k) shortest = std::min(shortest, norm(t->corner[(k + 1) % 3] - t->corner[k]));
  const auto near = [&](const Vec2& p, const Vec2& q) { return norm(p - q) < shortest / 2; };
  for (std::size_t e = 0; e < 3; ++e)
    for (std::size_t f = 0; f < 3; ++f)
      if (near(a.corner[e], b.corner[(f + 1) % 3]) && near(a.corner[(e + 1) % 3], b.corner[f])) return true;
  return false;
}

ConnectedOverlaps connected_overlaps(const TrianglePacking& p, std::span<const Triangle> triangles) {
  const std::vector<std::int32_t> grain = grain_of(p.grains);
  const std::vector<TriangleTouch> touch = touching_triangles(p, triangles);
  std::set<std::pair<std::int32_t, std::int32_t>> beamed;
  for (const Link<2>& l : p.links)
    if (l.shift == ImageShift<2>{}) beamed.insert(std::minmax(l.i, l.j));
  const auto neighbours = [&](std::int32_t a, std::int32_t b) {
    return a == b || beamed.contains(std::minmax(a, b)) || share_an_edge(triangles[idx(a)], triangles[idx(b)]);
  };

  ConnectedOverlaps result;
  for (std::size_t first = 0, last; first < touch.size(); first = last) {
    const auto same_grains = [&](const TriangleTouch& t) {
      return grain[idx(t.i)] == grain[idx(touch[first].i)] && grain[idx(t.j)] == grain[idx(touch[first].j)] &&
             t.shift == touch[first].shift;
    };
    for (last = first + 1; last < touch.size() && same_grains(touch[last]);) ++last;
    UnionFind joined(last - first);
    for (std::size_t k = first; k < last; ++k)
      for (std::size_t m = first; m < k; ++m)
        if (neighbours(touch[k].i, touch[m].i) && neighbours(touch[k].j, touch[m].j)) joined.join(k - first, m - first);
    for (const auto& set : joined.sets()) {
      const std::size_t begin = result.touch.size();
      for (const std::size_t k : set) result.touch.push_back(touch[first + k]);
      result.overlap.push_back(
          {grain[idx(touch[first].i)], grain[idx(touch[first].j)], touch[first].shift, begin, result.touch.size()});
    }
  }
  return result;
}

}  // namespace isostat
