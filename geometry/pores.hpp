// Pores: the components of the void left by closed disks in a periodic cell, with exact topology and closed-form
// areas and moments (Gilabert 2007, Sec. V.B, Eqs. 29-30, without the mesh).
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/periodic_cell.hpp"
#include "geometry/vec.hpp"

namespace isostat {

// One arc of a pore's wall: part of the circle of one disk, anticlockwise about the disk, so that the pore lies on its
// right. Coordinates are unwrapped: the arcs of a finite pore form closed loops.
struct PoreArc {
  std::int32_t disk = 0;   // index in the caller's arrays
  Vec2 centre{};           // [length]
  double radius = 0;       // [length]
  double start = 0;        // [rad] direction in which the arc begins
  double sweep = 0;        // [rad] up to 2 pi; 0 or -1e-16 in a void that is closed to rounding
  std::uint32_t next = 0;  // index in Pores::arcs of the arc at which the wall goes on
};

struct Pore {
  double area = 0;  // [length^2]
  bool percolating = false;
  std::array<bool, 2> along{};  // percolates along x, along y (a closed way in it winds around the cell)
  // The following are for finite pores only.
  Vec2 centroid{};               // [length] unwrapped, in the frame of its arcs
  double gyration = 0;           // [length^4] polar second moment about the centroid
  double equivalent_radius = 0;  // [length] R_H = sqrt(2 gyration / area), Eq. 29; NaN if the area is 0 to rounding
  std::uint32_t first_arc = 0, arcs = 0;  // its range in Pores::arcs (empty unless asked for)
};

struct Pores {
  PeriodicCell<2> cell;
  std::vector<Pore> pores;    // percolating ones first, then by decreasing area
  std::vector<PoreArc> arcs;  // grouped by pore
  double covered_area = 0;    // [length^2] of the union, from the dual complex (independent of the pores' areas)
  double perimeter = 0;       // [length] of the union
};

struct PoreOptions {
  double gap_tolerance = 0;  // [length] gaps up to this are closed by a link of no width; areas stay those of the disks
  bool with_arcs = false;    // keep the walls, for drawing
};

// centre [length] in any image, radius [length]; throws std::invalid_argument as disk_complex does.
Pores find_pores(std::span<const Vec2> centre, std::span<const double> radius, const PeriodicCell<2>& cell,
                 const PoreOptions& options = {});

// The same in the open plane: the enclosed pores only; the outside is not a pore.
Pores find_enclosed_pores(std::span<const Vec2> centre, std::span<const double> radius,
                          const PoreOptions& options = {});

// Mass-weighted mean of R_H over finite pores (Eq. 30) [length]; NaN when there are none.
double mean_radius_weighted(std::span<const Pore> pores);

// Loops of a pore's wall as polygons (needs with_arcs), a vertex at least every `step` radians, for drawing with the
// even-odd rule. The outer loop of a finite pore runs clockwise, walls of islands anticlockwise. Coordinates are
// unwrapped: draw the images that reach into the cell. A wall that winds around the cell (percolating pores only) ends
// in another image of its beginning.
std::vector<std::vector<Vec2>> pore_polygons(const Pores& pores, std::size_t pore, double step = 0.1);

}  // namespace isostat
