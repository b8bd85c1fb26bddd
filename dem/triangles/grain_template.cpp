#include "dem/triangles/grain_template.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "dem/input_error.hpp"
#include "dem/scene/text.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

void check(const GrainMaterial& m) {
  std::vector<Fault> faults;
  const auto require = [&](bool good, const char* key, double value, const char* rule) {
    if (!good || !std::isfinite(value)) faults.push_back({"grain", 0, key, real_text(value), rule});
  };
  require(m.density > 0, "density", m.density, "positive");
  require(m.stiffness > 0, "stiffness", m.stiffness, "positive");
  require(m.bending > 0, "bending", m.bending, "positive");
  require(m.damping >= 0, "damping", m.damping, "not negative");
  if (!faults.empty()) throw InputError(std::move(faults));
}

// Uniform density; of a triangle with sides a, b, c about its centroid J = m (a^2 + b^2 + c^2)/36.
GrainTriangle triangle_of(const std::array<Vec2, 3>& p, double density) {
  GrainTriangle t;
  const Vec2 u = p[1] - p[0], v = p[2] - p[0], w = p[2] - p[1];
  const double squares = dot(u, u) + dot(v, v) + dot(w, w), doubled = doubled_area(p[0], p[1], p[2]);
  if (!(doubled > 8 * std::numeric_limits<double>::epsilon() * squares))
    throw InputError("grain", 0, "shape", real_text(doubled / 2), "a triangle of the grain has no area [cm^2]");
  const Vec2 from_first = (1.0 / 3) * (u + v);
  t.centroid = p[0] + from_first;
  t.corner = {Vec2{} - from_first, u - from_first, v - from_first};
  t.mass = density * doubled / 2;
  t.inertia = t.mass * squares / 36;
  return t;
}

}  // namespace

GrainTemplate grain_template(const TriangleMesh& mesh, const GrainMaterial& material) {
  check(material);
  GrainTemplate grain;
  grain.material = material;
  Vec2 moment{};  // [g cm]
  for (const auto& t : mesh.triangles) {
    const auto& points = mesh.points;
    grain.triangles.push_back(triangle_of({points[idx(t[0])], points[idx(t[1])], points[idx(t[2])]}, material.density));
    grain.mass += grain.triangles.back().mass;
    moment += grain.triangles.back().mass * grain.triangles.back().centroid;
  }
  const Vec2 centre = (1 / grain.mass) * moment;
  for (GrainTriangle& t : grain.triangles) {
    t.centroid -= centre;
    grain.inertia += t.inertia + t.mass * dot(t.centroid, t.centroid);  // parallel axes
    for (const Vec2& c : t.corner) grain.radius = std::max(grain.radius, norm(t.centroid + c));
  }
  for (const auto& [i, j] : edge_neighbours(mesh)) {
    const Vec2 chord = grain.triangles[idx(j)].centroid - grain.triangles[idx(i)].centroid;
    const double angle = -std::atan2(chord[1], chord[0]);
    grain.beams.push_back({i, j, {norm(chord), angle, angle, material.stiffness, material.bending}});
  }
  return grain;
}

}  // namespace isostat
