#include "dem/triangles/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "dem/triangles/grain_spectrum.hpp"
#include "dem/triangles/stable_step.hpp"
#include "geometry/base/index.hpp"
#include "geometry/triangle_mesh.hpp"

namespace isostat {
namespace {

// omega dt up to which an oscillation without dampers stays bounded, or grows slowly (Gear).
constexpr double kVerletLimit = 2, kGearLimit = 0.5;

}  // namespace

GrainMaterial material_of(const Scene& scene) {
  const TriangleLawScene& law = scene.triangle_law;
  return {scene.triangle_grains.density, law.stiffness, law.bending, law.damping};
}

std::vector<std::string> shape_names(const std::string& list) {
  constexpr const char* space = " \t";
  std::vector<std::string> names;
  for (std::size_t from = 0; from <= list.size();) {
    const std::size_t to = std::min(list.find(',', from), list.size());
    const std::string one = list.substr(from, to - from);
    const std::size_t first = one.find_first_not_of(space), last = one.find_last_not_of(space);
    names.push_back(first == std::string::npos ? "" : one.substr(first, last - first + 1));
    from = to + 1;
  }
  return names;
}

double grain_area(const GrainTemplate& grain) {
  double doubled = 0;
  for (const GrainTriangle& t : grain.triangles) doubled += doubled_area(t.corner[0], t.corner[1], t.corner[2]);
  return doubled / 2;
}

double contact_frequency(const GrainTemplate& grain, double modulus) {
  const double length = std::sqrt(grain_area(grain));
  double squared = 0;
  for (const GrainTriangle& t : grain.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 edge = t.corner[(k + 1) % 3] - t.corner[k], middle = 0.5 * (t.corner[k] + t.corner[(k + 1) % 3]);
      const double side = dot(edge, edge), along = dot(middle, edge);  // squared; arm times side
      const double stiffness = modulus * side / length;
      squared = std::max(squared, 2 * stiffness * (1 / t.mass + along * along / (side * t.inertia)));
    }
  return std::sqrt(squared);
}

double step_frequency(const GrainTemplate& grain, double modulus) {
  return grain.beams.empty() ? contact_frequency(grain, modulus) : grain_frequencies(grain).back();
}

double largest_step(const GrainTemplate& grain, double modulus, Integrator integrator) {
  const double limit = integrator == Integrator::gear ? kGearLimit : kVerletLimit;
  return std::min(stable_step_estimate(grain, integrator), limit / contact_frequency(grain, modulus));
}

GrainTemplate template_of(const TrianglePacking& packing, std::size_t g, const GrainMaterial& material) {
  GrainTemplate grain;
  grain.material = material;
  const std::int32_t begin = packing.grains.begin[g], end = packing.grains.begin[g + 1];
  Vec2 moment{};
  for (std::int32_t k = begin; k < end; ++k) {
    const auto& b = packing.bodies;
    grain.triangles.push_back({packing.corner[idx(k)], b.position[idx(k)], b.mass[idx(k)], b.inertia[idx(k)]});
    const double c = std::cos(packing.angle[idx(k)]), s = std::sin(packing.angle[idx(k)]);
    for (Vec2& q : grain.triangles.back().corner) q = {{c * q[0] - s * q[1], s * q[0] + c * q[1]}};
    grain.mass += b.mass[idx(k)];
    moment += b.mass[idx(k)] * b.position[idx(k)];
  }
  const Vec2 centre = (1 / grain.mass) * moment;
  for (GrainTriangle& t : grain.triangles) {
    t.centroid -= centre;
    grain.inertia += t.inertia + t.mass * dot(t.centroid, t.centroid);
    for (const Vec2& c : t.corner) grain.radius = std::max(grain.radius, norm(t.centroid + c));
  }
  for (const Link<2>& l : packing.links)
    if (l.kind == LinkKind::beam && l.i >= begin && l.i < end)
      grain.beams.push_back({l.i - begin, l.j - begin, packing.beams[idx(l.beam)]});
  return grain;
}

std::vector<GrainTemplate> smallest_grains(const TrianglePacking& packing, const GrainMaterial& material) {
  const std::vector<std::int32_t> of = grain_of(packing.grains);
  std::vector<std::vector<std::int32_t>> pattern(packing.grains.size());
  for (std::size_t g = 0; g < packing.grains.size(); ++g)
    pattern[g].push_back(packing.grains.begin[g + 1] - packing.grains.begin[g]);
  for (const Link<2>& l : packing.links) {
    const std::size_t g = idx(of[idx(l.i)]);
    pattern[g].push_back(l.i - packing.grains.begin[g]), pattern[g].push_back(l.j - packing.grains.begin[g]);
  }
  std::map<std::vector<std::int32_t>, std::pair<double, std::size_t>> lightest;  // mass, grain
  for (std::size_t g = 0; g < packing.grains.size(); ++g) {
    if (packing.grains.part[g] != GrainPart::free) continue;
    double mass = 0;
    for (std::int32_t k = packing.grains.begin[g]; k < packing.grains.begin[g + 1]; ++k)
      mass += packing.bodies.mass[idx(k)];
    const auto [at, fresh] = lightest.try_emplace(pattern[g], mass, g);
    if (!fresh && mass < at->second.first) at->second = {mass, g};
  }
  std::vector<GrainTemplate> grains;
  for (const auto& [shape, found] : lightest) grains.push_back(template_of(packing, found.second, material));
  return grains;
}

double triangle_time_step(const Scene& scene, const TrianglePacking& packing) {
  double fastest = 0;
  for (const GrainTemplate& grain : smallest_grains(packing, material_of(scene)))
    fastest = std::max(fastest, step_frequency(grain, scene.triangle_law.modulus));
  return triangle_step_fraction(scene) / fastest;
}

}  // namespace isostat
