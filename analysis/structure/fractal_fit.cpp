#include "analysis/structure/fractal_fit.hpp"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "analysis/structure/hypergeometric.hpp"

namespace isostat {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLowestDimension = 0.05, kHighestDimension = 2.95;
constexpr double kSameOptimum = 1e-3;  // of the standard errors: two starts ended at the same place
constexpr double kSameChi2 = 1e-6;     // relative to chi^2 (and absolute near a perfect fit)
constexpr double kWorstLogError = 1;   // a xi known to less than a factor e is not known
constexpr double kBeyondWindow = 30;   // xi outside [1/(30 k_max), 30/k_min] is not seen by the data

constexpr const char* kXiUnknown = "xi is not determined: its error exceeds its value";

constexpr int kMostSteps = 100, kMostRestarts = 10;  // of one descent; a good one needs about ten

// A model of the data in the fitted parameters p = (ln amplitude, d_F, ln xi, constant), the last one optional.
using Model = std::function<double(double x, const double* p)>;

// Distances that the window can tell: from 1/x_max to 1/x_min for wave numbers, x_min to x_max for distances.
struct Lengths {
  double low, high;
};

struct Problem {
  const Model& model;
  std::span<const double> x, y, sigma;
  Lengths lengths;
};

// A descent may look at a xi beyond the range that is reported as told, but not run away along the flat end of chi^2.
bool allowed(const double* p, const Lengths& lengths) {
  const double xi = std::exp(p[2]);
  return p[1] > kLowestDimension && p[1] < kHighestDimension && std::abs(p[0]) < 300 &&
         xi > lengths.low / (2 * kBeyondWindow) && xi < lengths.high * (2 * kBeyondWindow);
}

std::array<double, 4> parameters_of(const gsl_vector* at) {
  std::array<double, 4> p{};
  for (std::size_t n = 0; n < at->size; ++n) p[n] = gsl_vector_get(at, n);
  return p;
}

int residuals(const gsl_vector* at, void* data, gsl_vector* out) {
  const auto& problem = *static_cast<const Problem*>(data);
  const auto p = parameters_of(at);
  for (std::size_t i = 0; i < problem.x.size(); ++i) {
    double f = allowed(p.data(), problem.lengths)
                   ? (problem.model(problem.x[i], p.data()) - problem.y[i]) / problem.sigma[i]
                   : 1e150;
    if (!std::isfinite(f)) f = 1e150;  // a step that far out is refused by the trust region
    gsl_vector_set(out, i, f);
  }
  return GSL_SUCCESS;
}

// Exact for ln amplitude and constant; five-point differences (error h^4 and eps / h: 1e-12) for d_F and ln xi.
int jacobian(const gsl_vector* at, void* data, gsl_matrix* out) {
  constexpr double kStep = 1e-3;
  const auto& problem = *static_cast<const Problem*>(data);
  const auto p = parameters_of(at);
  const double constant = p[3];
  for (std::size_t i = 0; i < problem.x.size(); ++i) {
    const double w = 1 / problem.sigma[i];
    gsl_matrix_set(out, i, 0, w * (problem.model(problem.x[i], p.data()) - constant));
    for (const std::size_t n : {1u, 2u}) {
      const auto moved = [&](double steps) {
        auto q = p;
        q[n] += steps * kStep;
        return problem.model(problem.x[i], q.data());
      };
      gsl_matrix_set(out, i, n, w * (8 * (moved(1) - moved(-1)) - (moved(2) - moved(-2))) / (12 * kStep));
    }
    if (at->size > 3) gsl_matrix_set(out, i, 3, w);
  }
  return GSL_SUCCESS;
}

struct Optimum {
  std::vector<double> p;
  std::vector<double> covariance;  // row by row
  double chi2 = kNaN;
};

// One Levenberg-Marquardt descent, taken up again where it stalls. GSL's own verdict of convergence is not used:
// several starts and chi^2 decide.
Optimum descend(const Problem& problem, const std::vector<double>& start) {
  const std::size_t n = problem.x.size(), parameters = start.size();
  const gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  auto* work = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, n, parameters);
  gsl_multifit_nlinear_fdf fdf{};
  fdf.f = residuals, fdf.df = jacobian;
  fdf.n = n, fdf.p = parameters;
  fdf.params = const_cast<Problem*>(&problem);
  const auto from = gsl_vector_const_view_array(start.data(), parameters);
  Optimum out;
  if (gsl_multifit_nlinear_init(&from.vector, &fdf, work) == GSL_SUCCESS) {
    double before = std::numeric_limits<double>::infinity();
    for (int again = 0; again < kMostRestarts; ++again) {
      int info = 0;
      gsl_multifit_nlinear_driver(kMostSteps, 1e-10, 1e-14, 0, nullptr, nullptr, &info, work);
      out.p.assign(work->x->data, work->x->data + parameters);
      gsl_blas_ddot(work->f, work->f, &out.chi2);
      if (!(out.chi2 < before * (1 - kSameChi2))) break;
      before = out.chi2;
      const auto at = gsl_vector_const_view_array(out.p.data(), parameters);
      if (gsl_multifit_nlinear_init(&at.vector, &fdf, work) != GSL_SUCCESS) break;
    }
    auto* covariance = gsl_matrix_alloc(parameters, parameters);
    gsl_multifit_nlinear_covar(work->J, 0, covariance);
    for (std::size_t a = 0; a < parameters; ++a)
      for (std::size_t b = 0; b < parameters; ++b) out.covariance.push_back(gsl_matrix_get(covariance, a, b));
    gsl_matrix_free(covariance);
  }
  gsl_multifit_nlinear_free(work);
  return out;
}

