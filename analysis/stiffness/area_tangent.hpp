// What an overlap does when its triangles move: U = Y A^2 / (2 L_c), so its resistance is (Y/L_c) grad A grad A^T + p
// grad^2 A. Without friction.
#pragma once
#include <array>
#include <vector>

#include "analysis/link_network.hpp"

namespace isostat {

struct AreaTangent {
  struct Place {
    std::int32_t body;
    ImageShift<2> shift;
  };
  std::vector<Place> place;        // of every triangle that the overlap clips
  std::vector<double> load;        // three a place: force and moment about the centroid, as they are
  std::vector<double> resistance;  // square, symmetric, row by row: -d(load)/d(x, y, angle)
  std::size_t size() const { return load.size(); }
};

AreaTangent area_tangent(const LinkNetwork& network, const AreaLink& link);

}  // namespace isostat
