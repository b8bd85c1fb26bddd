#include "analysis/network/triangle_sections.hpp"
#include "analysis/network/principal.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "dem/triangles/certificate.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();  // written as null

bool is_free(const TrianglePacking& p, std::int32_t grain) { return p.grains.part[idx(grain)] == GrainPart::free; }

// Overlaps of each grain; an own image counts at both ends.
std::vector<int> degrees(const AnalysisInput& input) {
  std::vector<int> degree(input.triangles->packing.grains.size(), 0);
  for (const AreaLink& a : input.triangle_links.areas) ++degree[idx(a.grain_i)], ++degree[idx(a.grain_j)];
  return degree;
}

// Proportions of the grains with k = 0, 1, ... overlaps, rattlers left out; at least up to k = 6.
std::vector<double> proportions(const TrianglePacking& p, const std::vector<int>& degree) {
  std::vector<double> x(7, 0.0);
  for (std::size_t g = 0; g < degree.size(); ++g) {
    if (p.grains.part[g] != GrainPart::free || degree[g] == 0) continue;
    if (idx(degree[g]) >= x.size()) x.resize(idx(degree[g]) + 1, 0.0);
    x[idx(degree[g])] += 1;
  }
  const double rest = std::accumulate(x.begin(), x.end(), 0.0);
  for (double& v : x) v = rest > 0 ? v / rest : kUndefined;
  return x;
}

}  // namespace

// A grain can lie at rest on one overlap (an edge on an edge), so that only grains without any are rattlers.
Json triangle_counts(const AnalysisInput& input) {
  const TrianglePacking& p = input.triangles->packing;
  const std::vector<int> degree = degrees(input);
  std::int64_t grains = 0, triangles = 0, rattlers = 0, with_wall = 0;
  for (std::int32_t g = 0; g < static_cast<std::int32_t>(p.grains.size()); ++g) {
    if (!is_free(p, g)) continue;
    ++grains, rattlers += degree[idx(g)] == 0;
    triangles += p.grains.begin[idx(g) + 1] - p.grains.begin[idx(g)];
  }
  std::int64_t pairs = 0;
  for (const AreaLink& a : input.triangle_links.areas) {
    with_wall += !is_free(p, a.grain_i) || !is_free(p, a.grain_j);
    pairs += static_cast<std::int64_t>(a.pairs.size());
  }
  const auto contacts = static_cast<std::int64_t>(input.triangle_links.areas.size());
  const double phi = solid_fraction(p, p.cell);
  Json json;
  json["grains"] = grains;
  json["triangles"] = triangles;
  json["contacts"] = contacts;
  json["contacts_with_walls"] = with_wall;
  json["touching_triangle_pairs"] = pairs;
  json["beams"] = input.triangle_links.packing.beams.size();
  json["rattlers"] = rattlers;
  json["solid_fraction"] = phi;
  json["z"] = grains > 0 ? 2.0 * static_cast<double>(contacts) / static_cast<double>(grains) : kUndefined;
  json["z_star"] =
      grains > rattlers ? 2.0 * static_cast<double>(contacts) / static_cast<double>(grains - rattlers) : kUndefined;
  json["x"] = proportions(p, degree);
  return json;
}

std::vector<Table> triangle_counts_tables(const AnalysisInput& input) {
  const TrianglePacking& p = input.triangles->packing;
  const std::vector<int> degree = degrees(input);
  Table table{"grains", {"id", "x", "y", "triangles", "held", "interactions"}, {}};
  for (std::size_t g = 0; g < p.grains.size(); ++g) {
    const auto begin = idx(p.grains.begin[g]), end = idx(p.grains.begin[g + 1]);
    Vec2 moment{};
    double mass = 0;
    for (std::size_t k = begin; k < end; ++k)
      moment += p.bodies.mass[k] * p.bodies.position[k], mass += p.bodies.mass[k];
    table.rows.push_back({static_cast<double>(p.grains.id[g]), moment[0] / mass, moment[1] / mass,
                          static_cast<double>(end - begin), static_cast<double>(p.grains.part[g] != GrainPart::free),
                          static_cast<double>(degree[g])});
  }
  return {table};
}

Json triangle_stress(const State<TriangleGrains>& state) {
  const StressTensor s = measured_stress(state);
  double sum = 0;
  for (const Overlap& o : state.packing.overlaps) sum += o.normal_force;
  const auto overlaps = static_cast<double>(state.packing.overlaps.size());
  Json json;
  json["tensor"] = {{s.xx, s.xy}, {s.yx, s.yy}};
  add_principal<2>(json, {Vec2{{s.xx, s.xy}}, Vec2{{s.yx, s.yy}}});
  json["pressure"] = 0.5 * (s.xx + s.yy);
  json["mean_normal_force"] = overlaps > 0 ? sum / overlaps : kUndefined;
  return json;
}

}  // namespace isostat
