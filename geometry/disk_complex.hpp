// Dual complex of a union of closed disks in a periodic cell: which faces of the power triangulation are covered and
// which edges are closed. The union has the homotopy type of the complex, so the components of the void are the
// components of the open faces joined across the open edges. Edelsbrunner (1995).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/periodic_cell.hpp"
#include "geometry/power_triangulation.hpp"

namespace isostat {

enum class EdgeState : std::uint8_t {
  open,     // void can pass between the two disks here
  closed,   // the disks overlap or touch on their common power edge
  bridged,  // a gap of at most the tolerance, treated as closed by a link of no width
};

struct DiskComplex {
  PeriodicCell<2> cell;
  std::vector<Vec2> centre;         // [length] disks in [0, L), duplicates removed
  std::vector<double> radius;       // [length]
  std::vector<std::int32_t> input;  // index in the caller's arrays
  // The triangulation's sites are the disks followed by auxiliary empty sites (of negative weight: they cover nothing,
  // close nothing, and only bound the size of the faces, hence the padding).
  PowerTriangulation triangulation;
  std::vector<std::uint8_t> face_covered;  // per listed face: its orthocentre lies in the union
  std::vector<EdgeState> edge;             // per slot
  std::vector<Vec2> branch;                // per slot: vector to the neighbour [length]

  std::size_t size() const { return centre.size(); }
  bool is_disk(std::int32_t site) const { return static_cast<std::size_t>(site) < centre.size(); }
};

// Signs are exact: of the input as it stands for the distance of two disks (an exact tangency closes), and for the rest
// of coordinates rounded to the last bit of the cell's edge. centre: any image, in the cell or not [length];
// radius >= 0; gap_tolerance >= 0 [length]. Throws std::invalid_argument for values that are not finite or negative.
DiskComplex disk_complex(std::span<const Vec2> centre, std::span<const double> radius, const PeriodicCell<2>& cell,
                         double gap_tolerance = 0);

}  // namespace isostat
