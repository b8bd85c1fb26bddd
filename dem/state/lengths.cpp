#include "dem/state/lengths.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "dem/input_error.hpp"

namespace isostat {
namespace {

std::string text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", x);
  return buffer;
}

}  // namespace

template <int D>
void require_lengths(const std::optional<PeriodicCell<D>>& cell, const Bodies<D>& bodies, const std::string& path,
                     std::optional<double> gap_tolerance, int cell_line) {
  std::vector<Fault> faults;
  const auto fault = [&](const std::string& key, double value, const std::string& rule) {
    faults.push_back({path, key.starts_with("cell") ? cell_line : 0, key, text(value), rule + ": check the units"});
  };
  double largest = 0, smallest = std::numeric_limits<double>::infinity();
  for (const double r : bodies.radius)
    if (r > 0) largest = std::max(largest, r), smallest = std::min(smallest, r);
  if (!(largest > 0)) return;
  if (!(largest >= kLeastRadius && largest <= kMostRadius))
    fault("radius", largest, "of the largest grain, from " + text(kLeastRadius) + " to " + text(kMostRadius));
  else if (smallest < kSmallestGrain * largest)
    fault("radius", smallest, "of the smallest grain, below " + text(kSmallestGrain) + " of the largest");
  for (int k = 0; k < D; ++k) {
    const std::string edge = "cell.L" + std::to_string(k + 1);
    double extent = 0;
    if (cell) {
      extent = cell->length[k];
    } else {
      const auto [low, high] = std::minmax_element(bodies.position.begin(), bodies.position.end(),
                                                   [k](const Vec<D>& a, const Vec<D>& b) { return a[k] < b[k]; });
      extent = (*high)[k] - (*low)[k];
    }
    if (cell && !(extent >= kSmallestCell * largest))
      fault(edge, extent, "an edge is below " + text(kSmallestCell) + " of the largest radius");
    if (!(extent <= kLargestExtent * largest))
      fault(cell ? edge : "grain", extent,
            std::string(cell ? "an edge" : "the extent of the packing") + " is above " + text(kLargestExtent) +
                " of the largest radius");
  }
  if (cell && !(std::abs(cell->tilt) <= kMostTilt * cell->length[0]))
    faults.push_back({path, cell_line, "tilt", text(cell->tilt),
                      "at most " + text(kMostTilt) + " L1 either way: cells whose tilts differ by L1 are the same"});
  if (gap_tolerance && *gap_tolerance > kLargestGapTolerance * largest)
    fault("--gap-tolerance", *gap_tolerance,
          "at most " + text(kLargestGapTolerance) + " of the largest radius, " + text(largest));
  if (!faults.empty()) throw InputError(std::move(faults));
}

template void require_lengths(const std::optional<PeriodicCell<2>>&, const Bodies<2>&, const std::string&,
                              std::optional<double>, int);
template void require_lengths(const std::optional<PeriodicCell<3>>&, const Bodies<3>&, const std::string&,
                              std::optional<double>, int);

}  // namespace isostat
