// Small motions of one free grain about rest, M x'' + C x' + K x = 0, with x = (dx, dy, dtheta) of each triangle.
// K = G^T k G and C = G^T c G over the three rows of every beam (dem/state/beam.hpp; Poeschel and Buchholtz 1995, Sec.
// 4).
#pragma once
#include <cstddef>
#include <vector>

#include "dem/triangles/grain_template.hpp"

namespace isostat {

// Square, row by row; 3 rows a triangle.
struct GrainMatrices {
  std::size_t size = 0;
  std::vector<double> stiffness, damping;  // K, C
  std::vector<double> mass;                // diagonal of M: m, m, J of each triangle
};
GrainMatrices grain_matrices(const GrainTemplate& grain);

// Frequencies without dampers [1/s], ascending, three a triangle. Singular values of k^1/2 G M^-1/2, so that rigid
// motions are zero to the rounding of the largest frequency, not to its root; what is zero to rounding is 0.
std::vector<double> grain_frequencies(const GrainTemplate& grain);

}  // namespace isostat
