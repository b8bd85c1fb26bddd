#include "analysis/stiffness/kernel_polynomial.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

constexpr std::size_t kLanczosSteps = 100;
constexpr double kMargin = 0.01;  // of the width: what a hundred steps may not have seen of a thin tail
constexpr double kGrowth = 1e-6;  // of |r|^2: beyond what rounding adds

constexpr std::size_t kLanes = 4;  // vectors that share one pass through the matrix
using Lanes = std::array<double, kLanes>;

// 2 x(A).
SymmetricMatrix twice_mapped(SymmetricMatrix a, const SpectrumBounds& bounds) {
  const double factor = 4 / (bounds.high - bounds.low),
               shift = 2 * (bounds.high + bounds.low) / (bounds.high - bounds.low);
  for (double& v : a.value) v *= factor;
  for (std::size_t c = 0; c < idx(a.size); ++c) a.value[idx(a.start[c])] -= shift;  // the diagonal stands first
  return a;
}

struct Products {
  Lanes own{}, other{};  // y.y and x.y
};

// y += sign A x. Rows below the diagonal go on being added to; a row is complete once its column is done.
Products add_product(const SymmetricMatrix& a, double sign, const std::vector<Lanes>& x, std::vector<Lanes>& y) {
  Products p;
  for (std::size_t c = 0; c < x.size(); ++c) {
    const Lanes& here = x[c];
    auto e = idx(a.start[c]);
    const auto end = idx(a.start[c + 1]);
    Lanes sum{};
    for (std::size_t l = 0; l < kLanes; ++l) sum[l] = a.value[e] * here[l];
    for (++e; e < end; ++e) {
      const double v = a.value[e], w = sign * v;
      const Lanes& there = x[idx(a.row[e])];
      Lanes& below = y[idx(a.row[e])];
      for (std::size_t l = 0; l < kLanes; ++l) sum[l] += v * there[l], below[l] += w * here[l];
    }
    Lanes& own = y[c];
    for (std::size_t l = 0; l < kLanes; ++l) {
      own[l] += sign * sum[l];
      p.own[l] += own[l] * own[l], p.other[l] += here[l] * own[l];
    }
  }
  return p;
}

// Without a diagonal entry a column has none at its start: a body that touches nothing.
SymmetricMatrix with_diagonal(const SymmetricMatrix& a) {
  SymmetricMatrix full;
  full.size = a.size, full.start.push_back(0);
  full.row.reserve(a.row.size()), full.value.reserve(a.value.size());
  for (std::int32_t c = 0; c < a.size; ++c) {
    auto e = idx(a.start[idx(c)]);
    const auto end = idx(a.start[idx(c) + 1]);
    if (e == end || a.row[e] != c) full.row.push_back(c), full.value.push_back(0);
    for (; e < end; ++e) full.row.push_back(a.row[e]), full.value.push_back(a.value[e]);
    full.start.push_back(static_cast<std::int32_t>(full.row.size()));
  }
  return full;
}

// W Eq. 71.
std::vector<double> jackson(std::size_t count) {
  const auto n = static_cast<double>(count);
  const double step = std::numbers::pi / (n + 1);
  std::vector<double> g(count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto m = static_cast<double>(k);
    g[k] = ((n - m + 1) * std::cos(m * step) + std::sin(m * step) / std::tan(step)) / (n + 1);
  }
  return g;
}

}  // namespace

double random_sign(std::size_t vector, std::size_t component) {
  std::uint64_t x = (static_cast<std::uint64_t>(vector) << 40) + static_cast<std::uint64_t>(component);
  x += 0x9e3779b97f4a7c15;  // SplitMix64
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return (x ^ (x >> 31)) >> 63 ? 1.0 : -1.0;
}

