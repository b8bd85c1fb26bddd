// Error of C(r) against the cut of the modes, for separate, touching and overlapping disks: the largest difference from
// the exact areas of unions, r from 0 to 4 diameters.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "analysis/structure/correlation.hpp"
#include "tests/oracle/exact_correlation.hpp"
#include "tests/support/disk_packings.hpp"

using namespace isostat;

int main() {
  std::printf("kind,disks,k_cut,cpu_ms,largest_error,rms_error\n");
  const auto measure = [](const char* kind, const oracle::Disks& d) {
    std::vector<double> r{0}, exact;
    while (r.size() < 16) r.push_back(r.back() + (r.size() < 10 ? 0.131 : 0.571));
    for (const double x : r) exact.push_back(oracle::exact_correlation(d, x, 300));
    for (const double k_cut : {12.5, 25.0, 50.0, 100.0, 200.0}) {
      const auto start = std::clock();
      const auto curve = density_correlation(d.centre, d.radius, d.cell, r, k_cut);
      const double ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      double worst = 0, square = 0;
      for (std::size_t n = 0; n < r.size(); ++n) {
        const double error = std::abs(curve.c[n] - exact[n]);
        worst = std::max(worst, error), square += error * error;
      }
      std::printf("%s,%zu,%g,%.1f,%.2e,%.2e\n", kind, d.centre.size(), k_cut, ms, worst,
                  std::sqrt(square / static_cast<double>(r.size())));
      std::fflush(stdout);
    }
  };
  measure("separate", oracle::rsa_disks(150, {14, 13}, 0.25, 0.5, 1));
  measure("chains_1e-9", oracle::chain_disks(4, {15, 14}, 1e-9, 1));
  measure("chains_1e-5", oracle::chain_disks(4, {15, 14}, 1e-5, 1));
  measure("chains_1e-3", oracle::chain_disks(4, {15, 14}, 1e-3, 1));
  measure("chains_0.01", oracle::chain_disks(4, {15, 14}, 0.01, 1));
  measure("chains_0.05", oracle::chain_disks(4, {15, 14}, 0.05, 1));
  measure("overlapping", oracle::poisson_disks(150, {11, 10}, 0.25, 0.5, 1));
}
