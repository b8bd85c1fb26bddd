#include "analysis/figure/sphere_pen.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dem/spheres/wall_foot.hpp"
#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

constexpr double kFog = 0.62;  // part of white in the farthest sphere

}  // namespace

SpherePen::SpherePen(const SpherePacking& packing, const PictureFrame& frame, const SphereView& seen)
    : FramePen(frame), packing_(packing), seen_(seen) {
  const Vec3 middle = middle_of(packing);
  for (std::size_t k = 0; k < packing.bodies.size(); ++k) {
    const Vec3& r = packing.bodies.position[k];
    place_.push_back((packing.cell ? packing.cell->wrap(r) : r) - middle);
    largest_diameter_ = std::max(largest_diameter_, 2 * packing.bodies.radius[k]);
  }
}

int SpherePen::level(const Vec3& place) const {
  const auto& [far, near] = seen_.range;
  if (!(near > far)) return kLevels - 1;
  const double t = (view().depth(place) - far) / (near - far);
  return std::clamp(static_cast<int>(std::floor(t * kLevels)), 0, kLevels - 1);
}

Color SpherePen::faded(const Color& color, int level, double most_white) {
  return blend(color, kWhite, most_white * (kLevels - 1 - level) / (kLevels - 1));
}

std::vector<std::vector<std::size_t>> SpherePen::layers() const {
  std::vector<std::size_t> order(place_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t k) { return std::pair(view().depth(place_[k]), packing_.bodies.id[k]); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<std::vector<std::size_t>> layers(kLevels);
  for (const std::size_t k : order) layers[idx(level(place_[k]))].push_back(k);
  return layers;
}

void SpherePen::balls(Canvas& canvas, std::span<const std::size_t> bodies, const std::vector<std::size_t>& style,
                      const std::vector<Color>& colors) const {
  std::vector<DiskMark> run;
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const std::size_t k = bodies[n];
    const int own = level(place_[k]);
    run.push_back({page(place_[k]), points(packing_.bodies.radius[k])});
    if (n + 1 < bodies.size() && style[bodies[n + 1]] == style[k] && level(place_[bodies[n + 1]]) == own) continue;
    canvas.balls(run, faded(colors[style[k]], own, kFog));
    run.clear();
  }
}

std::vector<std::pair<Vec3, Vec3>> SpherePen::pieces(const Link<3>& link) const {
  const LinkEnds<3> e = ends(packing_, link);
  const Vec3 &from = place_[idx(link.i)], &to = place_[idx(link.j)];
  bool inside = true;  // wrapping i and j apart may differ from the branch by whole cells, or by rounding alone
  for (int k = 0; packing_.cell && k < 3; ++k)
    inside = inside && std::abs(from[k] + e.branch[k] - to[k]) < 0.5 * packing_.cell->length[k];
  if (inside) return {{from, to}};
  const double part = e.radius_i / (e.radius_i + e.radius_j);
  return {{from, from + part * e.branch}, {to, to - (1 - part) * e.branch}};
}

std::pair<Vec3, Vec3> SpherePen::piece(const WallLink& link) const {
  const Vec3 middle = middle_of(packing_), from = place_[idx(link.body)];
  return {from, foot_on(packing_.walls[idx(link.wall)], from + middle) - middle};
}

}  // namespace isostat
