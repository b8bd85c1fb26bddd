// Hierarchical insertion in a spherical shell at the defaults (PHYSICS.md 3) and at larger ratios of radii: what comes
// of it, CPU seconds, peak memory of the process so far; and the blind method on the same lists, which draws every
// trial, with the same search for neighbours (grid) and with a look at every grain (pairs). Arguments: ratios; 10 alone
// by default.
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "dem/sample/grain_index.hpp"
#include "dem/sample/insertion_report.hpp"
#include "tests/oracle/blind_insertion.hpp"

namespace {

using namespace isostat;

template <class Work>
double cpu_seconds(const Work& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

long peak_megabytes() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

InsertionScene with_ratio(double ratio) {
  InsertionScene s;
  s.radius_min = s.radius_max / ratio;
  return s;
}

void fast(double ratio, std::uint64_t seed) {
  const InsertionScene s = with_ratio(ratio);
  InsertedGrains<3> g;
  const double seconds = cpu_seconds([&] { g = insert_grains<3>(s, seed); });
  const InsertionReport r = insertion_report(g, s);
  std::printf("fast,%g,%llu,%zu,%zu,%.4f,%.3f,%.3f,%.3f,%.3f,%.4g,%llu,%zu,%.3f,%ld\n", ratio,
              static_cast<unsigned long long>(seed), r.listed, r.grains, r.solid_fraction, r.exponent.value,
              r.exponent.error, r.fit.exponent, r.fit.exponent_error, g.work.blind_trials,
              static_cast<unsigned long long>(g.work.points), g.work.cells, seconds, peak_megabytes());
  std::fflush(stdout);
}

void blind(double ratio, std::uint64_t seed, bool all_pairs) {
  const InsertionScene s = with_ratio(ratio);
  const Enclosure<3> room = enclosure_of<3>(s);
  Random random(seed);
  const std::vector<double> radii = listed_radii(s, 3, room.measure(), random);
  GrainIndex<3> index(room, radii.front(),
                      std::vector<std::size_t>(GrainIndex<3>::tier(radii[0], radii.back()) + 1, 10000));
  double trials = 0;
  std::size_t grains = 0;
  const double seconds = cpu_seconds([&] {
    if (all_pairs) {
      grains = oracle::place_blind(room, radii, s.trials, random).radius.size();
      return;
    }
    trials = oracle::place_blind(
        room, radii, s.trials, random,
        [&](const Vec3& x, double r) { return !index.any_within(x, r, [](std::size_t, double) { return true; }); },
        [&](const Vec3& x, double r) { index.add(x, r); });
    grains = index.grains().size();
  });
  std::printf("blind %s,%g,%llu,%zu,%zu,,,,,,%.4g,%.4g,,%.3f,%ld\n", all_pairs ? "pairs" : "grid", ratio,
              static_cast<unsigned long long>(seed), radii.size(), grains, trials, trials, seconds, peak_megabytes());
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** arguments) {
  std::printf(
      "method,ratio,seed,listed,grains,solid_fraction,exponent,exponent_error,fit_exponent,fit_error,trials,points,"
      "cells,"
      "cpu_s,peak_mb\n");
  if (count == 1) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) fast(10, seed);
    blind(10, 1, false);
    blind(10, 1, true);
  }
  for (int k = 1; k < count; ++k) fast(std::atof(arguments[k]), 1);
}
