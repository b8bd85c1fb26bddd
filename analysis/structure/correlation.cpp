#include "analysis/structure/correlation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/disk_transform.hpp"
#include "geometry/gauss_legendre.hpp"
#include "geometry/pores.hpp"

namespace isostat {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDefaultCut = 100;           // [1/diameter]
constexpr double kMostModes = 1200.0 * 1200;  // product of the mode numbers along x and y up to the cut
constexpr double kShellPhase = 0.1;           // [rad] phase k r across one shell of modes at the largest r
constexpr int kTransformWidth = 8;            // the transform's error, 1e-6 of it, is below the truncation

// Area common to a disk of radius R and itself moved by r: the autocorrelation of one disk.
double self_overlap(double radius, double r) {
  const double x = r / (2 * radius);
  return x >= 1 ? 0 : 2 * radius * radius * (std::acos(x) - x * std::sqrt((1 - x) * (1 + x)));
}

double sum_of_self_overlaps(std::span<const double> radius, double r) {
  double sum = 0;
  for (const double R : radius) sum += self_overlap(R, r);
  return sum;
}

// Sum over disks of the squared form factor (2 pi R J1(kR)/k)^2 as piecewise polynomials in k.
class FormFactors {
 public:
  FormFactors(std::span<const double> radius, double k_max) {
    const double largest = *std::max_element(radius.begin(), radius.end());
    pieces_ = static_cast<int>(std::ceil(k_max * largest)) + 1;  // phase 2 k R of the square: 2 radians a piece
    step_ = k_max / (pieces_ - 1);
    value_.resize(static_cast<std::size_t>(pieces_ * kNodes));
    for (int p = 0; p < pieces_; ++p)
      for (int j = 0; j < kNodes; ++j) {
        const double k = step_ * (p + 0.5 * (1 + node(j)));
        double sum = 0;
        for (const double R : radius) {
          const double f = k > 0 ? 2 * kPi * R * ::j1(k * R) / k : kPi * R * R;
          sum += f * f;
        }
        value_[static_cast<std::size_t>(p * kNodes + j)] = sum;
      }
    for (int j = 0; j < kNodes; ++j)
      barycentric_[static_cast<std::size_t>(j)] = (j % 2 ? -1 : 1) * std::sin(kPi * (j + 0.5) / kNodes);
  }
  double operator()(double k) const {
    const int p = std::min(pieces_ - 1, static_cast<int>(k / step_));
    const double t = 2 * (k / step_ - p) - 1;
    double top = 0, bottom = 0;
    for (int j = 0; j < kNodes; ++j) {
      const double off = t - node(j), f = value_[static_cast<std::size_t>(p * kNodes + j)];
      if (off == 0) return f;
      const double w = barycentric_[static_cast<std::size_t>(j)] / off;
      top += w * f, bottom += w;
    }
    return top / bottom;
  }

 private:
  static constexpr int kNodes = 12;
  static double node(int j) {
    static const auto nodes = [] {
      std::array<double, kNodes> x{};
      for (int i = 0; i < kNodes; ++i) x[static_cast<std::size_t>(i)] = std::cos(kPi * (i + 0.5) / kNodes);
      return x;
    }();
    return nodes[static_cast<std::size_t>(j)];
  }
  int pieces_;
  double step_;
  std::vector<double> value_;
  std::array<double, kNodes> barycentric_{};
};

// Modes gathered in shells of equal width: a mode is shared among the four nearest shells by cubic interpolation, so
// that sums of smooth functions of k are kept to fourth order in the width.
class Shells {
 public:
  Shells(double k_max, double width) : width_(width), weight_(static_cast<std::size_t>(k_max / width) + 5, 0.0) {}
  void add(double k, double amount) {
    const double u = k / width_;
    const auto base = std::max(1.0, std::floor(u));
    const double t = u - base;  // nodes at -1, 0, 1, 2
    const auto n = static_cast<std::size_t>(base);
    weight_[n - 1] -= amount * t * (t - 1) * (t - 2) / 6;
    weight_[n] += amount * (t + 1) * (t - 1) * (t - 2) / 2;
    weight_[n + 1] -= amount * (t + 1) * t * (t - 2) / 2;
    weight_[n + 2] += amount * (t + 1) * t * (t - 1) / 6;
  }
  // Sums over modes of J0(kr), and of 2 pi r J1(kr)/k, its integral over the disk of radius r.
  std::pair<double, double> sums(double r) const {
    double c = 0, m = weight_[0] * kPi * r * r;
    for (std::size_t n = weight_.size(); n-- > 1;) {
      if (weight_[n] == 0) continue;
      const double k = width_ * static_cast<double>(n);
      c += weight_[n] * ::j0(k * r);
      m += weight_[n] * 2 * kPi * r * ::j1(k * r) / k;
    }
    return {c + weight_[0], m};
  }

