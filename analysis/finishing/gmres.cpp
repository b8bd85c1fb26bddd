#include "analysis/finishing/gmres.hpp"

#include <cmath>

#include "analysis/vector_algebra.hpp"

namespace isostat {
namespace {

using Vector = std::vector<double>;

void add(Vector& a, double factor, const Vector& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += factor * b[k];
}
Vector scaled(double factor, Vector a) {
  for (double& v : a) v *= factor;
  return a;
}

}  // namespace

LinearSolution gmres(const LinearMap& apply, const LinearMap& precondition, const Vector& b, double tolerance,
                     int most) {
  LinearSolution s;
  s.x.assign(b.size(), 0.0);
  const double norm_b = std::sqrt(dot(b, b));
  if (!(norm_b > 0)) {
    s.residual = 0;
    return s;
  }
  // Arnoldi: A P^-1 V = V H, V orthonormal; H is turned to triangular form by Givens rotations as it grows.
  std::vector<Vector> v{scaled(1 / norm_b, b)}, columns;
  Vector cosine, sine, rhs{norm_b};
  for (int k = 0; k < most && s.residual > tolerance; ++k) {
    const auto n = static_cast<std::size_t>(k);
    Vector w = apply(precondition(v[n]));
    Vector h(n + 2);
    for (std::size_t q = 0; q <= n; ++q) {
      h[q] = dot(w, v[q]);
      add(w, -h[q], v[q]);
    }
    h[n + 1] = std::sqrt(dot(w, w));
    if (h[n + 1] > 0) v.push_back(scaled(1 / h[n + 1], std::move(w)));
    const bool exact = !(h[n + 1] > 0);
    for (std::size_t q = 0; q < n; ++q) {
      const double upper = cosine[q] * h[q] + sine[q] * h[q + 1];
      h[q + 1] = cosine[q] * h[q + 1] - sine[q] * h[q];
      h[q] = upper;
    }
    const double length = std::hypot(h[n], h[n + 1]);
    if (!(length > 0)) break;  // a direction that the operator does not see
    cosine.push_back(h[n] / length), sine.push_back(h[n + 1] / length);
    h[n] = length;
    rhs.push_back(-sine[n] * rhs[n]);
    rhs[n] *= cosine[n];
    columns.push_back(std::move(h));
    s.residual = std::abs(rhs[n + 1]) / norm_b;
    ++s.iterations;
    if (exact) break;
  }
  Vector y(columns.size()), sum(b.size(), 0.0);
  for (std::size_t q = columns.size(); q-- > 0;) {
    double value = rhs[q];
    for (std::size_t p = q + 1; p < columns.size(); ++p) value -= columns[p][q] * y[p];
    y[q] = value / columns[q][q];
    add(sum, y[q], v[q]);
  }
  if (!columns.empty()) s.x = precondition(sum);
  return s;
}

}  // namespace isostat
