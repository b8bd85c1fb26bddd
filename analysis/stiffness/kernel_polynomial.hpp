// How the eigenvalues of a sparse symmetric matrix are distributed, by the kernel polynomial method (Weisse, Wellein,
// Alvermann and Fehske, Rev. Mod. Phys. 78, 275 (2006), "W"): traces of Chebyshev polynomials from random vectors, and
// Jackson's kernel. Products with the matrix only, four vectors at a time.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "analysis/stiffness/sparse_cholesky.hpp"

namespace isostat {

// An interval that holds the spectrum; x = (2 lambda - high - low) / (high - low) takes it to [-1, 1].
struct SpectrumBounds {
  double low = 0, high = 0;
  double mapped(double lambda) const { return (2 * lambda - high - low) / (high - low); }
};

// From the ends of a Lanczos run, a hundredth of the width further out; never beyond the row sums of magnitudes, which
// are a proof. definite: nothing is negative, and `low` is 0. Both are 0 for a matrix without entries.
SpectrumBounds spectrum_bounds(const SymmetricMatrix& a, bool definite);

// Component of a random vector: +1 or -1, a function of its two numbers alone. Such a vector finds the trace of a
// matrix up to its entries off the diagonal: what a body does that touches nothing is found without an error.
double random_sign(std::size_t vector, std::size_t component);

// By vector: r^T T_n(x(A)) r for n = 0 ... count - 1 (W Eqs. 34, 35: half as many products). start(vector, component)
// is r. None if a vector has grown: the spectrum reaches beyond the bounds.
using Start = std::function<double(std::size_t vector, std::size_t component)>;
std::optional<std::vector<std::vector<double>>> chebyshev_moments(const SymmetricMatrix& a,
                                                                  const SpectrumBounds& bounds, std::size_t count,
                                                                  std::size_t vectors, const Start& start);

// How many eigenvalues are below each of `lambda`, from the moments of each vector: [vector][lambda]. Jackson's kernel
// (W Eq. 71) smears an eigenvalue over pi / count in the angle acos x, with tails of its inverse fourth power; nothing
// becomes negative. `most`: only so many of the moments.
std::vector<std::vector<double>> smoothed_counts(const std::vector<std::vector<double>>& moments, std::size_t most,
                                                 const SpectrumBounds& bounds, const std::vector<double>& lambda);

}  // namespace isostat
