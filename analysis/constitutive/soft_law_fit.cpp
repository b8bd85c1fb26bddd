#include "analysis/constitutive/soft_law_fit.hpp"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dem/solver/random.hpp"

namespace isostat {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<double, 4> kStartExponents{1.5, 2.5, 4, 6};
constexpr int kMostSteps = 200;

struct Data {
  const std::vector<double>&x, &y;
};

// In ln a, b and c.
double model(double x, const gsl_vector* p) {
  return std::max(0.0, std::exp(gsl_vector_get(p, 0)) * std::pow(x, gsl_vector_get(p, 1)) + gsl_vector_get(p, 2));
}

int residuals(const gsl_vector* p, void* data, gsl_vector* out) {
  const auto& d = *static_cast<const Data*>(data);
  for (std::size_t k = 0; k < d.x.size(); ++k) {
    const double r = model(d.x[k], p) - d.y[k];
    gsl_vector_set(out, k, std::isfinite(r) ? r : 1e150);
  }
  return GSL_SUCCESS;
}

struct Optimum {
  std::array<double, 3> p{};
  double chi2 = std::numeric_limits<double>::infinity();
};

Optimum descend(const Data& data, const std::array<double, 3>& start) {
  gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  auto* work = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, data.x.size(), 3);
  gsl_multifit_nlinear_fdf fdf{};
  fdf.f = residuals;
  fdf.n = data.x.size(), fdf.p = 3;
  fdf.params = const_cast<Data*>(&data);
  const auto from = gsl_vector_const_view_array(start.data(), 3);
  Optimum best;
  if (gsl_multifit_nlinear_init(&from.vector, &fdf, work) == GSL_SUCCESS) {
    int info = 0;
    gsl_multifit_nlinear_driver(kMostSteps, 1e-12, 1e-14, 0, nullptr, nullptr, &info, work);
    gsl_blas_ddot(work->f, work->f, &best.chi2);
    for (std::size_t n = 0; n < 3; ++n) best.p[n] = gsl_vector_get(work->x, n);
  }
  gsl_multifit_nlinear_free(work);
  return best;
}

// a and c that fit the loaded points best for a given b.
std::array<double, 3> start_at(const Data& d, double b) {
  double n = 0, s = 0, ss = 0, t = 0, st = 0;
  for (std::size_t k = 0; k < d.x.size(); ++k) {
    if (!(d.y[k] > 0)) continue;
    const double g = std::pow(d.x[k], b);
    n += 1, s += g, ss += g * g, t += d.y[k], st += g * d.y[k];
  }
  const double a = (n * st - s * t) / (n * ss - s * s), c = (t - a * s) / n;
  const double top = *std::max_element(d.y.begin(), d.y.end());
  return {std::log(a > 0 ? a : top / std::pow(d.x.back(), b)), b, a > 0 ? c : 0.0};
}

// y fitted by a (x^b - delta^b) above delta: the best a for a given b, and what is left.
struct Slope {
  double a = 0, chi2 = std::numeric_limits<double>::infinity();
};
Slope slope_at(double b, double delta, const Data& d) {
  double gg = 0, gy = 0, yy = 0;
  for (std::size_t k = 0; k < d.x.size(); ++k) {
    const double g = std::max(0.0, std::pow(d.x[k], b) - std::pow(delta, b));
    gg += g * g, gy += g * d.y[k], yy += d.y[k] * d.y[k];
  }
  return {gy / gg, yy - gy * gy / gg};
}

// Draws of packings with replacement; `fit` makes a law of the numbers drawn.
template <class Fit>
SoftLawErrors bootstrap(std::size_t packings, int draws, std::uint64_t seed, Fit fit) {
  if (packings < 2) return {kNaN, kNaN, kNaN, kNaN};
  Random random(seed);
  std::array<double, 4> sum{}, squares{};
  double n = 0;
  for (int d = 0; d < draws; ++d) {
    std::vector<std::size_t> drawn(packings);
    for (std::size_t& k : drawn) k = static_cast<std::size_t>(random.uniform() * static_cast<double>(packings));
    const SoftLaw law = fit(drawn);
    if (!std::isfinite(law.a)) continue;
    const std::array<double, 4> p{law.a, law.b, law.c, law.delta};
    for (std::size_t k = 0; k < 4; ++k) sum[k] += p[k], squares[k] += p[k] * p[k];
    n += 1;
  }
  std::array<double, 4> error;
  for (std::size_t k = 0; k < 4; ++k) {
    const double mean = sum[k] / n;
    error[k] = n > 1 ? std::sqrt(std::max(0.0, squares[k] / n - mean * mean) * n / (n - 1)) : kNaN;
  }
  return {error[0], error[1], error[2], error[3]};
}

