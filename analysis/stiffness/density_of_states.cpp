#include "analysis/stiffness/density_of_states.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/figure/nice_numbers.hpp"
#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/stiffness/stiff_rows.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Vector = std::vector<double>;

double squared(double omega) { return std::copysign(omega * omega, omega); }
double root(double lambda) { return std::copysign(std::sqrt(std::abs(lambda)), lambda); }

// Of a round width: samples of one law share it, and so bins that can be averaged.
Vector bin_edges(const SpectrumBounds& bounds, int bins) {
  const double low = root(bounds.low), high = root(bounds.high);
  for (double least = (high - low) / bins;; least *= 1.01) {
    const double width = nice_above(least), first = std::floor(low / width), last = std::ceil(high / width);
    if (last - first > bins) continue;  // both ends were rounded outwards
    Vector edges;
    for (double k = first; k <= last; ++k) edges.push_back(k * width);
    return edges;
  }
}

// Standard deviation pi / N in the angle acos x. Where nothing is negative omega goes as the sine of half of it.
double resolution_at_zero(const SpectrumBounds& b, int moments) {
  const double angle = std::numbers::pi / moments;
  if (b.low == 0) return angle / 2 * std::sqrt(b.high);
  return std::sqrt(angle * std::sqrt(-b.low * b.high));
}

// What the zero modes add to each trace: T_n(x(0)).
void take_out(std::vector<Vector>& moments, std::int64_t zero_modes, double x) {
  const double angle = std::acos(std::clamp(x, -1.0, 1.0));
  for (Vector& of_vector : moments)
    for (std::size_t n = 0; n < of_vector.size(); ++n)
      of_vector[n] -= static_cast<double>(zero_modes) * std::cos(static_cast<double>(n) * angle);
}

struct Mean {
  double value = 0, error = 0;
};
template <class Of>
Mean mean_over(std::size_t n, const Of& of) {
  Mean mean;
  double squares = 0;
  for (std::size_t r = 0; r < n; ++r) mean.value += of(r) / static_cast<double>(n);
  for (std::size_t r = 0; r < n; ++r) squares += (of(r) - mean.value) * (of(r) - mean.value);
  mean.error = std::sqrt(squares / static_cast<double>(n) / (static_cast<double>(n) - 1));  // NaN for one
  return mean;
}

std::int64_t dependent_count(const AnalysisInput& input, NetworkLaw law) {
  const std::vector<char> dependent = input.packing_3d ? dependent_columns(input.spheres(), law, false)
                                                       : dependent_columns(input.network(), law, false);
  return std::count(dependent.begin(), dependent.end(), 1);
}

}  // namespace

DensityOfStates density_of_states(const SymmetricMatrix& a, bool definite, std::int64_t zero_modes,
                                  const DensityOptions& options) {
  DensityOfStates d;
  d.dofs = a.size, d.zero_modes = zero_modes;
  d.moments = options.chebyshev_moments(), d.vectors = options.vectors;
  d.bounds = spectrum_bounds(a, definite);
  if (!(d.bounds.high > d.bounds.low)) return d;
  const auto count = idx(d.moments), vectors = idx(d.vectors);
  auto moments = chebyshev_moments(a, d.bounds, count, vectors, random_sign);
  while (!moments) {  // a thin tail that Lanczos has not seen
    const double more = 0.05 * (d.bounds.high - d.bounds.low);
    d.bounds = {definite ? 0 : d.bounds.low - more, d.bounds.high + more};
    moments = chebyshev_moments(a, d.bounds, count, vectors, random_sign);
  }
  take_out(*moments, zero_modes, d.bounds.mapped(0));
  d.resolution = resolution_at_zero(d.bounds, d.moments);
  d.edges = bin_edges(d.bounds, options.bins);
  Vector lambda;
  for (const double omega : d.edges) lambda.push_back(squared(omega));
  const std::vector<Vector> counts = smoothed_counts(*moments, count, d.bounds, lambda),
                            coarse = smoothed_counts(*moments, count / 2, d.bounds, lambda);
  for (std::size_t k = 0; k + 1 < d.edges.size(); ++k) {
    const double width = d.edges[k + 1] - d.edges[k];
    const auto density = [&](const std::vector<Vector>& of) {
      return mean_over(vectors, [&](std::size_t r) { return (of[r][k + 1] - of[r][k]) / width; });
    };
    const Mean fine = density(counts), below = mean_over(vectors, [&](std::size_t r) { return counts[r][k + 1]; });
    d.density.push_back(fine.value), d.error.push_back(fine.error);
    d.kernel_error.push_back(std::abs(fine.value - density(coarse).value));
    d.below.push_back(below.value + (d.edges[k + 1] >= 0 ? static_cast<double>(zero_modes) : 0));
    d.below_error.push_back(below.error);
  }
  return d;
}

DensityOfStates density_of_states(const AnalysisInput& input, const AnalysisOptions& options) {
  AnalysisOptions fixed = options;
  fixed.cell_free = false;  // as modes_of()
  const NetworkLaw law = input.network_law(options);
  const Vector mass = input.packing_3d ? dof_masses(input.spheres(), law) : dof_masses(input.network(), law);
  const auto [a, definite] = [&] {
    const StiffRows rows = stiff_rows(input, fixed);
    return std::pair{mass_scaled(weighted_normal_matrix(rows.g, rows.k), mass),
                     std::all_of(rows.k.begin(), rows.k.end(), [](double k) { return k > 0; })};
  }();
  return density_of_states(a, definite, dependent_count(input, law), *options.density);
}

nlohmann::ordered_json described(const DensityOfStates& d) {
  return {{"moments", d.moments},
          {"random_vectors", d.vectors},
          {"omega_min", root(d.bounds.low)},
          {"omega_max", root(d.bounds.high)},
          {"resolution", d.resolution},
          {"histogram",
           {{"edges", d.edges},
            {"density", d.density},
            {"error", d.error},
            {"kernel_error", d.kernel_error},
            {"below", d.below},
            {"below_error", d.below_error}}}};
}

}  // namespace isostat
