#include "analysis/structure/closed_terms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "analysis/structure/mean_overlap.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

constexpr double kPi = std::numbers::pi;

// Length of the circles of two overlapping disks that lies inside the other one.
double hidden_length(double r, double q, double d) {
  if (d >= r + q || d <= std::abs(r - q)) return 0;
  const double kite = std::sqrt((r + q - d) * (r + q + d) * (d - (r - q)) * (d + (r - q)));
  return 2 * (r * std::atan2(kite, d * d + (r - q) * (r + q)) + q * std::atan2(kite, d * d - (r - q) * (r + q)));
}

}  // namespace

ClosedTerms::ClosedTerms(const DiskComplex& c, std::span<const double> radius, double deepest, double r_max)
    : radius_(radius.begin(), radius.end()) {
  const Vec2& length = c.cell.length;
  const Vec2 spacing = c.cell.spacing();
  const double shorter = std::min(length[0], length[1]);
  const double largest = *std::max_element(radius_.begin(), radius_.end());
  reach_ = 2 * largest;
  const auto& t = c.triangulation;
  for (std::size_t i = 0; i < c.size(); ++i)
    for (auto slot = t.first[i]; slot < t.first[i + 1]; ++slot) {
      const auto n = idx(slot);
      const auto& to = t.neighbour[n];
      if (c.edge[n] == EdgeState::open || idx(to.site) <= i) continue;
      const auto j = idx(to.site);
      const double d = norm(c.branch[n]), sum = c.radius[i] + c.radius[j];
      if (sum - d > deepest || d <= std::abs(c.radius[i] - c.radius[j]) || r_max + d + sum >= shorter) continue;
      pair_.push_back({idx(c.input[i]), idx(c.input[j]), d});
      reach_ = std::max(reach_, d + sum);
      walls_ += hidden_length(c.radius[i], c.radius[j], d);
    }
  const double far = r_max + 2 * largest;
  const auto cells = [&](int axis) { return static_cast<int>(far / spacing[axis]); };
  for (int x = -cells(0); x <= cells(0); ++x)
    for (int y = -cells(1); y <= cells(1); ++y)
      if (const double d = norm(c.cell.offset({x, y})); d > 0 && d < far) image_.push_back(d);
}

double ClosedTerms::overlap(double r) const {
  double sum = 0;
  for (const double R : radius_) {
    sum += lens_area(R, R, r);
    for (const double d : image_)
      if (std::abs(d - r) < 2 * R) sum += mean_overlap(R, R, d, r);
  }
  for (const auto& p : pair_) sum += 2 * mean_overlap(radius_[p.i], radius_[p.j], p.distance, r);
  return sum;
}

void ClosedTerms::tabulate(double k_max) {
  pieces_ = static_cast<int>(std::ceil(k_max * reach_ / kPhase)) + 1;
  step_ = k_max / (pieces_ - 1);
  value_.assign(idx(pieces_ * kNodes), 0);
  std::vector<double> form(radius_.size());
  for (int n = 0; n < pieces_ * kNodes; ++n) {
    const double k = step_ * (n / kNodes + 0.5 * (1 + std::cos(kPi * (n % kNodes + 0.5) / kNodes)));
    double sum = 0;
    for (std::size_t i = 0; i < form.size(); ++i) {
      form[i] = 2 * kPi * radius_[i] * ::j1(k * radius_[i]) / k;  // no node lies at k = 0
      sum += form[i] * form[i];
    }
    for (const auto& p : pair_) sum += 2 * form[p.i] * form[p.j] * ::j0(k * p.distance);
    value_[idx(n)] = sum;
  }
}

double ClosedTerms::spectrum(double k) const {
  static const auto nodes = [] {
    std::array<std::array<double, kNodes>, 2> x{};  // Chebyshev points and their barycentric weights
    for (std::size_t j = 0; j < kNodes; ++j) {
      const double angle = kPi * (static_cast<double>(j) + 0.5) / kNodes;
      x[0][j] = std::cos(angle), x[1][j] = (j % 2 ? -1 : 1) * std::sin(angle);
    }
    return x;
  }();
  const int p = std::min(pieces_ - 1, static_cast<int>(k / step_));
  const double t = 2 * (k / step_ - p) - 1;
  double top = 0, bottom = 0;
  for (std::size_t j = 0; j < kNodes; ++j) {
    const double off = t - nodes[0][j], f = value_[idx(p * kNodes) + j];
    if (off == 0) return f;
    const double w = nodes[1][j] / off;
    top += w * f, bottom += w;
  }
  return top / bottom;
}

}  // namespace isostat
