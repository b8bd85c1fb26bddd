#include "dem/triangles/placement.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

// A line along an edge of a has all of b beyond it.
bool parted_by_edge(const TriangleCorners& a, const TriangleCorners& b, double gap) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2& p = a[k];
    const Vec2 edge = a[(k + 1) % 3] - p;
    const double least = gap * norm(edge);
    bool beyond = true;
    for (const Vec2& q : b) beyond = beyond && edge[1] * (q[0] - p[0]) - edge[0] * (q[1] - p[1]) >= least;
    if (beyond) return true;
  }
  return false;
}

Vec2 lower(const TriangleCorners& t) {
  return {{std::min({t[0][0], t[1][0], t[2][0]}), std::min({t[0][1], t[1][1], t[2][1]})}};
}
Vec2 upper(const TriangleCorners& t) {
  return {{std::max({t[0][0], t[1][0], t[2][0]}), std::max({t[0][1], t[1][1], t[2][1]})}};
}

}  // namespace

std::vector<TriangleCorners> placed(const GrainTemplate& grain, const Vec2& centre, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<TriangleCorners> triangles;
  triangles.reserve(grain.triangles.size());
  for (const GrainTriangle& t : grain.triangles) {
    TriangleCorners& at = triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 q = t.centroid + t.corner[k];
      at[k] = {{centre[0] + (c * q[0] - s * q[1]), centre[1] + (s * q[0] + c * q[1])}};
    }
  }
  return triangles;
}

bool apart(const TriangleCorners& a, const TriangleCorners& b, double gap) {
  return parted_by_edge(a, b, gap) || parted_by_edge(b, a, gap);
}

TriangleField::TriangleField(const Frame<2>& box, const std::optional<PeriodicCell<2>>& cell, double width,
                             std::size_t number)
    : cell_(cell), grid_({box.origin, box.length, false}, width, number), members_(grid_.size()) {}

TriangleField::Columns TriangleField::columns(const TriangleCorners& triangle) const {
  return {grid_.columns(lower(triangle)), grid_.columns(upper(triangle))};
}

void TriangleField::add_one(const TriangleCorners& triangle) {
  const auto k = static_cast<std::int32_t>(triangles_.size());
  triangles_.push_back(triangle);
  const Columns at = columns(triangle);
  for (int y = at.low[1]; y <= at.high[1]; ++y)
    for (int x = at.low[0]; x <= at.high[0]; ++x) members_[grid_.index(std::array<int, 2>{x, y})].push_back(k);
}

void TriangleField::add(const TriangleCorners& triangle) {
  if (!cell_) return add_one(triangle);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      TriangleCorners image = triangle;
      for (Vec2& q : image) q += cell_->offset({x, y});
      add_one(image);
    }
}

bool TriangleField::leaves_room(const std::vector<TriangleCorners>& triangles, double gap) const {
  for (const TriangleCorners& t : triangles) {
    const Columns at = columns(t);
    for (int y = at.low[1]; y <= at.high[1]; ++y)
      for (int x = at.low[0]; x <= at.high[0]; ++x)
        for (const std::int32_t k : members_[grid_.index(std::array<int, 2>{x, y})])
          if (!apart(t, triangles_[idx(k)], gap)) return false;
  }
  return true;
}

}  // namespace isostat
