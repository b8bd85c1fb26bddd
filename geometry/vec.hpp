// Small fixed-size vectors of doubles; D is the dimension of space.
#pragma once
#include <array>
#include <cmath>

namespace isostat {

template <int D>
struct Vec {
  std::array<double, D> c{};
  constexpr double& operator[](int k) { return c[static_cast<std::size_t>(k)]; }
  constexpr double operator[](int k) const { return c[static_cast<std::size_t>(k)]; }
  friend constexpr bool operator==(const Vec&, const Vec&) = default;
};
using Vec2 = Vec<2>;
using Vec3 = Vec<3>;

template <int D>
constexpr Vec<D>& operator+=(Vec<D>& a, const Vec<D>& b) {
  for (int k = 0; k < D; ++k) a[k] += b[k];
  return a;
}
template <int D>
constexpr Vec<D>& operator-=(Vec<D>& a, const Vec<D>& b) {
  for (int k = 0; k < D; ++k) a[k] -= b[k];
  return a;
}
template <int D>
constexpr Vec<D> operator+(Vec<D> a, const Vec<D>& b) {
  return a += b;
}
template <int D>
constexpr Vec<D> operator-(Vec<D> a, const Vec<D>& b) {
  return a -= b;
}
template <int D>
constexpr Vec<D> operator*(double s, Vec<D> a) {
  for (int k = 0; k < D; ++k) a[k] *= s;
  return a;
}
template <int D>
constexpr Vec<D> operator/(Vec<D> a, double s) {
  for (int k = 0; k < D; ++k) a[k] /= s;
  return a;
}
template <int D>
constexpr double dot(const Vec<D>& a, const Vec<D>& b) {
  double s = 0;
  for (int k = 0; k < D; ++k) s += a[k] * b[k];
  return s;
}
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}
template <int D>
double norm(const Vec<D>& a) {
  return std::sqrt(dot(a, a));
}

}  // namespace isostat
