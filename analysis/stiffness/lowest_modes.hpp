// Eigenpairs of A x = lambda M x nearest to zero, null space of A left out: Lanczos (Spectra) on a filtered inverse of
// CHOLMOD's, for which the dimension of the null space is enough.
#pragma once
#include <limits>
#include <vector>

#include "analysis/stiffness/sparse_cholesky.hpp"

namespace isostat {

inline constexpr double kSoftest = 1e-11;

struct LowestModes {
  std::vector<double> value;                // lambda, by ascending magnitude
  std::vector<std::vector<double>> vector;  // M-orthonormal; empty unless asked for
  bool converged = true;                    // false: Lanczos stopped before all were found; those found are given
};

// mass: diagonal of M, all positive; empty: the identity. dependent: one flag a column of `a`, see dependent_columns();
// only their number in each block of coupled columns counts. Blocks are solved one by one, densely where they are small
// (size <= kDenseSize) or a third of their modes is wanted. Modes softer than `softest` (of the maximum norm |A|,
// masses scaled out) may be missed beside stiff ones; a smaller value can cost further factorisations. Throws
// FactorisationFailed if A + shift cannot be factorised (shift >= 1e-13 |A|).
LowestModes lowest_modes(const SymmetricMatrix& a, const std::vector<char>& dependent, std::vector<double> mass,
                         int count, bool definite, bool vectors, double softest = kSoftest);
inline constexpr std::int32_t kDenseSize = 240;
inline constexpr int kAllModes = std::numeric_limits<int>::max();  // as `count`

}  // namespace isostat
