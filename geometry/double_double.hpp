// Numbers of twice the precision of double, hi + lo with hi = fl(hi + lo), u = 2^-53. Relative errors of the
// operations: sum and difference 3 u^2, product 5 u^2, quotient 15 u^2, absent under- and overflow. Source: Joldes,
// Muller, Popescu, ACM Trans. Math. Softw. 44, 15 (2017), algorithms 6, 12 and 18.
#pragma once
#include <cmath>

namespace isostat {

struct DoubleDouble {
  double hi = 0, lo = 0;
  DoubleDouble() = default;
  explicit DoubleDouble(double h, double l = 0) : hi(h), lo(l) {}
};

// x + y and x y without error.
inline DoubleDouble two_sum(double x, double y) {
  const double s = x + y, z = s - x;
  return DoubleDouble(s, (x - (s - z)) + (y - z));
}
inline DoubleDouble two_product(double x, double y) {
  const double p = x * y;
  return DoubleDouble(p, std::fma(x, y, -p));
}
inline DoubleDouble fast_two_sum(double x, double y) {  // |x| >= |y|
  const double s = x + y;
  return DoubleDouble(s, y - (s - x));
}

inline DoubleDouble operator-(const DoubleDouble& x) { return DoubleDouble(-x.hi, -x.lo); }
inline DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) {
  const DoubleDouble s = two_sum(x.hi, y.hi), t = two_sum(x.lo, y.lo);
  const DoubleDouble v = fast_two_sum(s.hi, s.lo + t.hi);
  return fast_two_sum(v.hi, t.lo + v.lo);
}
inline DoubleDouble operator-(const DoubleDouble& x, const DoubleDouble& y) { return x + -y; }
inline DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) {
  const DoubleDouble c = two_product(x.hi, y.hi);
  return fast_two_sum(c.hi, c.lo + std::fma(x.hi, y.lo, std::fma(x.lo, y.hi, x.lo * y.lo)));
}
inline DoubleDouble operator/(const DoubleDouble& x, const DoubleDouble& y) {
  const double q = x.hi / y.hi;
  const DoubleDouble r = x - y * DoubleDouble(q);
  return fast_two_sum(q, r.hi / y.hi);
}

}  // namespace isostat
