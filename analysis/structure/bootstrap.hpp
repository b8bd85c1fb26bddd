// Errors of a fit by bootstrap over samples: the samples of an ensemble are drawn with replacement, and what is made of
// them is fitted anew. The scatter of the fits is what another ensemble of the same size would give.
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/structure/fractal_fit.hpp"

namespace isostat {

inline constexpr std::size_t kFewestSamples = 3;  // two samples make one resample that differs
inline constexpr int kResamples = 200;

struct Bootstrap {
  std::size_t samples = 0;
  int resamples = 0;  // fitted
  int told = 0;       // those whose optimum lies in the range that the window can tell; the others are left out
  std::array<double, 4> error{};  // of d_F, xi, amplitude, constant: sd over resamples times sqrt(n/(n - 1))
};

// refit: the fit of the samples of these numbers, each as often as it stands there. The same draws for the same number
// of samples. Needs kFewestSamples.
Bootstrap bootstrap_fit(std::size_t samples,
                        const std::function<FractalFit(const std::vector<std::size_t>& drawn)>& refit);

// Adds "bootstrap" to the JSON of a fit: null below kFewestSamples or without a fit; says so in "identifiable" and
// "message" where less than nine resamples in ten have an optimum in range.
void add_bootstrap(nlohmann::ordered_json& fit, const FractalFit& of, std::size_t samples,
                   const std::function<FractalFit(const std::vector<std::size_t>& drawn)>& refit);

}  // namespace isostat