// Amplitude and constant that fit best for a given shape (weighted linear least squares), the amplitude positive.
std::vector<double> start_at(const Problem& problem, double d_f, double log_xi, bool with_constant) {
  double sgg = 0, sg = 0, s1 = 0, sgy = 0, sy = 0;
  const double p[4] = {0, d_f, log_xi, 0};
  for (std::size_t i = 0; i < problem.x.size(); ++i) {
    const double w = 1 / (problem.sigma[i] * problem.sigma[i]), g = problem.model(problem.x[i], p), y = problem.y[i];
    sgg += w * g * g, sg += w * g, s1 += w, sgy += w * g * y, sy += w * y;
  }
  const double determinant = sgg * s1 - sg * sg;
  double amplitude = with_constant ? (sgy * s1 - sg * sy) / determinant : sgy / sgg, constant = 0;
  if (with_constant) constant = (sgg * sy - sg * sgy) / determinant;
  if (!(amplitude > 0)) amplitude = std::abs(sgy / sgg) + std::numeric_limits<double>::min(), constant = 0;
  std::vector<double> start{std::log(amplitude), d_f, log_xi};
  if (with_constant) start.push_back(constant);
  return start;
}

bool same_place(const Optimum& a, const Optimum& b) {
  for (std::size_t n = 0; n < a.p.size(); ++n) {
    const double sd = std::sqrt(b.covariance[n * b.p.size() + n]);
    if (!(std::abs(a.p[n] - b.p[n]) <= kSameOptimum * sd + 1e-9 * std::abs(b.p[n]))) return false;
  }
  return true;
}

using Starts = std::vector<std::vector<double>>;

Starts start_grid(const Problem& problem, const Lengths& lengths, bool with_constant) {
  constexpr int kLengthStarts = 4;
  Starts starts;
  for (const double d_f : {1.1, 1.5, 1.9})
    for (int n = 0; n < kLengthStarts; ++n)
      starts.push_back(start_at(
          problem, d_f, std::log(lengths.low) + std::log(lengths.high / lengths.low) * (n + 0.5) / kLengthStarts,
          with_constant));
  return starts;
}

