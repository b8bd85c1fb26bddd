// Pore statistics by the paper's mesh against the exact ones, for meshes of diameter / 25 to / 400.
#include <cmath>
#include <cstdio>
#include <ctime>

#include "geometry/pores.hpp"
#include "tests/oracle/union_mesh.hpp"
#include "tests/support/disk_packings.hpp"

using namespace isostat;

int main() {
  std::printf(
      "method,mesh_per_diameter,finite_pores,mean_radius_weighted,void_fraction,cpu_ms,"
      "error_mean_radius,error_void_area\n");
  const auto d = oracle::chain_disks(42, {44, 44}, 1e-5, 1);
  const auto now = [] { return std::clock(); };
  const auto since = [&](std::clock_t start) { return 1e3 * double(now() - start) / CLOCKS_PER_SEC; };
  for (const double tolerance : {0.0, 0.0025, 0.005, 0.01, 0.02, 0.04}) {
    const auto start = now();
    const auto p = find_pores(d.centre, d.radius, d.cell, {.gap_tolerance = tolerance});
    const double ms = since(start);
    std::size_t finite = 0;
    for (const auto& q : p.pores) finite += !q.percolating;
    std::printf("exact_gap_%g,0,%zu,%.6f,%.8f,%.2f,,\n", tolerance, finite, mean_radius_weighted(p.pores),
                1 - p.covered_area / d.cell.measure(), ms);
  }
  const auto exact = find_pores(d.centre, d.radius, d.cell);
  const double radius = mean_radius_weighted(exact.pores), void_area = d.cell.measure() - exact.covered_area;
  for (const double per : {25.0, 50.0, 100.0, 200.0, 400.0}) {
    const auto start = now();
    const auto mesh = oracle::mesh_pores(oracle::union_mesh(d.centre, d.radius, d.cell, 1 / per));
    const double ms = since(start);
    double area = 0, weighted = 0, all = 0;
    std::size_t finite = 0;
    for (const auto& q : mesh) {
      all += q.area;
      if (q.percolating) continue;
      ++finite, area += q.area, weighted += q.area * q.equivalent_radius;
    }
    std::printf("mesh,%g,%zu,%.6f,%.8f,%.2f,%.3e,%.3e\n", per, finite, weighted / area, all / d.cell.measure(), ms,
                std::abs(weighted / area / radius - 1), std::abs(all / void_area - 1));
  }
}
