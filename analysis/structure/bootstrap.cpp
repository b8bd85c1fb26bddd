#include "analysis/structure/bootstrap.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "analysis/structure/fit_json.hpp"

namespace isostat {
namespace {

constexpr double kFewestTold = 0.9;  // of the resamples

}  // namespace

Bootstrap bootstrap_fit(std::size_t samples,
                        const std::function<FractalFit(const std::vector<std::size_t>& drawn)>& refit) {
  Bootstrap b;
  b.samples = samples;
  std::mt19937_64 engine(20070111);  // its numbers are fixed by the standard
  std::vector<FractalFit> fits;
  std::vector<std::size_t> drawn(samples);
  for (; b.resamples < kResamples; ++b.resamples) {
    for (std::size_t& d : drawn) d = static_cast<std::size_t>(engine() % samples);
    FractalFit fit = refit(drawn);
    if (fit.identifiable) fits.push_back(std::move(fit));
  }
  b.told = static_cast<int>(fits.size());
  b.error.fill(std::numeric_limits<double>::quiet_NaN());
  if (b.told < 2) return b;
  const double n = b.told, inside = static_cast<double>(samples) / static_cast<double>(samples - 1);
  double FractalFit::*const member[] = {&FractalFit::d_f, &FractalFit::xi, &FractalFit::amplitude,
                                        &FractalFit::constant};
  for (std::size_t p = 0; p < 4; ++p) {
    double mean = 0, squares = 0;
    for (const FractalFit& f : fits) mean += f.*member[p] / n;
    for (const FractalFit& f : fits) squares += (f.*member[p] - mean) * (f.*member[p] - mean);
    b.error[p] = std::sqrt(squares / (n - 1) * inside);
  }
  return b;
}

void add_bootstrap(nlohmann::ordered_json& json, const FractalFit& of, std::size_t samples,
                   const std::function<FractalFit(const std::vector<std::size_t>& drawn)>& refit) {
  json["bootstrap"] = nullptr;
  if (samples < kFewestSamples || !std::isfinite(of.chi2)) return;
  const Bootstrap b = bootstrap_fit(samples, refit);
  nlohmann::ordered_json& out = json["bootstrap"];
  out = {{"samples", b.samples}, {"resamples", b.resamples}, {"told", b.told}};
  const char* const names[] = {"d_F_error", "xi_error", "amplitude_error", "constant_error"};
  for (std::size_t p = 0; p < 4; ++p) out[names[p]] = defined(b.error[p]);
  if (b.told >= kFewestTold * b.resamples || !of.identifiable) return;
  json["identifiable"] = false;
  json["message"] = "only " + std::to_string(b.told) + " of " + std::to_string(b.resamples) +
                    " resamples of the samples have an optimum in the range of lengths that the window can tell";
}

}  // namespace isostat