FractalFit fit_from(const Starts& starts, const Problem& problem, const Lengths& lengths, bool with_constant) {
  FractalFit fit;
  fit.points = static_cast<int>(problem.x.size()), fit.parameters = with_constant ? 4 : 3;
  fit.d_f = fit.xi = fit.amplitude = fit.constant = fit.chi2 = kNaN;
  fit.error.fill(kNaN);
  for (auto& row : fit.correlation) row.fill(kNaN);
  if (fit.points <= fit.parameters) {
    fit.message = "fewer points in the window than parameters need";
    return fit;
  }
  fit.window = {problem.x.front(), problem.x.back()};
  auto* handler = gsl_set_error_handler_off();
  std::vector<Optimum> ends;
  for (const auto& start : starts) {
    auto end = descend(problem, start);
    ++fit.starts;
    if (std::isfinite(end.chi2) && end.chi2 < 1e200) ends.push_back(std::move(end));
  }
  gsl_set_error_handler(handler);
  if (ends.empty()) {
    fit.message = "no start gave a finite chi^2";
    return fit;
  }
  const auto best =
      *std::min_element(ends.begin(), ends.end(), [](const Optimum& a, const Optimum& b) { return a.chi2 < b.chi2; });
  bool rival = false;
  for (const auto& end : ends) {
    const bool here = same_place(end, best);
    fit.agreeing += here;
    rival |= !here && end.chi2 - best.chi2 < kSameChi2 * best.chi2;
  }
  const auto parameters = best.p.size();
  fit.amplitude = std::exp(best.p[0]), fit.d_f = best.p[1], fit.xi = std::exp(best.p[2]);
  fit.constant = with_constant ? best.p[3] : 0;
  fit.chi2 = best.chi2;
  // From (ln amplitude, d_F, ln xi, constant) to (d_F, xi, amplitude, constant).
  const std::array<std::size_t, 4> from{1, 2, 0, 3};
  const std::array<double, 4> scale{1, fit.xi, fit.amplitude, 1};
  const auto covariance = [&](std::size_t a, std::size_t b) { return best.covariance[from[a] * parameters + from[b]]; };
  for (std::size_t a = 0; a < parameters; ++a) {
    fit.error[a] = scale[a] * std::sqrt(covariance(a, a));
    for (std::size_t b = 0; b < parameters; ++b)
      fit.correlation[a][b] = covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
  }
  const double log_error = fit.error[1] / fit.xi;
  if (!(fit.xi > lengths.low / kBeyondWindow && fit.xi < lengths.high * kBeyondWindow))
    fit.message = "xi runs out of what the window can tell";
  else if (with_constant && !(log_error < kWorstLogError))
    fit.message = kXiUnknown;
  else if (fit.d_f <= kLowestDimension * 1.01 || fit.d_f >= kHighestDimension * 0.99)
    fit.message = "d_F runs to the edge of its range";
  else if (rival)
    fit.message = "several optima of the same chi^2";
  else if (starts.size() > 1 && fit.agreeing < 2)
    fit.message = "only one start reached the best chi^2";
  fit.identifiable = fit.message.empty();
  return fit;
}

double intensity_of_parameters(double k, const double* p) {
  return fractal_intensity(k, p[1], std::exp(p[2]), std::exp(p[0]), p[3]);
}

Lengths lengths_of_waves(std::span<const double> k) {
  return k.empty() ? Lengths{1, 1} : Lengths{1 / k.back(), 1 / k.front()};
}

}  // namespace

double fractal_intensity(double k, double d_f, double xi, double amplitude, double constant) {
  return constant + amplitude * std::tgamma(d_f) * std::pow(xi, d_f) * fractal_hypergeometric(d_f, xi * k);
}

double fractal_correlation(double r, double d_f, double xi, double amplitude) {
  return amplitude * std::pow(r, d_f - 2) * std::exp(-r / xi);
}

FractalFit fit_intensity(std::span<const double> k, std::span<const double> intensity, std::span<const double> sigma) {
  if (k.size() != intensity.size() || k.size() != sigma.size())
    throw std::invalid_argument("fit_intensity: as many intensities and sigmas as wave numbers");
  const Model model = intensity_of_parameters;
  const auto lengths = lengths_of_waves(k);
  const Problem problem{model, k, intensity, sigma, lengths};
  return fit_from(start_grid(problem, lengths, true), problem, lengths, true);
}

