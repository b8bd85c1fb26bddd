#include "tests/support/triangle_states.hpp"

#include <cmath>

#include "dem/state/beam.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/grain_template.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

std::int32_t add_grain(TrianglePacking& p, const std::string& shape, double size, const Vec2& place, double angle,
                       GrainPart part) {
  const GrainTemplate grain = grain_template(grain_shape(shape, size), {});
  const auto first = static_cast<std::int32_t>(p.bodies.size()), g = static_cast<std::int32_t>(p.grains.size());
  const double c = std::cos(angle), s = std::sin(angle);
  for (const GrainTriangle& t : grain.triangles) {
    Bodies<2>& b = p.bodies;
    double radius = 0;
    for (const Vec2& q : t.corner) radius = std::max(radius, norm(q));
    b.id.push_back(static_cast<std::int64_t>(b.id.size()));
    b.position.push_back(place + Vec2{{c * t.centroid[0] - s * t.centroid[1], s * t.centroid[0] + c * t.centroid[1]}});
    b.velocity.emplace_back(), b.spin.push_back(0), b.radius.push_back(radius);
    b.mass.push_back(t.mass), b.inertia.push_back(t.inertia);
    p.corner.push_back(t.corner), p.angle.push_back(angle);
  }
  for (const GrainBeam& beam : grain.beams) {
    Link<2> link;
    link.i = first + beam.i, link.j = first + beam.j, link.kind = LinkKind::beam;
    link.beam = static_cast<std::int32_t>(p.beams.size());
    p.links.push_back(link), p.beams.push_back(beam.beam);
  }
  if (p.grains.begin.empty()) p.grains.begin.push_back(0);
  p.grains.begin.push_back(static_cast<std::int32_t>(p.bodies.size()));
  p.grains.id.push_back(g), p.grains.part.push_back(part), p.grains.radius.push_back(grain.radius);
  return g;
}

void add_overlap(TrianglePacking& packing, std::int32_t grain_i, std::int32_t grain_j, const Vec2& point,
                 const Vec2& force_on_j) {
  Overlap o;
  o.grain_i = grain_i, o.grain_j = grain_j, o.point = point, o.area = 1e-5;
  o.normal_force = norm(force_on_j), o.normal = (1 / o.normal_force) * force_on_j;
  packing.overlaps.push_back(o);
}

namespace {

constexpr double kSize = 0.2;  // [cm]

void move(TrianglePacking& p, std::int32_t grain, const Vec2& velocity, double spin, const Vec2& centre) {
  for (auto k = idx(p.grains.begin[idx(grain)]); k < idx(p.grains.begin[idx(grain) + 1]); ++k) {
    const Vec2 r = p.bodies.position[k] - centre;
    p.bodies.velocity[k] = velocity + Vec2{{-spin * r[1], spin * r[0]}};
    p.bodies.spin[k] = spin;
  }
}

void load_beams(TrianglePacking& p, std::int32_t grain, double force) {
  const std::int32_t low = p.grains.begin[idx(grain)], high = p.grains.begin[idx(grain) + 1];
  for (Link<2>& link : p.links)
    if (link.i >= low && link.i < high) link.normal_force = link.i == low ? -force / 2 : force;
}

}  // namespace

State<TriangleGrains> small_bed() {
  State<TriangleGrains> state;
  state.time = 0.25, state.time_step = 1e-5;
  state.scene.system = SceneSystem::triangles;
  state.law.modulus = 2e7, state.law.tangential_stiffness = 1e5, state.law.damping = 9;
  TrianglePacking& p = state.packing;
  std::vector<std::int32_t> floor;
  for (int n = 0; n < 7; ++n)
    floor.push_back(
        add_grain(p, "square", kSize, {{kSize * (n - 3), -kSize / 2}}, 0, n == 3 ? GrainPart::lid : GrainPart::wall));
  std::array<std::array<std::int32_t, 3>, 3> square{};
  for (int row = 0; row < 3; ++row)
    for (int n = 0; n < 3; ++n) {
      const double x = 0.42 * (n - 1) + 0.05 * row, y = kSize * (0.49 + 0.98 * row);
      square[idx(row)][idx(n)] = add_grain(p, "square", kSize, {{x, y}}, row == 2 ? 0.03 * n : 0);
      const double force = 30 * (3 - row) - 8 * n;
      add_overlap(p, row == 0 ? floor[idx(2 * n + (n > 0))] : square[idx(row - 1)][idx(n)], square[idx(row)][idx(n)],
                  {{x - 0.02, y - kSize / 2}}, {{-0.1 * force, force}});
      if (row == 0) load_beams(p, square[0][idx(n)], 40);
    }
  const Vec2 high{{-0.35, 0.75}};
  move(p, add_grain(p, "rod", 0.3, high, 0.7), {{3, -12}}, 8, high);
  const auto broken = static_cast<std::size_t>(p.links.size());
  add_grain(p, "L", 0.24, {{0.05, 0.72}}, -0.4);
  p.links.erase(p.links.begin() + static_cast<std::ptrdiff_t>(broken));
  p.beams.erase(p.beams.begin() + static_cast<std::ptrdiff_t>(broken));
  for (std::size_t l = broken; l < p.links.size(); ++l) --p.links[l].beam;
  const Vec2 star{{0.42, 0.78}};
  move(p, add_grain(p, "star", 0.26, star, 0.2), {{-2, -9}}, -15, star);
  // a smooth wall: a long narrow rectangle of two triangles, the rod's shape would be of eight
  for (const double side : {-1.0, 1.0}) {
    const auto first = static_cast<std::int32_t>(p.bodies.size());
    const double x = side * 0.85, w = 0.15, h = 3;
    for (const auto& corners : {std::array<Vec2, 3>{{{{x - w, -h}}, {{x + w, -h}}, {{x + w, h}}}},
                                {{{{x - w, -h}}, {{x + w, h}}, {{x - w, h}}}}}) {
      const Vec2 mean = (1.0 / 3) * (corners[0] + corners[1] + corners[2]);
      p.corner.push_back({corners[0] - mean, corners[1] - mean, corners[2] - mean});
      p.bodies.id.push_back(static_cast<std::int64_t>(p.bodies.id.size()));
      p.bodies.position.push_back(mean), p.bodies.velocity.emplace_back(), p.bodies.spin.push_back(0);
      p.bodies.radius.push_back(h), p.bodies.mass.push_back(1), p.bodies.inertia.push_back(1), p.angle.push_back(0);
    }
    Link<2> link;
    link.i = first, link.j = first + 1, link.kind = LinkKind::beam;
    link.beam = static_cast<std::int32_t>(p.beams.size());
    p.links.push_back(link), p.beams.push_back(beam_at_rest(1));
    p.grains.begin.push_back(first + 2), p.grains.id.push_back(static_cast<std::int64_t>(p.grains.id.size()));
    p.grains.part.push_back(GrainPart::wall), p.grains.radius.push_back(2 * h);
  }
  return state;
}

}  // namespace isostat
