// Two SIMD vectors worked on side by side, as one vector of twice the width. A batch is one long chain of dependent
// operations (difference, root, division, law, sum); with two of them interleaved the processor always has something
// to do while the other waits.
#pragma once
#include <experimental/simd>

#include "geometry/base/mul_add.hpp"

#define ISOSTAT_TWIN [[gnu::always_inline]] friend inline

namespace isostat::kernel {

template <class V>
struct Twin {
  using Mask = typename V::mask_type;
  struct TwinMask {
    Mask a, b;
    ISOSTAT_TWIN TwinMask operator&&(const TwinMask& m, const TwinMask& n) { return {m.a && n.a, m.b && n.b}; }
    ISOSTAT_TWIN TwinMask operator!(const TwinMask& m) { return {!m.a, !m.b}; }
    ISOSTAT_TWIN bool any_of(const TwinMask& m) { return any_of(m.a || m.b); }
  };
  V a, b;

  static constexpr std::size_t size() { return 2 * V::size(); }
  Twin() = default;
  [[gnu::always_inline]] Twin(V lower, V upper) : a(lower), b(upper) {}
  [[gnu::always_inline]] explicit Twin(double x) : a(x), b(x) {}
  template <class Flags>
  [[gnu::always_inline]] Twin(const double* p, Flags f) : a(p, f), b(p + V::size(), f) {}
  template <class Flags>
  [[gnu::always_inline]] void copy_to(double* p, Flags f) const {
    a.copy_to(p, f), b.copy_to(p + V::size(), f);
  }

  ISOSTAT_TWIN Twin operator+(const Twin& x, const Twin& y) { return {x.a + y.a, x.b + y.b}; }
  ISOSTAT_TWIN Twin operator-(const Twin& x, const Twin& y) { return {x.a - y.a, x.b - y.b}; }
  ISOSTAT_TWIN Twin operator*(const Twin& x, const Twin& y) { return {x.a * y.a, x.b * y.b}; }
  ISOSTAT_TWIN Twin operator/(const Twin& x, const Twin& y) { return {x.a / y.a, x.b / y.b}; }
  ISOSTAT_TWIN Twin operator-(const Twin& x) { return {-x.a, -x.b}; }
  ISOSTAT_TWIN Twin& operator+=(Twin& x, const Twin& y) { return x = x + y; }
  ISOSTAT_TWIN Twin& operator-=(Twin& x, const Twin& y) { return x = x - y; }
  ISOSTAT_TWIN TwinMask operator<(const Twin& x, const Twin& y) { return {x.a < y.a, x.b < y.b}; }
  ISOSTAT_TWIN TwinMask operator>(const Twin& x, const Twin& y) { return {x.a > y.a, x.b > y.b}; }
  ISOSTAT_TWIN Twin sqrt(const Twin& x) { return {sqrt(x.a), sqrt(x.b)}; }
  ISOSTAT_TWIN Twin max(const Twin& x, const Twin& y) { return {max(x.a, y.a), max(x.b, y.b)}; }
  ISOSTAT_TWIN Twin min(const Twin& x, const Twin& y) { return {min(x.a, y.a), min(x.b, y.b)}; }
  ISOSTAT_TWIN double reduce(const Twin& x) { return reduce(x.a + x.b); }
  // x where the mask holds, else y
  ISOSTAT_TWIN Twin select(const TwinMask& m, const Twin& x, Twin y) {
    where(m.a, y.a) = x.a;
    where(m.b, y.b) = x.b;
    return y;
  }
};

}  // namespace isostat::kernel

template <class V>
struct isostat::MulAdd<isostat::kernel::Twin<V>> {
  using T = isostat::kernel::Twin<V>;
  [[gnu::always_inline]] static T of(const T& x, const T& y, const T& z) {
    return {MulAdd<V>::of(x.a, y.a, z.a), MulAdd<V>::of(x.b, y.b, z.b)};
  }
};
