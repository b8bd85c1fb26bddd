#include "dem/triangles/container.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/state/container_region.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/time_step.hpp"

namespace isostat {
namespace {

constexpr double kHalfPlane = 20;  // [area of the largest grain] at least, of a smooth wall
constexpr int kFewestFacets = 48;  // of a smooth drum
constexpr double kFitted = 1e-9;   // relative: a length that is a whole number of squares to rounding is one

// From a to b, with the room on the left. It is continued beyond an end where another wall joins it, so that grains
// find no gap there.
struct Wall {
  Vec2 a, b;
  bool joined_a = true, joined_b = true;
  GrainPart part = GrainPart::wall;
};

std::vector<Wall> walls_of(const ContainerScene& c) {
  const double x = 0.5 * c.width, top = region_top(c), knee = slope_height(c);
  if (c.shape == ContainerShape::box)
    return {{{{-x, top}}, {{-x, 0}}, false, true}, {{{-x, 0}}, {{x, 0}}}, {{{x, 0}}, {{x, top}}, true, false}};
  const double o = 0.5 * c.opening;
  return {{{{-x, top}}, {{-x, knee}}, false, true},
          {{{-x, knee}}, {{-o, 0}}, true, false},
          {{{-o, 0}}, {{o, 0}}, true, true, GrainPart::lid},
          {{{o, 0}}, {{x, knee}}, false, true},
          {{{x, knee}}, {{x, top}}, true, false}};
}

class Builder {
 public:
  Builder(const ContainerScene& container, const GrainTemplate& largest, const GrainMaterial& material)
      : c_(container), largest_(largest), material_(material) {}

  std::vector<WallGrain> build() {
    const bool rows = c_.walls == ContainerWalls::grains;
    if (c_.shape == ContainerShape::drum)
      ring(rows);
    else if (c_.shape != ContainerShape::none)
      for (const Wall& w : walls_of(c_)) rows ? row(w) : plate(w);
    return std::move(grains_);
  }

 private:
  double thickness(double length) const {
    return std::max(2 * largest_.radius, kHalfPlane * grain_area(largest_) / length);
  }

  // A block of this length and depth, whose middle lies at `middle` of its inner face; the room is to the left of
  // `along`, which is a unit vector.
  void block(const TriangleMesh& mesh, const Vec2& middle, const Vec2& along, double depth, GrainPart part) {
    const Vec2 outwards{{along[1], -along[0]}};
    grains_.push_back(
        {grain_template(mesh, material_), middle + (0.5 * depth) * outwards, std::atan2(along[1], along[0]), part});
  }
  void rectangle(double length, double depth, const Vec2& middle, const Vec2& along, GrainPart part) {
    block({{{{0, 0}}, {{length, 0}}, {{length, depth}}, {{0, depth}}}, {{0, 1, 2}, {0, 2, 3}}}, middle, along, depth,
          part);
  }

  void plate(const Wall& w) {
    const Vec2 way = w.b - w.a, along = (1 / norm(way)) * way;
    const double depth = thickness(norm(way));
    const Vec2 from = w.joined_a ? w.a - depth * along : w.a, to = w.joined_b ? w.b + depth * along : w.b;
    rectangle(norm(to - from), depth, 0.5 * (from + to), along, w.part);
  }

  // Squares of the side next below wall_size that fits. At the edge of an outlet one stands flush.
  void row(const Wall& w) {
    const Vec2 way = w.b - w.a, along = (1 / norm(way)) * way, outwards{{along[1], -along[0]}};
    const int count = std::max(1, static_cast<int>(std::ceil(norm(way) / c_.wall_size * (1 - kFitted))));
    const double side = norm(way) / count;
    const TriangleMesh square = grain_shape("square", side);
    for (int k = w.joined_a ? -1 : 0; k < count + (w.joined_b ? 1 : 0); ++k) {
      const int from_edge = w.joined_b && !w.joined_a ? k : count - 1 - k;
      const double back = from_edge % 2 == 0 ? 0 : 0.5 * side;
      block(square, w.a + ((k + 0.5) * side) * along + back * outwards, along, side, w.part);
    }
  }

  // An even number of facets, so that every other one can be set back. Their middles lie on the circle.
  void ring(bool rows) {
    const double around = 2 * std::numbers::pi * c_.radius, wanted = rows ? c_.wall_size : 2 * largest_.radius;
    const int count = std::max(rows ? 4 : kFewestFacets, 2 * static_cast<int>(std::lround(0.5 * around / wanted)));
    const double sector = 2 * std::numbers::pi / count, side = 2 * c_.radius * std::tan(0.5 * sector);
    const double depth = rows ? side : thickness(side);
    for (int k = 0; k < count; ++k) {
      const Vec2 outwards{{std::cos(k * sector), std::sin(k * sector)}}, along{{-outwards[1], outwards[0]}};
      const double distance = c_.radius + (rows && k % 2 == 1 ? 0.5 * side : 0.0);
      if (rows)
        block(grain_shape("square", side), distance * outwards, along, depth, GrainPart::wall);
      else
        rectangle(1.5 * side, depth, distance * outwards, along, GrainPart::wall);  // no gap at its ends
    }
  }

  const ContainerScene& c_;
  const GrainTemplate& largest_;
  const GrainMaterial& material_;
  std::vector<WallGrain> grains_;
};

}  // namespace

std::vector<WallGrain> wall_grains(const ContainerScene& container, const GrainTemplate& largest,
                                   const GrainMaterial& material) {
  return Builder(container, largest, material).build();
}

}  // namespace isostat
