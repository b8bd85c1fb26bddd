// Eigenpairs of A x = lambda M x nearest to zero, null space of A left out: Lanczos (Spectra) on the pseudo-inverse.
#pragma once
#include <vector>

#include "analysis/stiffness/pseudo_inverse.hpp"

namespace isostat {

struct LowestModes {
  std::vector<double> value;                // lambda, by ascending magnitude
  std::vector<std::vector<double>> vector;  // M-orthonormal; empty unless asked for
  bool converged = true;                    // false: Lanczos stopped before all were found; those found are given
};

// mass: diagonal of M, all positive; empty: the identity. `a` and `dependent` as in PseudoInverse.
// Each block of coupled columns by itself; small blocks (size <= kDenseSize) are solved densely.
LowestModes lowest_modes(const SymmetricMatrix& a, const std::vector<char>& dependent, std::vector<double> mass,
                         int count, bool definite, bool vectors);
inline constexpr std::int32_t kDenseSize = 240;

}  // namespace isostat
