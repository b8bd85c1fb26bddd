#include "geometry/smoothed_disk.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/gauss_legendre.hpp"

namespace isostat {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPieceInSteps = 0.75;  // length of a polynomial piece in grid steps: degree 8 is then good to 1e-11
constexpr int kRadiusNodes = 16;        // Chebyshev terms in the radius, before the negligible ones are dropped
constexpr int kTransformTerms = 32;     // Chebyshev terms of log psi_hat in k^2

// Chebyshev coefficients of samples f(cos(pi (j + 1/2) / n)).
std::vector<double> chebyshev_coefficients(const std::vector<double>& f) {
  const auto n = f.size();
  std::vector<double> c(n, 0);
  for (std::size_t m = 0; m < n; ++m) {
    for (std::size_t j = 0; j < n; ++j)
      c[m] += f[j] * std::cos(kPi * static_cast<double>(m) * (static_cast<double>(j) + 0.5) / static_cast<double>(n));
    c[m] *= (m == 0 ? 1.0 : 2.0) / static_cast<double>(n);
  }
  return c;
}

double chebyshev_node(int j, int n) { return std::cos(kPi * (j + 0.5) / n); }

// From Chebyshev to power coefficients on [-1, 1].
template <std::size_t N>
std::array<double, N> powers(const std::vector<double>& c) {
  std::array<double, N> out{}, t0{}, t1{};
  t0[0] = 1, t1[1] = 1;
  for (std::size_t m = 0; m < N; ++m) {
    for (std::size_t p = 0; p < N; ++p) out[p] += c[m] * t0[p];
    std::array<double, N> t2{};
    for (std::size_t p = 0; p < N; ++p) t2[p] = (p > 0 ? 2 * t1[p - 1] : 0) - t0[p];
    t0 = t1, t1 = t2;
  }
  return out;
}

}  // namespace

RadialKernel::RadialKernel(double support, double beta, double k_max)
    : support_(support), beta_(beta), k_max2_(k_max * k_max) {
  // r = a sin u makes the integrand smooth: psi = exp(beta (cos u - 1)), r dr = a^2 sin u cos u du.
  const auto q = gauss_legendre(48);
  for (std::size_t i = 0; i < q.node.size(); ++i) {
    const double u = kPi / 4 * (q.node[i] + 1);
    node_.push_back(support * std::sin(u));
    weight_.push_back(2 * kPi * kPi / 4 * q.weight[i] * std::exp(beta * (std::cos(u) - 1)) * support * support *
                      std::sin(u) * std::cos(u));
  }
  std::vector<double> samples;
  for (int j = 0; j < kTransformTerms; ++j)
    samples.push_back(-std::log(transform(std::sqrt(k_max2_ * 0.5 * (1 + chebyshev_node(j, kTransformTerms))))));
  log_inverse_ = chebyshev_coefficients(samples);
}

double RadialKernel::transform(double k) const {
  double sum = 0;
  for (std::size_t i = 0; i < node_.size(); ++i) sum += weight_[i] * ::j0(k * node_[i]);
  return sum;
}

double RadialKernel::inverse_transform(double k2) const {
  const double t = 2 * k2 / k_max2_ - 1;
  double b1 = 0, b2 = 0;
  for (auto m = log_inverse_.size() - 1; m > 0; --m) {
    const double b = 2 * t * b1 - b2 + log_inverse_[m];
    b2 = b1, b1 = b;
  }
  return std::exp(t * b1 - b2 + log_inverse_[0]);
}

