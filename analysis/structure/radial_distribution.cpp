#include "analysis/structure/radial_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "analysis/structure/sections.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

// Grains by cell of a grid along the edges whose cells are at least r_max wide, positions in the home cell.
struct Grid {
  std::array<int, 3> count{};
  std::vector<std::size_t> start;
  std::vector<Vec3> position;

  std::size_t cell(int x, int y, int z) const { return idx((z * count[1] + y) * count[0] + x); }
};

Grid grid_of(const Packing<3>& packing, double r_max) {
  constexpr double kMostCells = 100;  // an axis: a long thin cell would have more of them than grains
  Grid grid;
  const Vec3 spacing = packing.cell->spacing();
  for (int k = 0; k < 3; ++k)
    grid.count[idx(k)] = static_cast<int>(std::clamp(std::floor(spacing[k] / r_max), 1.0, kMostCells));
  std::vector<std::size_t> at;
  std::vector<Vec3> wrapped;
  for (const Vec3& r : packing.bodies.position) {
    wrapped.push_back(packing.cell->wrap(r));
    const Vec3 f = packing.cell->fractions(wrapped.back());
    std::array<int, 3> c;
    for (int k = 0; k < 3; ++k)
      c[idx(k)] = std::clamp(static_cast<int>(f[k] * grid.count[idx(k)]), 0, grid.count[idx(k)] - 1);
    at.push_back(grid.cell(c[0], c[1], c[2]));
  }
  grid.start.assign(idx(grid.count[0]) * idx(grid.count[1]) * idx(grid.count[2]) + 1, 0);
  for (const std::size_t c : at) ++grid.start[c + 1];
  std::partial_sum(grid.start.begin(), grid.start.end(), grid.start.begin());
  std::vector<std::size_t> next(grid.start.begin(), grid.start.end() - 1);
  grid.position.resize(wrapped.size());
  for (std::size_t i = 0; i < wrapped.size(); ++i) grid.position[next[at[i]]++] = wrapped[i];
  return grid;
}

double nearest_square(const PeriodicCell<3>& cell, Vec3 d) {
  if (cell.tilt != 0) {
    d += cell.offset(cell.nearest_image(d));
    return dot(d, d);
  }
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const double near = std::min(std::abs(d[k]), cell.length[k] - std::abs(d[k]));
    square += near * near;
  }
  return square;
}

}  // namespace

RadialDistribution radial_distribution(const Packing<3>& packing, double r_max, double bin) {
  const Grid grid = grid_of(packing, r_max);
  const auto bins = static_cast<std::size_t>(std::floor(r_max / bin));
  std::vector<std::int64_t> pairs(bins, 0);
  const auto neighbours = [](int c, int count) {  // of an axis, each once
    std::vector<int> all{c};
    if (count > 1) all.push_back((c + 1) % count);
    if (count > 2) all.push_back((c + count - 1) % count);
    return all;
  };
  for (int z = 0; z < grid.count[2]; ++z)
    for (int y = 0; y < grid.count[1]; ++y)
      for (int x = 0; x < grid.count[0]; ++x)
        for (const int nz : neighbours(z, grid.count[2]))
          for (const int ny : neighbours(y, grid.count[1]))
            for (const int nx : neighbours(x, grid.count[0])) {
              const std::size_t a = grid.cell(x, y, z), b = grid.cell(nx, ny, nz);
              if (b < a) continue;
              for (std::size_t i = grid.start[a]; i < grid.start[a + 1]; ++i)
                for (std::size_t j = a == b ? i + 1 : grid.start[b]; j < grid.start[b + 1]; ++j) {
                  const double square = nearest_square(*packing.cell, grid.position[j] - grid.position[i]);
                  const double slot = std::sqrt(square) / bin;
                  if (slot < static_cast<double>(bins)) ++pairs[static_cast<std::size_t>(slot)];
                }
            }
  RadialDistribution result;
  const auto n = static_cast<double>(packing.bodies.size());
  const double half_density = 0.5 * n * (n - 1) / packing.cell->measure();
  for (std::size_t k = 0; k <= bins; ++k) result.edges.push_back(static_cast<double>(k) * bin);
  for (std::size_t k = 0; k < bins; ++k) {
    const double low = result.edges[k], high = result.edges[k + 1];
    const double shell = 4.0 / 3.0 * std::numbers::pi * (high * high * high - low * low * low);
    result.g.push_back(static_cast<double>(pairs[k]) / (half_density * shell));
  }
  return result;
}

nlohmann::ordered_json rdf_section(const AnalysisInput& input, const AnalysisOptions&) {
  constexpr double kReach = 5, kBinsPerDiameter = 40;  // in largest diameters
  const Packing<3>& packing = *input.packing_3d;
  const double diameter = 2 * *std::max_element(packing.bodies.radius.begin(), packing.bodies.radius.end());
  const double half = 0.5 * packing.cell->shortest_spacing();
  const RadialDistribution rdf =
      radial_distribution(packing, std::min(kReach * diameter, half), diameter / kBinsPerDiameter);
  return {{"r_edges", rdf.edges}, {"g", rdf.g}};
}

}  // namespace isostat
