// Gear's predictor-corrector for triangles (dem/triangles/gear_scheme.hpp).
#include <algorithm>
#include <cmath>

#include "dem/triangles/engine.hpp"
#include "dem/triangles/gear_scheme.hpp"

namespace isostat {

using Store = GrainStore;

// Gear's prediction of positions and velocities; ux, uy, uw are at the full step.
double TriangleEngine::predict() {
  auto& s = store_;
  const double h = dt_;
  double largest = 0;
  struct Axis {
    Store::Column r, v, p, a, b, c, f, inverse;
  };
  constexpr Axis axes[] = {
      {Store::x, Store::ux, Store::px, Store::ax, Store::bx, Store::cx, Store::fx, Store::inverse_mass},
      {Store::y, Store::uy, Store::py, Store::ay, Store::by, Store::cy, Store::fy, Store::inverse_mass},
      {Store::angle, Store::uw, Store::pw, Store::aw, Store::bw, Store::cw, Store::torque, Store::inverse_inertia}};
  for (std::size_t k = 0; k < s.free_slots(); ++k) {
    double moved[3];
    for (int a = 0; a < 3; ++a) {
      const Axis& q = axes[a];
      const double r1 = h * s[q.v][k];
      const double r2 =
          0.5 * h * h *
          (s[q.f][k] * s[q.inverse][k] - (a == 1 ? gravity_ * s[Store::heavy][k] : 0) - drag_ * s[q.v][k]);
      const double r3 = s[q.b][k], r4 = s[q.c][k];
      moved[a] = r1 + r2 + r3 + r4;
      s[q.r][k] += moved[a];
      s[q.v][k] = s[q.p][k] = (r1 + 2 * r2 + 3 * r3 + 4 * r4) / h;
      s[q.a][k] = r2 + 3 * r3 + 6 * r4;  // in the store: lists may reorder it before the correction
      s[q.b][k] = r3 + 4 * r4;
    }
    const double move = std::hypot(moved[0], moved[1]) + s[Store::reach][k] * std::abs(moved[2]);
    if (!(move <= largest)) largest = move;
  }
  kernels_.corners(0, s.free_slots(), s.arrays());
  return largest;
}

void TriangleEngine::correct() {
  if (integrator_ != Integrator::gear) return;
  auto& s = store_;
  const double h = dt_;
  double largest = 0;
  constexpr Store::Column r[] = {Store::x, Store::y, Store::angle}, v[] = {Store::ux, Store::uy, Store::uw},
                          p[] = {Store::px, Store::py, Store::pw}, f[] = {Store::fx, Store::fy, Store::torque},
                          a2[] = {Store::ax, Store::ay, Store::aw}, b[] = {Store::bx, Store::by, Store::bw},
                          c[] = {Store::cx, Store::cy, Store::cw};
  for (std::size_t k = 0; k < s.free_slots(); ++k) {
    double moved[3];
    for (int a = 0; a < 3; ++a) {
      const double inverse = s[a == 2 ? Store::inverse_inertia : Store::inverse_mass][k];
      const double now =
          0.5 * h * h * (s[f[a]][k] * inverse - (a == 1 ? gravity_ * s[Store::heavy][k] : 0) - drag_ * s[p[a]][k]);
      const double error = now - s[a2[a]][k];
      moved[a] = kGearCorrector[0] * error;
      s[r[a]][k] += moved[a];
      s[v[a]][k] += kGearCorrector[1] * error / h;
      s[p[a]][k] = s[v[a]][k];
      s[b[a]][k] += kGearCorrector[3] * error;
      s[c[a]][k] += kGearCorrector[4] * error;
    }
    const double move = std::hypot(moved[0], moved[1]) + s[Store::reach][k] * std::abs(moved[2]);
    if (!(move <= largest)) largest = move;
  }
  lists_->add_travel(2.02 * largest);
}

}  // namespace isostat
