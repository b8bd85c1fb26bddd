// Density of vibrational states of packings too large for their eigenvalues: D(omega) d omega = rho(lambda) d lambda,
// omega^2 = lambda an eigenvalue of M^-1/2 K M^-1/2 (kernel_polynomial.hpp).
#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/input.hpp"
#include "analysis/stiffness/density_options.hpp"
#include "analysis/stiffness/kernel_polynomial.hpp"

namespace isostat {

// Unstable modes stand at -|omega|. Zero modes are in none of the bins.
struct DensityOfStates {
  std::int64_t dofs = 0, zero_modes = 0;  // exact
  int moments = 0, vectors = 0;
  SpectrumBounds bounds;             // of omega^2; both 0: nothing vibrates, and there are no bins
  double resolution = 0;             // standard deviation of the kernel at omega = 0, in omega
  std::vector<double> edges;         // ascending, multiples of a width of 1, 2 or 5 times a power of ten
  std::vector<double> density;       // by bin: modes per unit of omega; sums up to dofs - zero_modes
  std::vector<double> error;         // its standard error, from the scatter of the vectors; NaN for one vector
  std::vector<double> kernel_error;  // |difference to half the moments|: more than the kernel does where D is smooth
  std::vector<double> below, below_error;  // modes below the upper edge of the bin, zero modes included
};

// a: M^-1/2 K M^-1/2. definite: no stiffness is negative, and so no eigenvalue.
DensityOfStates density_of_states(const SymmetricMatrix& a, bool definite, std::int64_t zero_modes,
                                  const DensityOptions& options);
// Throws InputError for grains without mass.
DensityOfStates density_of_states(const AnalysisInput& input, const AnalysisOptions& options);

nlohmann::ordered_json described(const DensityOfStates& density);

}  // namespace isostat
