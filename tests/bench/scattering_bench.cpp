// Time and error of I(k): the transform with kernels of several widths, the direct sum over disks, and the paper's mesh
// with FFT; error: the largest relative one of a bin, against the transform with the widest kernel. Without argument
// 1400 disks; "large": 1e5.
#include <fftw3.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string_view>

#include "analysis/structure/intensity.hpp"
#include "tests/oracle/direct_transform.hpp"
#include "tests/oracle/union_mesh.hpp"
#include "tests/support/disk_packings.hpp"

using namespace isostat;

namespace {

constexpr double kPi = std::numbers::pi;

struct Timed {
  IntensityCurve curve;
  double ms = 0;
};

template <class F>
Timed timed(int repeats, F&& work) {
  Timed best;
  best.ms = 1e300;
  for (int k = 0; k < repeats; ++k) {
    const auto start = std::clock();
    best.curve = work();
    best.ms = std::min(best.ms, 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

DiskTransform empty_like(const oracle::Disks& d, double k_max) {
  DiskTransform t;
  t.cell = d.cell, t.k_max = k_max;
  t.mx_max = static_cast<std::int64_t>(k_max * d.cell.length[0] / (2 * kPi));
  t.my_max = static_cast<std::int64_t>(k_max * d.cell.length[1] / (2 * kPi));
  t.value.resize(static_cast<std::size_t>((t.mx_max + 1) * (2 * t.my_max + 1)));
  return t;
}

template <class F>
DiskTransform filled(const oracle::Disks& d, double k_max, F&& chi) {
  auto t = empty_like(d, k_max);
  for (std::int64_t mx = 0; mx <= t.mx_max; ++mx)
    for (std::int64_t my = -t.my_max; my <= t.my_max; ++my)
      if (t.k2(mx, my) <= k_max * k_max)
        t.value[static_cast<std::size_t>(mx * (2 * t.my_max + 1) + my + t.my_max)] = chi(mx, my);
  return t;
}

DiskTransform by_mesh(const oracle::Disks& d, double k_max, double step) {
  const auto mesh = oracle::union_mesh(d.centre, d.radius, d.cell, step);
  const auto nx = static_cast<std::size_t>(mesh.nx), ny = static_cast<std::size_t>(mesh.ny), row = nx / 2 + 1;
  double* in = fftw_alloc_real(nx * ny);
  fftw_complex* out = fftw_alloc_complex(row * ny);
  for (std::size_t n = 0; n < nx * ny; ++n) in[n] = mesh.covered[n];
  const auto plan = fftw_plan_dft_r2c_2d(mesh.ny, mesh.nx, in, out, FFTW_ESTIMATE);
  fftw_execute(plan);
  const double area = mesh.step[0] * mesh.step[1];
  const auto t = filled(d, k_max, [&](std::int64_t mx, std::int64_t my) {
    const auto* c = out[static_cast<std::size_t>((my + mesh.ny) % mesh.ny) * row + static_cast<std::size_t>(mx)];
    return area * std::complex<double>(c[0], c[1]);
  });
  fftw_destroy_plan(plan), fftw_free(in), fftw_free(out);
  return t;
}

double error(const IntensityCurve& a, const IntensityCurve& b) {  // largest relative difference of a bin
  double worst = 0;
  for (std::size_t n = 0; n < a.modes.size(); ++n)
    if (a.modes[n] > 0) worst = std::max(worst, std::abs(a.intensity[n] / b.intensity[n] - 1));
  return worst;
}

void measure(const char* kind, const oracle::Disks& d, bool slow_ways) {
  const double k_max = 4 * kPi;
  const auto edges = anchored_edges(2 * kPi / std::max(d.cell.length[0], d.cell.length[1]), k_max);
  const auto by_transform = [&](TransformOptions o) {
    return average_intensity(disk_transform(d.centre, d.radius, d.cell, o), edges);
  };
  const auto reference = by_transform({.k_max = k_max, .kernel_width = 14, .oversampling = 2});
  const auto row = [&](const char* method, double parameter, const Timed& t) {
    std::printf("%s %zu,%s,%g,%.2f,%.2e\n", kind, d.centre.size(), method, parameter, t.ms, error(t.curve, reference));
    std::fflush(stdout);
  };
  for (const int width : {4, 6, 7, 8, 9, 10, 12})
    row("transform", width, timed(3, [&] { return by_transform({.k_max = k_max, .kernel_width = width}); }));
  row("transform_1.5", 10,
      timed(3, [&] { return by_transform({.k_max = k_max, .kernel_width = 10, .oversampling = 1.5}); }));
  row("no_overlaps", 9, timed(3, [&] { return by_transform({.k_max = k_max, .correct_overlaps = false}); }));
  if (!slow_ways) return;
  if (std::string_view(kind) == "rsa")  // overlaps count twice in the sum over disks
    row("direct_sum", 0, timed(1, [&] {
          return average_intensity(filled(d, k_max,
                                          [&](std::int64_t mx, std::int64_t my) {
                                            return oracle::sum_over_disks(d, {2 * kPi * double(mx) / d.cell.length[0],
                                                                              2 * kPi * double(my) / d.cell.length[1]});
                                          }),
                                   edges);
        }));
  for (const double mesh : {25, 50, 100, 200})
    row("mesh", mesh, timed(1, [&] { return average_intensity(by_mesh(d, k_max, 1 / mesh), edges); }));
}

// Triangular lattice of touching disks, shaken by 1e-3: half of the pairs overlap, as contacts do.
oracle::Disks contacts(int n) {
  oracle::Disks d = oracle::poisson_disks(std::size_t(n) * std::size_t(n), {1, 1}, 0.5, 0.5, 1);
  d.cell.length = {double(n), n * std::sqrt(3.0) / 2};
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      auto& c = d.centre[std::size_t(y) * std::size_t(n) + std::size_t(x)];
      c = Vec2{x + 0.5 * (y % 2), y * std::sqrt(3.0) / 2} + 1e-3 * c;
    }
  return d;
}

}  // namespace

int main(int argc, char**) {
  std::printf("kind,method,parameter,cpu_ms,error\n");
  const auto foam = [](std::size_t n) {  // areas summed 1.5, of which .78 is left as union
    const double side = std::sqrt(double(n) * kPi * 0.146 / 1.5);
    return oracle::poisson_disks(n, {side, side}, 0.25, 0.5, 1);
  };
  const auto rsa = [](std::size_t n, double r_max) {
    const double side = std::sqrt(double(n) * kPi * 0.146 / 0.36);
    return oracle::rsa_disks(n, {side, side}, 0.25, r_max, 1);
  };
  if (argc > 1) {
    measure("rsa", rsa(100000, 0.5), false);
    measure("contacts", contacts(316), false);
    measure("foam", foam(100000), false);
    return 0;
  }
  measure("rsa", rsa(1400, 0.5), true);
  measure("chains", oracle::chain_disks(42, {44, 44}, 1e-5, 1), true);
  measure("contacts", contacts(38), false);
  measure("foam", foam(1400), true);
}