std::vector<double> mean_over(const std::vector<std::vector<double>>& samples, const std::vector<std::size_t>& drawn) {
  std::vector<std::vector<double>> some;
  for (const std::size_t k : drawn) some.push_back(samples[k]);
  return mean_of(some);
}

}  // namespace

double SoftLaw::operator()(double x) const { return std::max(0.0, a * std::pow(x, b) + c); }

SoftLaw fit_soft_law(const std::vector<double>& x, const std::vector<double>& y) {
  const auto loaded = std::count_if(y.begin(), y.end(), [](double f) { return f > 0; });
  if (loaded < 3 || x.size() != y.size()) return {kNaN, kNaN, kNaN, kNaN, kNaN};
  gsl_set_error_handler_off();
  const Data data{x, y};
  Optimum best;
  for (const double b : kStartExponents)
    if (const Optimum o = descend(data, start_at(data, b)); o.chi2 < best.chi2) best = o;
  SoftLaw law{std::exp(best.p[0]), best.p[1], best.p[2], 0, 0};
  law.delta = law.c < 0 ? std::pow(-law.c / law.a, 1 / law.b) : 0.0;
  law.rms = std::sqrt(best.chi2 / static_cast<double>(x.size()));
  return law;
}

SoftLaw fit_soft_law_from(double delta, const std::vector<double>& x, const std::vector<double>& y) {
  std::size_t loaded = 0;
  for (std::size_t k = 0; k < x.size(); ++k) loaded += x[k] > delta && y[k] > 0;
  if (loaded < 2 || x.size() != y.size()) return {kNaN, kNaN, kNaN, kNaN, kNaN};  // delta may be NaN
  const Data data{x, y};
  constexpr double kLeast = 0.05, kMost = 20, kGolden = 0.6180339887498949, kScan = 0.05;
  double best = kLeast;
  for (double b = kLeast; b <= kMost; b += kScan)
    if (slope_at(b, delta, data).chi2 < slope_at(best, delta, data).chi2) best = b;
  double low = best - kScan, high = best + kScan;
  for (int k = 0; k < 60; ++k) {
    const double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    if (slope_at(left, delta, data).chi2 < slope_at(right, delta, data).chi2)
      high = right;
    else
      low = left;
  }
  SoftLaw law;
  law.b = (low + high) / 2, law.delta = delta;
  const Slope slope = slope_at(law.b, delta, data);
  law.a = slope.a, law.c = -law.a * std::pow(delta, law.b);
  law.rms = std::sqrt(std::max(0.0, slope.chi2) / static_cast<double>(x.size()));
  return law;
}

std::vector<double> mean_of(const std::vector<std::vector<double>>& samples) {
  std::vector<double> mean(samples.front().size(), 0.0);
  for (const auto& s : samples)
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += s[k] / static_cast<double>(samples.size());
  return mean;
}

std::vector<double> standard_error_of(const std::vector<std::vector<double>>& samples) {
  const std::vector<double> mean = mean_of(samples);
  const auto n = static_cast<double>(samples.size());
  std::vector<double> error(mean.size(), 0.0);
  for (const auto& s : samples)
    for (std::size_t k = 0; k < mean.size(); ++k) error[k] += (s[k] - mean[k]) * (s[k] - mean[k]);
  for (double& e : error) e = n > 1 ? std::sqrt(e / (n - 1) / n) : kNaN;
  return error;
}

SoftLawErrors bootstrap_errors(const std::vector<double>& x, const std::vector<std::vector<double>>& samples, int draws,
                               std::uint64_t seed) {
  return bootstrap(samples.size(), draws, seed,
                   [&](const auto& drawn) { return fit_soft_law(x, mean_over(samples, drawn)); });
}

SoftLawErrors bootstrap_errors(const std::vector<double>& x, const std::vector<std::vector<double>>& normal,
                               const std::vector<std::vector<double>>& tangential, int draws, std::uint64_t seed) {
  return bootstrap(normal.size(), draws, seed, [&](const auto& drawn) {
    return fit_soft_law_from(fit_soft_law(x, mean_over(normal, drawn)).delta, x, mean_over(tangential, drawn));
  });
}

}  // namespace isostat