SmoothedDiskTable::SmoothedDiskTable(const RadialKernel& kernel, double radius_min, double radius_max, double grid_step)
    : radius_min_(radius_min), radius_max_(radius_max), support_(kernel.support()) {
  const double reach = radius_max + support_;
  pieces_ = static_cast<int>(std::ceil(reach / (kPieceInSteps * grid_step))) + 1;
  step_ = reach / (pieces_ - 1);
  // F(r; R) = R int psi_hat(k) J1(kR) J0(kr) dk (for a point: int psi_hat J0(kr) k dk / 2 pi); beyond the cut-off
  // psi_hat is exp(-beta) of its peak.
  const double cut = 1.15 * kernel.beta() / support_;
  const auto q = gauss_legendre(40 + static_cast<int>(0.6 * cut * (2 * radius_max + support_)));
  const std::size_t modes = q.node.size();
  std::vector<double> k(modes), amplitude(modes);
  for (std::size_t i = 0; i < modes; ++i) {
    k[i] = 0.5 * cut * (q.node[i] + 1);
    amplitude[i] = 0.5 * cut * q.weight[i] * kernel.transform(k[i]);
  }
  const bool point = radius_max == 0;
  const int radii = radius_max > radius_min ? kRadiusNodes : 1;
  std::vector<std::vector<double>> source(static_cast<std::size_t>(radii), std::vector<double>(modes));
  for (int m = 0; m < radii; ++m) {
    const double radius =
        0.5 * (radius_min + radius_max) + 0.5 * (radius_max - radius_min) * (radii > 1 ? chebyshev_node(m, radii) : 0);
    for (std::size_t i = 0; i < modes; ++i)
      source[static_cast<std::size_t>(m)][i] = amplitude[i] * (point ? k[i] / (2 * kPi) : radius * ::j1(k[i] * radius));
  }
  const auto size = static_cast<std::size_t>(pieces_) * kTerms;
  chebyshev_.assign(static_cast<std::size_t>(radii), std::vector<double>(size));
  std::vector<double> wave(modes), value(static_cast<std::size_t>(kTerms));
  std::vector<std::vector<double>> samples(static_cast<std::size_t>(radii),
                                           std::vector<double>(static_cast<std::size_t>(kTerms)));
  for (int s = 0; s < pieces_; ++s) {
    for (int j = 0; j < kTerms; ++j) {
      const double r = step_ * (s + 0.5 * (1 + chebyshev_node(j, kTerms)));
      for (std::size_t i = 0; i < modes; ++i) wave[i] = ::j0(k[i] * r);
      for (std::size_t m = 0; m < samples.size(); ++m) {
        double sum = 0;
        for (std::size_t i = 0; i < modes; ++i) sum += wave[i] * source[m][i];
        samples[m][static_cast<std::size_t>(j)] = sum;
      }
    }
    std::vector<std::array<double, kTerms>> coefficient;
    for (const auto& f : samples) coefficient.push_back(powers<kTerms>(chebyshev_coefficients(f)));
    for (int p = 0; p < kTerms; ++p) {
      std::vector<double> over_radius;
      for (const auto& c : coefficient) over_radius.push_back(c[static_cast<std::size_t>(p)]);
      over_radius = chebyshev_coefficients(over_radius);
      for (std::size_t m = 0; m < over_radius.size(); ++m)
        chebyshev_[m][static_cast<std::size_t>(s) * kTerms + static_cast<std::size_t>(p)] = over_radius[m];
    }
  }
  const auto largest = [](const std::vector<double>& v) {
    double most = 0;
    for (const double x : v) most = std::max(most, std::abs(x));
    return most;
  };
  const double scale = largest(chebyshev_[0]);
  while (chebyshev_.size() > 1 && largest(chebyshev_.back()) < 1e-12 * scale) chebyshev_.pop_back();
}

void SmoothedDiskTable::set_profile(double radius, Profile& profile) const {
  profile.reach_ = radius + support_;
  profile.inverse_step_ = 1 / step_;
  const auto size = (static_cast<std::size_t>(profile.reach_ / step_) + 1) * kTerms;
  profile.piece_.assign(chebyshev_[0].begin(), chebyshev_[0].begin() + static_cast<std::ptrdiff_t>(size));
  if (chebyshev_.size() == 1) return;
  const double t = (2 * radius - radius_min_ - radius_max_) / (radius_max_ - radius_min_);
  double t0 = 1, t1 = t;
  for (std::size_t m = 1; m < chebyshev_.size(); ++m) {
    const double* c = chebyshev_[m].data();
    for (std::size_t n = 0; n < size; ++n) profile.piece_[n] += t1 * c[n];
    const double t2 = 2 * t * t1 - t0;
    t0 = t1, t1 = t2;
  }
}

}  // namespace isostat
