#include "analysis/structure/correlation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/structure/closed_terms.hpp"
#include "geometry/disk_transform.hpp"
#include "geometry/gauss_legendre.hpp"
#include "geometry/pores.hpp"

namespace isostat {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDefaultCut = 100;           // [1/diameter]
constexpr double kMostModes = 1200.0 * 1200;  // product of the mode numbers along x and y up to the cut
constexpr double kShellPhase = 0.1;           // [rad] phase k r across one shell of modes at the largest r
constexpr int kTransformWidth = 9;
constexpr double kNearGap = 10;       // [1/k_cut] pairs up to this gap are split off
constexpr double kDeepOverlap = 0.3;  // [1/k_cut] deeper overlaps end the k^-7/2 tail of contacts near the cut: Porod
constexpr double kMassStep = 0.1;     // [diameter] between the Gauss rules of the mass integral

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
  ClosedTerms closed(disk_complex(centre, radius, cell, kNearGap / out.k_cut), radius, kDeepOverlap / out.k_cut,
                     out.r.back());
  closed.tabulate(out.k_cut);
  Shells shells(out.k_cut, kShellPhase / std::max(out.r.back(), kShellPhase / out.k_cut));
  for (std::int64_t mx = 0; mx <= t.mx_max; ++mx)
    for (std::int64_t my = -t.my_max; my <= t.my_max; ++my) {
      const double k2 = t.k2(mx, my);
      if (k2 > out.k_cut * out.k_cut) continue;
      const double k = std::sqrt(k2);
      shells.add(k, (mx == 0 ? 1 : 2) * (std::norm(t.at(mx, my)) - closed.spectrum(k)) / (area * area));
    }
  out.solid_fraction = t.at(0, 0).real() / area;

  double walls = find_pores(centre, radius, cell).perimeter + closed.walls_within();
  for (const double R : radius) walls -= 2 * kPi * R;
  PorodTail tail(walls / (kPi * area), out.k_cut);
  const double diameter = 2 * *std::max_element(radius.begin(), radius.end());
  const auto rule = gauss_legendre(4);
  double closed_mass = 0, reached = 0;
  for (const double x : out.r) {
    tail.advance(x);
    const auto [rest, rest_mass] = shells.sums(x);
    while (reached < std::min(x, closed.reach())) {  // integral of 2 pi r times the closed terms over the step
      const double half = 0.5 * std::min(diameter * kMassStep, std::min(x, closed.reach()) - reached);
      for (std::size_t n = 0; n < rule.node.size(); ++n) {
        const double y = reached + half * (1 + rule.node[n]);
        closed_mass += half * rule.weight[n] * 2 * kPi * y * closed.overlap(y) / area;
      }
      reached += 2 * half;
    }
    out.c.push_back(closed.overlap(x) / area + rest + tail.value());
    out.mass.push_back((closed_mass + rest_mass + tail.mass()) / out.solid_fraction);
  }
  return out;
}

}  // namespace isostat