 private:
  double width_;
  std::vector<double> weight_;
};

// What the sum over modes leaves out where disks overlap: Porod's tail of the missing wall, I = 2 (P - P_disks)/(A k^3)
// on average, integrated from the cut on: (P - P_disks)/(pi A) T(r) with T = int_kc^inf J0(kr)/k^2 dk. By parts
// T = J0(x)/kc - r (1 + J1(x) - int_0^x J0), x = kc r. Marches along increasing r.
class PorodTail {
 public:
  PorodTail(double amplitude, double k_cut) : amplitude_(amplitude), k_cut_(k_cut), value_(amplitude / k_cut) {}
  void advance(double r) {
    const int steps = 1 + static_cast<int>(k_cut_ * (r - r_) / kPhaseStep);
    const double h = (r - r_) / steps;
    for (int n = 0; n < steps && h > 0; ++n) {
      const double x0 = k_cut_ * r_, x1 = k_cut_ * (r_ + h), before = 2 * kPi * r_ * value_;
      integral_ += (x1 - x0) / 6 * (::j0(x0) + 4 * ::j0(0.5 * (x0 + x1)) + ::j0(x1));
      r_ += h;
      value_ = amplitude_ * (::j0(x1) / k_cut_ - r_ * (1 + ::j1(x1) - integral_));
      mass_ += 0.5 * h * (before + 2 * kPi * r_ * value_);
    }
  }
  double value() const { return value_; }
  double mass() const { return mass_; }

 private:
  static constexpr double kPhaseStep = 0.25;  // Simpson's rule is then good to 1e-7
  double amplitude_, k_cut_, value_, r_ = 0, integral_ = 0, mass_ = 0;
};

double default_cut(std::span<const double> radius, const PeriodicCell<2>& cell) {
  const double wanted = kDefaultCut / (2 * *std::max_element(radius.begin(), radius.end()));
  const double modes = cell.measure() * wanted * wanted / (4 * kPi * kPi);
  return modes > kMostModes ? wanted * std::sqrt(kMostModes / modes) : wanted;
}

}  // namespace

CorrelationCurve density_correlation(std::span<const Vec2> centre, std::span<const double> radius,
                                     const PeriodicCell<2>& cell, std::vector<double> r, double k_cut) {
  CorrelationCurve out;
  out.r = std::move(r);
  out.k_cut = k_cut > 0 ? k_cut : default_cut(radius, cell);
  const double area = cell.measure();
  const auto t = disk_transform(centre, radius, cell, {.k_max = out.k_cut, .kernel_width = kTransformWidth});
  const FormFactors self(radius, out.k_cut);
  Shells shells(out.k_cut, kShellPhase / std::max(out.r.back(), kShellPhase / out.k_cut));
  for (std::int64_t mx = 0; mx <= t.mx_max; ++mx)
    for (std::int64_t my = -t.my_max; my <= t.my_max; ++my) {
      const double k2 = t.k2(mx, my);
      if (k2 > out.k_cut * out.k_cut) continue;
      const double k = std::sqrt(k2);
      shells.add(k, (mx == 0 ? 1 : 2) * (std::norm(t.at(mx, my)) - self(k)) / (area * area));
    }
  out.solid_fraction = t.at(0, 0).real() / area;

  const double diameter = 2 * *std::max_element(radius.begin(), radius.end());
  const auto rule = gauss_legendre(12);
  double self_mass = 0, reached = 0, walls = find_pores(centre, radius, cell).perimeter;
  for (const double R : radius) walls -= 2 * kPi * R;
  PorodTail tail(walls / (kPi * area), out.k_cut);
  for (const double x : out.r) {
    tail.advance(x);
    const auto [cross, cross_mass] = shells.sums(x);
    const double end = std::min(x, diameter);
    if (end > reached) {  // integral of 2 pi r C_self over the step
      const double half = 0.5 * (end - reached);
      for (std::size_t n = 0; n < rule.node.size(); ++n) {
        const double y = reached + half * (1 + rule.node[n]);
        self_mass += half * rule.weight[n] * 2 * kPi * y * sum_of_self_overlaps(radius, y) / area;
      }
      reached = end;
    }
    out.c.push_back(sum_of_self_overlaps(radius, x) / area + cross + tail.value());
    out.mass.push_back((self_mass + cross_mass + tail.mass()) / out.solid_fraction);
  }
  return out;
}

}  // namespace isostat
