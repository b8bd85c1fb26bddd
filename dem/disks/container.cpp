#include "dem/disks/container.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/disks/sample.hpp"
#include "dem/state/container_region.hpp"

namespace isostat {
namespace {

class Row {
 public:
  explicit Row(double diameter) : diameter_(diameter) {}

  // From the last point to the next corner; the corner is one of the disks.
  void to(const Vec2& corner) {
    if (disks_.empty()) return add(corner, GrainPart::wall);
    const Vec2 from = disks_.back().position, way = corner - from;
    const int steps = steps_for(norm(way));
    for (int k = 1; k <= steps; ++k) add(from + (static_cast<double>(k) / steps) * way, GrainPart::wall);
  }
  // Between two disks that stand already.
  void lid(const Vec2& from, const Vec2& end) {
    const int steps = steps_for(norm(end - from));
    for (int k = 1; k < steps; ++k) add(from + (static_cast<double>(k) / steps) * (end - from), GrainPart::lid);
  }
  void circle(double radius) {
    const int steps = steps_for(2 * std::numbers::pi * radius);
    for (int k = 0; k < steps; ++k) {
      const double angle = 2 * std::numbers::pi * k / steps;
      add({{radius * std::cos(angle), radius * std::sin(angle)}}, GrainPart::wall);
    }
  }
  std::vector<WallDisk> take() { return std::move(disks_); }

  void append(std::vector<WallDisk> more) { disks_.insert(disks_.end(), more.begin(), more.end()); }

 private:
  void add(const Vec2& r, GrainPart part) { disks_.push_back({r, part}); }
  int steps_for(double length) const {
    return std::max(1, static_cast<int>(std::ceil(length / diameter_ * (1 - 1e-12))));
  }

  double diameter_;
  std::vector<WallDisk> disks_;
};

std::vector<WallDisk> box(const ContainerScene& c) {
  const double x = 0.5 * (c.width + c.wall_size), y = -0.5 * c.wall_size;
  Row row(c.wall_size);
  for (const Vec2& corner : {Vec2{{-x, c.height}}, Vec2{{-x, y}}, Vec2{{x, y}}, Vec2{{x, c.height}}}) row.to(corner);
  return row.take();
}

std::vector<WallDisk> hopper(const ContainerScene& c) {
  const double radius = 0.5 * c.wall_size, t = c.angle * std::numbers::pi / 180;
  // Centres stand a radius outside the slope; at its ends they are a radius beyond the edge of the outlet, and of the
  // upright wall, so that the room is as wide there as asked.
  const double down = radius * (std::tan(t) * (1 - std::sin(t)) - std::cos(t));
  const Vec2 tip{{0.5 * c.opening + radius, down}};
  const Vec2 knee{{0.5 * c.width + radius, slope_height(c) + down}};
  const Vec2 top{{knee[0], region_top(c)}};
  const auto mirrored = [](const Vec2& r) { return Vec2{{-r[0], r[1]}}; };
  Row left(c.wall_size), right(c.wall_size);
  for (const Vec2& corner : {tip, knee, top}) left.to(mirrored(corner)), right.to(corner);
  left.append(right.take());
  left.lid(mirrored(tip), tip);
  return left.take();
}

std::vector<WallDisk> drum(const ContainerScene& c) {
  Row row(c.wall_size);
  row.circle(c.radius + 0.5 * c.wall_size);
  return row.take();
}

}  // namespace

std::vector<WallDisk> wall_disks(const ContainerScene& c) {
  switch (c.shape) {
    case ContainerShape::box:
      return box(c);
    case ContainerShape::hopper:
      return hopper(c);
    case ContainerShape::drum:
      return drum(c);
    case ContainerShape::none:
      break;
  }
  return {};
}

void add_container(State<Disks>& s) {
  const ContainerScene& c = s.scene.container;
  if (c.walls == ContainerWalls::smooth) return;
  const std::vector<WallDisk> walls = wall_disks(c);
  Bodies<2>& b = s.packing.bodies;
  const std::size_t grains = b.size();
  const std::int64_t first = grains == 0 ? 0 : *std::max_element(b.id.begin(), b.id.end()) + 1;
  b.resize(grains + walls.size());
  s.packing.part.assign(b.size(), GrainPart::free);
  for (std::size_t k = 0; k < walls.size(); ++k) {
    const std::size_t body = grains + k;
    b.id[body] = first + static_cast<std::int64_t>(k);
    b.position[body] = walls[k].position;
    b.radius[body] = 0.5 * c.wall_size;
    s.packing.part[body] = walls[k].part;
  }
  set_disk_inertia(b, grains);
}

}  // namespace isostat
