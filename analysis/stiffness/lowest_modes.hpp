// Eigenpairs of A x = lambda M x nearest to zero, null space of A left out: Lanczos (Spectra) on a filtered inverse of
// CHOLMOD's, for which the dimension of the null space is enough.
#pragma once
#include <vector>

#include "analysis/stiffness/sparse_cholesky.hpp"

namespace isostat {

struct LowestModes {
  std::vector<double> value;                // lambda, by ascending magnitude
  std::vector<std::vector<double>> vector;  // M-orthonormal; empty unless asked for
  bool converged = true;                    // false: Lanczos stopped before all were found; those found are given
};

// mass: diagonal of M, all positive; empty: the identity. dependent: one flag a column of `a`, see dependent_columns();
// only their number in each block of coupled columns counts. Blocks are solved one by one, small ones (size <=
// kDenseSize) densely. Modes softer than kSoftest |A| are rounding and may be missed. Throws FactorisationFailed
// (indefinite matrices only).
LowestModes lowest_modes(const SymmetricMatrix& a, const std::vector<char>& dependent, std::vector<double> mass,
                         int count, bool definite, bool vectors);
inline constexpr std::int32_t kDenseSize = 240;
inline constexpr double kSoftest = 1e-12;  // of the maximum norm, masses scaled out

}  // namespace isostat
