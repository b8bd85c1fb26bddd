// Included only by overlap_batch_*.cpp, each compiled for one instruction set.
#pragma once
#include "geometry/overlap_batch.hpp"
#include "geometry/overlap_clip.hpp"

namespace isostat::kernel {

void overlap_batch_scalar(std::size_t n, const TriangleArrays& a, const TriangleArrays& b, const OverlapArrays& out);
void overlap_batch_avx2(std::size_t n, const TriangleArrays& a, const TriangleArrays& b, const OverlapArrays& out);
void overlap_batch_avx512(std::size_t n, const TriangleArrays& a, const TriangleArrays& b, const OverlapArrays& out);

template <class V>
ISOSTAT_INLINE void overlap_batch_in(std::size_t n, const TriangleArrays& a, const TriangleArrays& b,
                                     const OverlapArrays& out) {
  constexpr std::size_t width = V::size();
  const auto load = [](const TriangleArrays& t, std::size_t at) {
    TriangleLanes<V> lanes;
    for (int k = 0; k < 3; ++k) {
      lanes.x[k] = V(t.x[static_cast<std::size_t>(k)] + at, stdx::element_aligned);
      lanes.y[k] = V(t.y[static_cast<std::size_t>(k)] + at, stdx::element_aligned);
    }
    return lanes;
  };
  const auto store = [](const OverlapLanes<V>& o, const OverlapArrays& to, std::size_t at) {
    o.area.copy_to(to.area + at, stdx::element_aligned);
    o.gradient_x.copy_to(to.gradient_x + at, stdx::element_aligned);
    o.gradient_y.copy_to(to.gradient_y + at, stdx::element_aligned);
    o.rotation_a.copy_to(to.rotation_a + at, stdx::element_aligned);
    o.rotation_b.copy_to(to.rotation_b + at, stdx::element_aligned);
    o.chord.copy_to(to.chord + at, stdx::element_aligned);
  };
  std::size_t at = 0;
  for (; at + width <= n; at += width) store(overlap_lanes(load(a, at), load(b, at)), out, at);
  if (at == n) return;
  // What is left fills one batch with copies of the last pair.
  double corners[12][width], results[6][width];
  TriangleArrays last_a, last_b;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t lane = 0; lane < width; ++lane) {
      const std::size_t from = at + lane < n ? at + lane : n - 1;
      corners[k][lane] = a.x[k][from], corners[k + 3][lane] = a.y[k][from];
      corners[k + 6][lane] = b.x[k][from], corners[k + 9][lane] = b.y[k][from];
    }
    last_a.x[k] = corners[k], last_a.y[k] = corners[k + 3], last_b.x[k] = corners[k + 6], last_b.y[k] = corners[k + 9];
  }
  const OverlapArrays last{results[0], results[1], results[2], results[3], results[4], results[5]};
  store(overlap_lanes(load(last_a, 0), load(last_b, 0)), last, 0);
  double* const to[] = {out.area, out.gradient_x, out.gradient_y, out.rotation_a, out.rotation_b, out.chord};
  for (std::size_t r = 0; r < 6; ++r)
    for (std::size_t lane = 0; at + lane < n; ++lane) to[r][at + lane] = results[r][lane];
}

}  // namespace isostat::kernel