SpectrumBounds spectrum_bounds(const SymmetricMatrix& a, bool definite) {
  const auto n = idx(a.size);
  const double norm = a.maximum_norm();
  if (!(norm > 0)) return {};
  // Plain Lanczos: eigenvalues found twice do no harm to the ends.
  std::vector<double> v(n), before(n, 0.0), alpha, beta;
  for (std::size_t i = 0; i < n; ++i) v[i] = random_sign(0, i) / std::sqrt(static_cast<double>(n));
  double last = 0;
  for (std::size_t step = 0; step < std::min(kLanczosSteps, n); ++step) {
    std::vector<double> w = a.multiply(v);
    alpha.push_back(std::inner_product(w.begin(), w.end(), v.begin(), 0.0));
    for (std::size_t i = 0; i < n; ++i) w[i] -= alpha.back() * v[i] + last * before[i];
    last = std::sqrt(std::inner_product(w.begin(), w.end(), w.begin(), 0.0));
    if (!(last > 1e-14 * norm)) break;
    beta.push_back(last);
    before.swap(v);
    for (std::size_t i = 0; i < n; ++i) v[i] = w[i] / last;
  }
  const auto steps = static_cast<Eigen::Index>(alpha.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
  ritz.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(alpha.data(), steps),
                              Eigen::Map<const Eigen::VectorXd>(beta.data(), steps - 1));
  const auto residual = [&](Eigen::Index k) {
    return beta.size() == alpha.size() ? beta.back() * std::abs(ritz.eigenvectors()(steps - 1, k)) : 0.0;
  };
  const double lowest = definite ? 0 : std::min(ritz.eigenvalues()[0] - residual(0), 0.0),
               highest = std::max(ritz.eigenvalues()[steps - 1] + residual(steps - 1), 0.0);
  const double margin = kMargin * (highest - lowest);
  return {definite ? 0 : std::max(lowest - margin, -norm), std::min(highest + margin, norm)};
}

std::optional<std::vector<std::vector<double>>> chebyshev_moments(const SymmetricMatrix& a,
                                                                  const SpectrumBounds& bounds, std::size_t count,
                                                                  std::size_t vectors, const Start& start) {
  const SymmetricMatrix twice_x = twice_mapped(with_diagonal(a), bounds);
  std::vector<std::vector<double>> moments(vectors, std::vector<double>(count));
  for (std::size_t first = 0; first < vectors; first += kLanes) {
    const std::size_t lanes = std::min(kLanes, vectors - first);
    // With signs + + - - + + ... before the T_n(x) r, their recurrence only adds: T_n+1 = 2 x T_n - T_n-1.
    std::vector<Lanes> x(idx(a.size)), y(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t l = 0; l < lanes; ++l) x[i][l] = start(first + l, i);
    Lanes zeroth{}, initial{};
    for (const Lanes& at : x)
      for (std::size_t l = 0; l < kLanes; ++l) zeroth[l] += at[l] * at[l];
    const auto put = [&](std::size_t n, const Lanes& value) {
      for (std::size_t l = 0; n < count && l < lanes; ++l) moments[first + l][n] = value[l];
    };
    put(0, zeroth);
    double sign = 1;
    for (std::size_t n = 1; n < 2 || 2 * n - 1 < count; ++n, sign = -sign) {  // now T_n: to moments 2n - 1 and 2n
      Products p = add_product(twice_x, sign, x, y);
      if (n == 1) {  // x r, not 2 x r
        for (Lanes& at : y)
          for (double& v : at) v /= 2;
        for (std::size_t l = 0; l < kLanes; ++l) p.own[l] /= 4, p.other[l] /= 2;
        initial = p.other;
      }
      Lanes odd{}, even{};
      for (std::size_t l = 0; l < lanes; ++l) {
        if (!(p.own[l] <= (1 + kGrowth) * zeroth[l])) return std::nullopt;
        odd[l] = n == 1 ? initial[l] : 2 * sign * p.other[l] - initial[l];
        even[l] = 2 * p.own[l] - zeroth[l];
      }
      put(2 * n - 1, odd), put(2 * n, even);
      x.swap(y);
    }
  }
  return moments;
}

std::vector<std::vector<double>> smoothed_counts(const std::vector<std::vector<double>>& moments, std::size_t most,
                                                 const SpectrumBounds& bounds, const std::vector<double>& lambda) {
  std::vector<std::vector<double>> counts(moments.size(), std::vector<double>(lambda.size()));
  if (moments.empty()) return counts;
  const std::size_t count = std::min(most, moments.front().size());
  const std::vector<double> g = jackson(count);
  std::vector<double> weight(count);
  for (std::size_t k = 0; k < lambda.size(); ++k) {
    // The density over the angle, (mu_0 + 2 sum g_n mu_n cos n theta) / pi, from theta to pi.
    const double theta = std::acos(std::clamp(bounds.mapped(lambda[k]), -1.0, 1.0));
    weight[0] = 1 - theta / std::numbers::pi;
    for (std::size_t n = 1; n < count; ++n) {
      const auto m = static_cast<double>(n);
      weight[n] = -2 * g[n] * std::sin(m * theta) / (m * std::numbers::pi);
    }
    for (std::size_t r = 0; r < moments.size(); ++r)
      counts[r][k] = std::inner_product(weight.begin(), weight.end(), moments[r].begin(), 0.0);
  }
  return counts;
}

}  // namespace isostat
