#include "geometry/orientation.hpp"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "geometry/double_double.hpp"

namespace isostat {
namespace {

int sign(double v) { return (v > 0) - (v < 0); }

// A sum of doubles kept without error as components that do not overlap, in ascending order (Shewchuk's
// GROW-EXPANSION).
class Expansion {
 public:
  void add(double x) {
    for (int k = 0; k < size_; ++k) {
      const DoubleDouble s = two_sum(x, part_[static_cast<std::size_t>(k)]);
      x = s.hi, part_[static_cast<std::size_t>(k)] = s.lo;
    }
    part_[static_cast<std::size_t>(size_++)] = x;
  }
  void add_product(double x, double y) {
    const DoubleDouble p = two_product(x, y);
    add(p.lo), add(p.hi);
  }
  int sign_of_sum() const {
    for (int k = size_; k-- > 0;)
      if (part_[static_cast<std::size_t>(k)] != 0) return sign(part_[static_cast<std::size_t>(k)]);
    return 0;
  }

 private:
  std::array<double, 16> part_{};
  int size_ = 0;
};

// No product of these differences, or of their last bits, leaves the range of double.
bool products_fit(std::initializer_list<DoubleDouble> differences) {
  constexpr double least = 0x1p-480, most = 0x1p500;
  return std::all_of(differences.begin(), differences.end(), [](const DoubleDouble& d) {
    const auto fits = [](double v) { return v == 0 || (std::abs(v) >= least && std::abs(v) <= most); };
    return fits(d.hi) && fits(d.lo);
  });
}

int rational_sign(const Vec2& a, const Vec2& b, const Vec2& c) {
  using Rational = boost::multiprecision::cpp_rational;
  const Rational cx(c[0]), cy(c[1]);
  const Rational left = (Rational(a[0]) - cx) * (Rational(b[1]) - cy);
  const Rational right = (Rational(a[1]) - cy) * (Rational(b[0]) - cx);
  return left.compare(right);
}

}  // namespace

int orientation_sign(const Vec2& a, const Vec2& b, const Vec2& c) {
  constexpr double u = 0x1p-53, bound = (3 + 16 * u) * u;  // Shewchuk's ccwerrboundA
  constexpr double tiny = 0x1p-960;                        // covers what products lose by underflow
  const double left = (a[0] - c[0]) * (b[1] - c[1]), right = (a[1] - c[1]) * (b[0] - c[0]);
  const double value = left - right;
  if (std::abs(value) > bound * (std::abs(left) + std::abs(right)) + tiny) return sign(value);

  const DoubleDouble ax = two_sum(a[0], -c[0]), ay = two_sum(a[1], -c[1]);
  const DoubleDouble bx = two_sum(b[0], -c[0]), by = two_sum(b[1], -c[1]);
  if (!products_fit({ax, ay, bx, by})) return rational_sign(a, b, c);
  Expansion e;
  e.add_product(ax.lo, by.lo), e.add_product(-ay.lo, bx.lo);
  e.add_product(ax.hi, by.lo), e.add_product(-ay.hi, bx.lo);
  e.add_product(ax.lo, by.hi), e.add_product(-ay.lo, bx.hi);
  e.add_product(ax.hi, by.hi), e.add_product(-ay.hi, bx.hi);
  return e.sign_of_sum();
}

}  // namespace isostat
