#include "analysis/structure/intensity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace isostat {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Sums {
  double k = 0, intensity = 0, squares = 0;  // squares about `about`, the bin's running mean (Welford)
  std::int64_t n = 0;
  void add(double wave, double value) {
    ++n;
    const double off = value - intensity;
    k += (wave - k) / static_cast<double>(n);
    intensity += off / static_cast<double>(n);
    squares += off * (value - intensity);
  }
};

IntensityCurve curve_of(std::vector<double> edges, const std::vector<Sums>& sums) {
  IntensityCurve c;
  c.k_edges = std::move(edges);
  for (const auto& s : sums) {
    const auto n = static_cast<double>(s.n);
    c.modes.push_back(s.n);
    c.k.push_back(s.n > 0 ? s.k : kNaN);
    c.intensity.push_back(s.n > 0 ? s.intensity : kNaN);
    c.sigma.push_back(s.n > 1 ? std::sqrt(s.squares) / n : kNaN);
  }
  return c;
}

}  // namespace

std::vector<double> anchored_edges(double k_min, double k_max) {
  if (!(k_min > 0 && k_max > k_min)) throw std::invalid_argument("anchored_edges: 0 < k_min < k_max");
  std::vector<double> edges;
  for (int n = 0; edges.empty() || edges.back() > k_min; ++n)
    edges.push_back(k_max * std::pow(10.0, -n / double(kBinsPerDecade)));
  std::reverse(edges.begin(), edges.end());
  return edges;
}

IntensityCurve average_intensity(const DiskTransform& t, std::vector<double> k_edges) {
  std::vector<Sums> sums(k_edges.size() - 1);
  const double area = t.cell.measure(), low = k_edges.front() * k_edges.front(), high = k_edges.back() * k_edges.back();
  for (std::int64_t mx = 0; mx <= t.mx_max; ++mx)
    for (std::int64_t my = mx == 0 ? 1 : -t.my_max; my <= t.my_max; ++my) {  // half of the lattice
      const double k2 = t.k2(mx, my);
      if (k2 < low * (1 - 1e-12) || k2 > high) continue;
      const double k = std::sqrt(k2);
      if (k < k_edges.front() || k >= k_edges.back() || k > t.k_max) continue;
      const auto bin =
          static_cast<std::size_t>(std::upper_bound(k_edges.begin(), k_edges.end(), k) - k_edges.begin()) - 1;
      sums[bin].add(k, std::norm(t.at(mx, my)) / area);
    }
  return curve_of(std::move(k_edges), sums);
}

IntensityCurve pooled_intensity(std::span<const IntensityCurve> curves) {
  if (curves.empty()) throw std::invalid_argument("pooled_intensity: no curve");
  std::vector<Sums> sums(curves.front().modes.size());
  for (const auto& c : curves) {
    if (c.k_edges != curves.front().k_edges) throw std::invalid_argument("pooled_intensity: the curves' edges differ");
    for (std::size_t b = 0; b < sums.size(); ++b) {
      if (c.modes[b] == 0) continue;
      auto& s = sums[b];  // Chan's merge of two samples
      const auto m = static_cast<double>(c.modes[b]), n = static_cast<double>(s.n), total = m + n;
      const double off = c.intensity[b] - s.intensity;
      const double own = c.modes[b] > 1 ? c.sigma[b] * c.sigma[b] * m * m : 0;
      s.squares += own + off * off * m * n / total;
      s.intensity += off * m / total, s.k += (c.k[b] - s.k) * m / total;
      s.n += c.modes[b];
    }
  }
  return curve_of(curves.front().k_edges, sums);
}

namespace {

struct Bins {
  std::vector<double> k, intensity, modes;
};

Bins bins_in(const IntensityCurve& c, double k_low, double k_high) {
  Bins in;
  for (std::size_t b = 0; b < c.modes.size(); ++b) {
    if (c.modes[b] == 0 || c.k[b] < k_low || c.k[b] > k_high) continue;
    in.k.push_back(c.k[b]), in.intensity.push_back(c.intensity[b]);
    in.modes.push_back(static_cast<double>(c.modes[b]));
  }
  return in;
}

}  // namespace

FractalFit fit_curve(const IntensityCurve& c, double k_low, double k_high, FitConstant constant) {
  const Bins in = bins_in(c, k_low, k_high);
  return fit_intensity_by_modes(in.k, in.intensity, in.modes, constant);
}

FractalFit refit_curve(const IntensityCurve& c, double k_low, double k_high, FitConstant constant,
                       const FractalFit& start) {
  const Bins in = bins_in(c, k_low, k_high);
  return refit_intensity_by_modes(in.k, in.intensity, in.modes, constant, start);
}

PowerFit fit_curve_power(const IntensityCurve& c, double k_low, double k_high) {
  const Bins in = bins_in(c, k_low, k_high);
  return fit_power(in.k, in.intensity, in.modes, k_low, k_high);
}

}  // namespace isostat
