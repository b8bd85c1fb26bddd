// Gauss-Legendre nodes and weights on [-1, 1], by Newton's iteration on the Legendre recurrence.
#pragma once
#include <cmath>
#include <numbers>
#include <vector>

namespace isostat {

struct Quadrature {
  std::vector<double> node, weight;
};

inline Quadrature gauss_legendre(int n) {
  Quadrature q;
  q.node.resize(static_cast<std::size_t>(n)), q.weight.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p, p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      const double step = p / slope;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    q.node[static_cast<std::size_t>(i)] = x;
    q.weight[static_cast<std::size_t>(i)] = 2 / ((1 - x * x) * slope * slope);
  }
  return q;
}

}  // namespace isostat
