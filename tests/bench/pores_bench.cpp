// Time of find_pores against the number of disks, for dense, loose and dilute packings; the paper's mesh beside it.
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>

#include "geometry/pores.hpp"
#include "tests/oracle/union_mesh.hpp"
#include "tests/support/disk_packings.hpp"

using namespace isostat;

namespace {

template <class F>
double milliseconds(F&& work) {  // of CPU, best of three
  double best = 1e300;
  for (int k = 0; k < 3; ++k) {
    const auto start = std::clock();
    work();
    best = std::min(best, 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

void row(const char* kind, const oracle::Disks& d, bool mesh) {
  Pores p;
  const double ms = milliseconds([&] { p = find_pores(d.centre, d.radius, d.cell); });
  double mesh_ms = std::nan("");
  if (mesh) mesh_ms = milliseconds([&] { oracle::mesh_pores(oracle::union_mesh(d.centre, d.radius, d.cell, 0.01)); });
  double total = p.covered_area;
  for (const auto& q : p.pores) total += q.area;
  std::printf("%s,%zu,%zu,%.3f,%.3g,%.1f,%.2e\n", kind, d.centre.size(), p.pores.size(), ms,
              1e3 * ms / double(d.centre.size()), mesh_ms, std::abs(total / d.cell.measure() - 1));
}

oracle::Disks square_side(double n, double fraction) {
  oracle::Disks d;
  const double side = std::sqrt(n * std::numbers::pi * 0.146 / fraction);  // <r^2> = .146 for r in [1/4, 1/2]
  d.cell.length = {side, side};
  return d;
}

}  // namespace

int main(int argc, char**) {
  const bool large = argc > 1;
  std::printf("kind,disks,pores,cpu_ms,cpu_us_per_disk,mesh_a100_cpu_ms,area_closure\n");
  for (const std::size_t n : {1400u, 5600u, 100000u, 1000000u}) {
    if (n > 100000 && !large) continue;
    const auto dense = square_side(double(n), 1.1);
    row("overlapping", oracle::poisson_disks(n, dense.cell.length, 0.25, 0.5, 1), n < 10000);
    if (n > 100000) continue;  // random addition of 1e6 disks takes longer than all the rest
    const auto half = square_side(double(n), 0.48);
    row("rsa", oracle::rsa_disks(n, half.cell.length, 0.25, 0.5, 1), n < 10000);
    const double side = std::sqrt(double(n) * 0.5 / 0.36);  // chains: about .36 solid
    row("chains", oracle::chain_disks(n / 33, {side, side}, 1e-5, 1), n < 10000);
  }
}
