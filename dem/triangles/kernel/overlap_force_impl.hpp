// Forces of overlaps between grains. Included by kernels_*.cpp only.
//
// overlap-energy: U = Y A_c^2 / (2 L_c), A_c the area of a pair of grains; the pressure p = Y A_c / L_c acts on every
// clipped edge, so the force on a triangle is -p dA/dx. `paper`: each pair of triangles by itself
// (dem/triangles/paper_contact.hpp). Friction: one spring a pair of grains, along t = z x n with n the direction of the
// whole normal force, at the mean point of the overlaps weighted by area; the relative velocity is weighted alike, so
// that the force is the transpose of the map from velocities.
#pragma once
#include <cmath>

#include "dem/triangles/kernel/rows.hpp"
#include "dem/triangles/kernel/triangle_kernels.hpp"
#include "dem/triangles/paper_contact.hpp"

namespace isostat::kernel {

// What a row of a pack leaves behind for the second pass, in lanes.
enum WorkSlot : std::size_t { kGradX, kGradY, kMomentA, kMomentB, kPointX, kPointY, kArea };

// Memory answers late: a triangle is asked for so many packs before it is first needed.
inline constexpr std::size_t kPacksAhead = 8;

// Friction of one lane, a pair of grains in contact; gives the work of sliding [erg].
ISOSTAT_INLINE double friction_of(const OverlapInput& in, const OverlapPack& pack, std::size_t lane, std::size_t place,
                                  double pressure, double virial[2]) {
  const auto row = [&](std::size_t r, WorkSlot slot) { return in.work[kOverlapWork * r + kLanes * slot + lane]; };
  double gx = 0, gy = 0, weight = 0, x = 0, y = 0;
  for (std::size_t r = 0; r < pack.rows; ++r) {
    const double area = row(r, kArea);
    gx += row(r, kGradX), gy += row(r, kGradY);
    weight += area, x += area * row(r, kPointX), y += area * row(r, kPointY);
  }
  double& spring = in.spring[place];
  const double chord = std::sqrt(gx * gx + gy * gy);
  if (!(chord > 0)) return 0;
  x /= weight, y /= weight;
  const double tx = -gy / chord, ty = gx / chord;  // n, along the gradient, points from a to b
  const double ox = in.offset_x[place], oy = in.offset_y[place];
  double sliding = 0;  // velocity of b against a along t
  for (std::size_t r = 0; r < pack.rows; ++r) {
    const double part = row(r, kArea) / weight;
    if (!(part > 0)) continue;
    const std::size_t at = pack.first + kLanes * r + lane, a = in.a[at], b = in.b[at];
    const double vx = in.px[b] - in.pw[b] * (y - in.y[b] - oy) - (in.px[a] - in.pw[a] * (y - in.y[a]));
    const double vy = in.py[b] + in.pw[b] * (x - in.x[b] - ox) - (in.py[a] + in.pw[a] * (x - in.x[a]));
    sliding += part * (vx * tx + vy * ty);
  }
  const double limit = in.friction * pressure * chord;
  const double wanted = spring - in.spring_stiffness * sliding * in.time_step;
  spring = wanted > limit ? limit : wanted < -limit ? -limit : wanted;
  for (std::size_t r = 0; r < pack.rows; ++r) {
    const double part = row(r, kArea) / weight;
    if (!(part > 0)) continue;
    const std::size_t at = pack.first + kLanes * r + lane, a = in.a[at], b = in.b[at];
    const double fx = part * spring * tx, fy = part * spring * ty;
    double *on_a = in.loads + kLoadRow * a, *on_b = in.loads + kLoadRow * b;
    on_b[0] += fx, on_b[1] += fy, on_b[2] += (x - in.x[b] - ox) * fy - (y - in.y[b] - oy) * fx;
    on_a[0] -= fx, on_a[1] -= fy, on_a[2] -= (x - in.x[a]) * fy - (y - in.y[a]) * fx;
    virial[0] += fx * (in.x[b] + ox - in.x[a]), virial[1] += fy * (in.y[b] + oy - in.y[a]);
  }
  return (wanted - spring) / in.spring_stiffness * spring;
}

template <class V, ContactLaw kLaw, bool kFriction, bool kVirial>
ISOSTAT_INLINE OverlapTally overlap_forces_in(const OverlapInput& in) {
  constexpr std::size_t width = V::size();
  OverlapTally tally;
  double virial[2] = {0, 0};  // of friction
  V virial_x(0.0), virial_y(0.0);
  for (std::size_t p = in.begin; p < in.end; ++p) {
    const OverlapPack pack = in.packs[p];
    if (p + kPacksAhead < in.end) {
      const OverlapPack* soon = in.packs + p + kPacksAhead;
      for (std::size_t k = soon->first_seen; k < soon[1].first_seen; ++k) {
        __builtin_prefetch(in.rows + kCornerRow * std::size_t{in.seen[k]});
        __builtin_prefetch(in.loads + kLoadRow * std::size_t{in.seen[k]}, 1);
      }
    }
    for (std::size_t lane = 0; lane < kLanes; lane += width) {
      const std::size_t place = kLanes * p + lane;
      const V offset_x(in.offset_x + place, stdx::element_aligned),
          offset_y(in.offset_y + place, stdx::element_aligned);
      V area(0.0);
      double* work = in.work + lane;
      for (std::size_t r = 0; r < pack.rows; ++r, work += kOverlapWork) {
        const std::size_t at = pack.first + kLanes * r + lane;
        const TriangleLanes<V> a = load_triangles(in.rows, in.a + at, V());
        TriangleLanes<V> b = load_triangles(in.rows, in.b + at, V());
        for (int k = 0; k < 3; ++k) b.x[k] = b.x[k] + offset_x, b.y[k] = b.y[k] + offset_y;
        const OverlapLanes<V> o = overlap_lanes(a, b);
        area = area + o.area;
        o.gradient_x.copy_to(work + 8 * kGradX, stdx::element_aligned);
        o.gradient_y.copy_to(work + 8 * kGradY, stdx::element_aligned);
        o.rotation_a.copy_to(work + 8 * kMomentA, stdx::element_aligned);
        o.rotation_b.copy_to(work + 8 * kMomentB, stdx::element_aligned);
        if constexpr (kFriction || kLaw == ContactLaw::paper) {
          (o.point_x + a.x[0]).copy_to(work + 8 * kPointX, stdx::element_aligned);
          (o.point_y + a.y[0]).copy_to(work + 8 * kPointY, stdx::element_aligned);
          o.area.copy_to(work + 8 * kArea, stdx::element_aligned);
        }
        if constexpr (kLaw == ContactLaw::paper) {
          // The paper's force in place of the gradient, pair by pair, with a pressure of 1.
          for (std::size_t w = 0; w < width; ++w) {
            PaperContact force;
            if (work[8 * kArea + w] > 0) {
              const auto corner = [&](std::uint32_t slot, int k, double x, double y) {
                const double* row_of = in.rows + kCornerRow * std::size_t{slot};
                return Vec2{{row_of[2 * k] + x, row_of[2 * k + 1] + y}};
              };
              const double ox = in.offset_x[place + w], oy = in.offset_y[place + w];
              const std::uint32_t i = in.a[at + w], j = in.b[at + w];
              force = paper_contact({{corner(i, 0, 0, 0), corner(i, 1, 0, 0), corner(i, 2, 0, 0)}},
                                    {{corner(j, 0, ox, oy), corner(j, 1, ox, oy), corner(j, 2, ox, oy)}}, in.modulus);
            }
            work[8 * kGradX + w] = -force.on_a[0], work[8 * kGradY + w] = -force.on_a[1];
            work[8 * kMomentA + w] = -force.moment_a, work[8 * kMomentB + w] = -force.moment_b;
          }
        }
      }
      const V zero(0.0);
      const V stiffness(in.stiffness + place, stdx::element_aligned);
      const V pressure = kLaw == ContactLaw::paper ? V(1.0) : stiffness * area;
      if constexpr (kFriction) {
        double areas[width], pressures[width];
        area.copy_to(areas, stdx::element_aligned), pressure.copy_to(pressures, stdx::element_aligned);
        for (std::size_t w = 0; w < width; ++w)
          if (areas[w] > 0)
            tally.slipped += friction_of(in, pack, lane + w, place + w, pressures[w], virial);
          else
            in.spring[place + w] = 0;
      }
      if (!any_of(area > zero)) continue;
      work = in.work + lane;
      for (std::size_t r = 0; r < pack.rows; ++r, work += kOverlapWork) {
        const std::size_t at = pack.first + kLanes * r + lane;
        const V fx = -pressure * V(work + 8 * kGradX, stdx::element_aligned);
        const V fy = -pressure * V(work + 8 * kGradY, stdx::element_aligned);
        add_pair_loads(in.loads, in.a + at, in.b + at, fx, fy,
                       -pressure * V(work + 8 * kMomentA, stdx::element_aligned),
                       -pressure * V(work + 8 * kMomentB, stdx::element_aligned));
        if constexpr (kVirial) {
          const auto centre = [](const TriangleLanes<V>& t, V& x, V& y) {
            x = (t.x[0] + t.x[1] + t.x[2]) * V(1.0 / 3), y = (t.y[0] + t.y[1] + t.y[2]) * V(1.0 / 3);
          };
          V ax, ay, bx, by;
          centre(load_triangles(in.rows, in.a + at, V()), ax, ay);
          centre(load_triangles(in.rows, in.b + at, V()), bx, by);
          virial_x = mul_add<V>(-fx, bx + offset_x - ax, virial_x);
          virial_y = mul_add<V>(-fy, by + offset_y - ay, virial_y);
        }
      }
    }
  }
  if constexpr (kVirial) tally.virial[0] = reduce(virial_x) + virial[0], tally.virial[1] = reduce(virial_y) + virial[1];
  return tally;
}

}  // namespace isostat::kernel
