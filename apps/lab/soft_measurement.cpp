#include "apps/lab/soft_measurement.hpp"

#include <algorithm>
#include <iterator>

#include "apps/lab/side_by_side.hpp"

namespace isostat {
namespace {

double slope(const std::vector<TangentialPoint>& points, double TangentialPoint::*f) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const TangentialPoint& p : points)
    n += 1, x += p.alpha, y += p.*f, xx += p.alpha * p.alpha, xy += p.alpha * (p.*f);
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace

std::vector<SoftMeasurement> measure_soft_particles(const SoftParticleTest& test, std::uint64_t seed,
                                                    std::size_t packings, unsigned threads) {
  return side_by_side(packings, threads, [&](std::size_t k) { return measure_soft_particle(test, seed + k); });
}

SoftSlopes slopes_of(const SoftMeasurement& m, const std::vector<double>& deltas) {
  SoftSlopes s;
  for (const double delta : deltas) {
    std::vector<TangentialPoint> at;
    std::copy_if(m.tangential.begin(), m.tangential.end(), std::back_inserter(at),
                 [delta](const TangentialPoint& p) { return p.delta == delta; });
    s.along.push_back(slope(at, &TangentialPoint::along));
    s.across.push_back(slope(at, &TangentialPoint::perpendicular));
    s.prestrain.push_back(at.front().along);
  }
  return s;
}

}  // namespace isostat
