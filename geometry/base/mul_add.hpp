// a b + c; the kernels specialise it to a fused instruction where the machine has one.
#pragma once

namespace isostat {

template <class Real>
struct MulAdd {
  static Real of(Real a, Real b, Real c) { return a * b + c; }
};
template <class Real>
inline Real mul_add(Real a, Real b, Real c) {
  return MulAdd<Real>::of(a, b, c);
}

}  // namespace isostat
