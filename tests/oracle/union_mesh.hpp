// The paper's way to pores and scattering (Gilabert 2007, Sec. V.B): the indicator of the disks on a regular mesh.
// Slow and blurred by the mesh; the oracle of the exact ways.
#pragma once
#include <span>
#include <vector>

#include "geometry/periodic_cell.hpp"

namespace isostat::oracle {

struct Mesh {
  int nx = 0, ny = 0;
  Vec2 step{};                // [length]
  std::vector<char> covered;  // row by row, node (x, y) at ((x + .5) step, (y + .5) step)
};
Mesh union_mesh(std::span<const Vec2> centre, std::span<const double> radius, const PeriodicCell<2>& cell, double step);

struct MeshPore {
  double area = 0;
  Vec2 centroid{};               // unwrapped
  double equivalent_radius = 0;  // Eq. 29
  bool percolating = false;
};
std::vector<MeshPore> mesh_pores(const Mesh& mesh);  // four-connected, by decreasing area

}  // namespace isostat::oracle
