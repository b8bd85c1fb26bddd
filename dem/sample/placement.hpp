// The two halves of hierarchical insertion: placing a list of radii, and growth to contact.
#pragma once
#include <vector>

#include "dem/sample/insertion.hpp"

namespace isostat {

template <int D>
struct Placed {
  std::vector<Vec<D>> position;
  std::vector<double> radius;  // those of the list that found a place
  InsertionWork work;
};

// radii: descending, not empty; the first fits the room. `trials` each.
template <int D>
Placed<D> place(const Enclosure<D>& enclosure, const std::vector<double>& radii, double trials, Random random);

// Radii of the first `count` grains after growth in the order of storage: each to contact with the nearest surface, of
// a grain or the shell, but not beyond `most`. Those of radius `kept` do not grow.
template <int D>
std::vector<double> grown(const Enclosure<D>& enclosure, const Placed<D>& placed, std::size_t count, double most,
                          double kept);

}  // namespace isostat
