#include "dem/triangles/container.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/state/container_walls.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/time_step.hpp"

namespace isostat {
namespace {

constexpr double kHalfPlane = 20;  // [area of the largest grain] at least, of a smooth wall
constexpr int kFewestFacets = 48;  // of a smooth drum
constexpr double kFitted = 1e-9;   // relative: a length that is a whole number of squares to rounding is one

class Builder {
 public:
  Builder(const ContainerScene& container, const GrainTemplate& largest, const GrainMaterial& material)
      : c_(container), largest_(largest), material_(material) {}

  std::vector<WallGrain> build() {
    const bool rows = c_.walls == ContainerWalls::grains;
    if (c_.shape == ContainerShape::drum)
      ring(rows);
    else if (c_.shape != ContainerShape::none)
      for (const FlatWall& w : flat_walls(c_)) rows ? row(w) : plate(w);
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

  void plate(const FlatWall& w) {
    const Vec2 way = w.b - w.a, along = (1 / norm(way)) * way;
    const double depth = thickness(norm(way));
    const Vec2 from = w.joined_a ? w.a - depth * along : w.a, to = w.joined_b ? w.b + depth * along : w.b;
    rectangle(norm(to - from), depth, 0.5 * (from + to), along, w.part);
  }

  // Squares of the side next below wall_size that fits. At the edge of an outlet one stands flush.
  void row(const FlatWall& w) {
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
    // A square set back reaches to the outer corners of its neighbours, so that no gap opens between their sides.
    const double behind = 2 * (c_.radius + side) * std::sin(sector) - side * std::cos(sector);
    const double depth = thickness(side);
    for (int k = 0; k < count; ++k) {
      const Vec2 outwards{{std::cos(k * sector), std::sin(k * sector)}}, along{{-outwards[1], outwards[0]}};
      const bool back = k % 2 == 1;
      if (!rows)
        rectangle(1.5 * side, depth, c_.radius * outwards, along, GrainPart::wall);  // no gap at its ends
      else
        block(grain_shape("square", back ? behind : side), (c_.radius + (back ? 0.5 * side : 0.0)) * outwards, along,
              back ? behind : side, GrainPart::wall);
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