namespace {

struct ByModes {
  std::span<const double> k, intensity, modes;
  double floor() const {  // of a weight
    return intensity.empty() ? 0 : 1e-6 * *std::max_element(intensity.begin(), intensity.end());
  }
};

std::vector<double> parameters_of(const FractalFit& fit, bool with_constant) {
  std::vector<double> p{std::log(fit.amplitude), fit.d_f, std::log(fit.xi)};
  if (with_constant) p.push_back(fit.constant);
  return p;
}

// Weights of the best optimum and descents from it until both settle; false: they do not.
bool settle(const ByModes& data, const Problem& problem, const Lengths& lengths, bool with_constant,
            std::vector<double>& sigma, FractalFit& fit) {
  constexpr int kFreeRounds = 10, kMostRounds = 60;
  for (int round = 0; round < kMostRounds && std::isfinite(fit.chi2); ++round) {
    const double before_d = fit.d_f, before_xi = fit.xi;
    for (std::size_t i = 0; i < sigma.size(); ++i) {
      const double now =
          std::max(fractal_intensity(data.k[i], fit.d_f, fit.xi, fit.amplitude, fit.constant), data.floor()) /
          std::sqrt(data.modes[i]);
      sigma[i] = round < kFreeRounds ? now : std::sqrt(sigma[i] * now);  // ends a cycle between two fits
    }
    fit = fit_from({parameters_of(fit, with_constant)}, problem, lengths, with_constant);
    if (std::abs(fit.d_f - before_d) < kSameOptimum * fit.error[0] &&
        std::abs(fit.xi - before_xi) < kSameOptimum * fit.error[1])
      return true;
  }
  return false;
}

// All starts (or the one that is given), then settling, then all starts again.
FractalFit fit_by_modes(const ByModes& data, bool with_constant, const FractalFit* start) {
  if (data.k.size() != data.intensity.size() || data.k.size() != data.modes.size())
    throw std::invalid_argument("fit_intensity_by_modes: as many intensities and modes as wave numbers");
  const Model model = intensity_of_parameters;
  std::vector<double> sigma(data.k.size());
  for (std::size_t i = 0; i < sigma.size(); ++i)
    sigma[i] = std::max(data.intensity[i], data.floor()) / std::sqrt(data.modes[i]);
  const auto lengths = lengths_of_waves(data.k);
  const Problem problem{model, data.k, data.intensity, sigma, lengths};
  const auto starts = [&] {
    return start ? Starts{parameters_of(*start, with_constant)} : start_grid(problem, lengths, with_constant);
  };
  FractalFit fit = fit_from(starts(), problem, lengths, with_constant);
  if (settle(data, problem, lengths, with_constant, sigma, fit)) {
    if (!start) fit = fit_from(starts(), problem, lengths, with_constant);
  } else if (fit.message.empty()) {
    fit.identifiable = false, fit.message = "weights and fit do not settle";
  }
  fit.constant_held = !with_constant;
  if (!with_constant) {
    fit.error[3] = 0;
    if (fit.identifiable && !(fit.error[1] < kWorstLogError * fit.xi))
      fit.identifiable = false, fit.message = kXiUnknown;
  }
  return fit;
}

FractalFit fit_by_modes(const ByModes& data, FitConstant constant, const FractalFit* start) {
  FractalFit fit = fit_by_modes(data, constant != FitConstant::zero, start);
  if (constant == FitConstant::nonnegative && fit.constant < 0) fit = fit_by_modes(data, false, start);
  return fit;
}

}  // namespace

FractalFit fit_intensity_by_modes(std::span<const double> k, std::span<const double> intensity,
                                  std::span<const double> modes, FitConstant constant) {
  return fit_by_modes({k, intensity, modes}, constant, nullptr);
}

FractalFit refit_intensity_by_modes(std::span<const double> k, std::span<const double> intensity,
                                    std::span<const double> modes, FitConstant constant, const FractalFit& start) {
  return fit_by_modes({k, intensity, modes}, constant, &start);
}

namespace {

FractalFit fit_excess(std::span<const double> r, std::span<const double> excess, const FractalFit* start) {
  if (r.size() != excess.size()) throw std::invalid_argument("fit_correlation: as many values as distances");
  const Model model = [](double x, const double* p) {
    return fractal_correlation(x, p[1], std::exp(p[2]), std::exp(p[0]));
  };
  const std::vector<double> sigma(r.size(), 1.0);
  const Lengths lengths = r.empty() ? Lengths{1, 1} : Lengths{r.front(), r.back()};
  const Problem problem{model, r, excess, sigma, lengths};
  auto fit = fit_from(start ? Starts{parameters_of(*start, false)} : start_grid(problem, lengths, false), problem,
                      lengths, false);
  fit.constant_held = true;
  const double scatter = std::sqrt(fit.chi2_per_dof());
  for (std::size_t n = 0; n < 3; ++n) fit.error[n] *= scatter;
  fit.error[3] = 0;
  if (fit.identifiable && !(fit.error[1] < kWorstLogError * fit.xi)) fit.identifiable = false, fit.message = kXiUnknown;
  return fit;
}

}  // namespace

FractalFit fit_correlation(std::span<const double> r, std::span<const double> excess) {
  return fit_excess(r, excess, nullptr);
}

FractalFit refit_correlation(std::span<const double> r, std::span<const double> excess, const FractalFit& start) {
  return fit_excess(r, excess, &start);
}

}  // namespace isostat
