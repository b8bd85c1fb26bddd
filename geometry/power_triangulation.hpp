// Regular (power) triangulation of weighted sites on a flat torus, as plain arrays.
//
// The power of a point x with respect to site i is |x - p_i|^2 - w_i. Three sites form a face when some point (the
// orthocentre) has the same power for the three and no smaller one for any other site. Edelsbrunner, "The union of
// balls and its dual shape" (1995).
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/base/index.hpp"
#include "geometry/periodic_cell.hpp"
#include "geometry/vec.hpp"

namespace isostat {

// Sites whose images are exact: every coordinate, and the edges of the cell, are multiples of one power of two, so
// that position + shift * length is a double without rounding for the images within `padding` of the cell.
struct PeriodicSites {
  Vec2 length{};  // cell edges (L1, 0), (tilt, L2)
  double tilt = 0;
  std::vector<Vec2> position;  // in the cell, distinct
  std::vector<double> weight;  // [length^2], may be negative
  double padding = 0;          // no image further from the cell can touch a face that has a vertex in it
};

struct SiteImage {
  std::int32_t site = 0;
  ImageShift<2> shift{};  // [cells]
  friend bool operator==(const SiteImage&, const SiteImage&) = default;
};

// The star of each site in the cell: its neighbours anticlockwise, and the face between each one and the next.
struct PowerTriangulation {
  std::vector<std::int32_t> first;              // star of site i: slots first[i] .. first[i+1]-1; empty: hidden site
  std::vector<SiteImage> neighbour;             // per slot
  std::vector<std::int32_t> face;               // per slot: face (site, neighbour[slot], neighbour[next slot]) ...
  std::vector<ImageShift<2>> face_shift;        // ... which is the listed face moved by this shift
  std::vector<std::array<SiteImage, 3>> faces;  // anticlockwise; the first vertex has shift 0

  std::int32_t next(std::int32_t site, std::int32_t slot) const {
    return slot + 1 == first[idx(site) + 1] ? first[idx(site)] : slot + 1;
  }
  std::int32_t previous(std::int32_t site, std::int32_t slot) const {
    return (slot == first[idx(site)] ? first[idx(site) + 1] : slot) - 1;
  }
  // Slot of `image` in the star of `site`; throws std::logic_error if there is none.
  std::int32_t slot_of(std::int32_t site, const SiteImage& image) const;
};

// Exact predicates, symbolic perturbation (lexicographic, hence the same for all images): the result is one and the
// same periodic triangulation in degenerate cases too. Throws std::logic_error if the padding was not enough.
PowerTriangulation power_triangulation(const PeriodicSites& sites);

}  // namespace isostat
