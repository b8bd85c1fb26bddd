// Bias and scatter of the fit of Eq. 28 on random fields with known d_F and xi, against the side of the cell: how large
// a sample a given error needs. Every lattice mode up to k = 2 pi is an independent exponential variable about I(k).
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "analysis/structure/intensity.hpp"

using namespace isostat;

namespace {

// Mode (mx, my) of a Gaussian field: |chi_hat|^2 = A I(k) times an exponential variable.
DiskTransform random_field(double side, double d_f, double xi, double constant, std::uint64_t seed) {
  constexpr double kPi = std::numbers::pi;
  std::mt19937_64 g(seed);
  DiskTransform t;
  t.cell.length = {side, side}, t.k_max = 2 * kPi;
  t.mx_max = t.my_max = static_cast<std::int64_t>(side);
  t.value.resize(static_cast<std::size_t>((t.mx_max + 1) * (2 * t.my_max + 1)));
  for (std::int64_t mx = 0; mx <= t.mx_max; ++mx)
    for (std::int64_t my = -t.my_max; my <= t.my_max; ++my) {
      const double k2 = t.k2(mx, my), u = std::ldexp(static_cast<double>(g() >> 11), -53);
      if (k2 == 0 || k2 > t.k_max * t.k_max) continue;
      t.value[static_cast<std::size_t>(mx * (2 * t.my_max + 1) + my + t.my_max)] =
          std::sqrt(-std::log(1 - u) * side * side * fractal_intensity(std::sqrt(k2), d_f, xi, 2.4, constant));
    }
  return t;
}

}  // namespace

int main() {
  std::printf("case,side,d_F_scatter,d_F_error,xi_scatter,xi_error,d_F_bias,xi_bias,fields,identifiable\n");
  for (const auto& [d_f, xi, constant] :
       {std::array{1.53, 9.3, 0.02}, std::array{1.53, 5.06, 0.02}, std::array{1.93, 6.07, 0.0}})
    for (const double side : {40.0, 60.0, 120.0, 240.0, 480.0}) {
      const int fields = side > 300 ? 15 : 30;
      double n = 0, sd = 0, sdd = 0, ed = 0, sx = 0, sxx = 0, ex = 0;
      for (int f = 0; f < fields; ++f) {
        const auto t = random_field(side, d_f, xi, constant, static_cast<std::uint64_t>(f + 1));
        const auto fit =
            fit_curve(average_intensity(t, anchored_edges(2 * std::numbers::pi / side, t.k_max)), 0, t.k_max);
        if (!fit.identifiable) continue;
        const double a = fit.d_f - d_f, b = fit.xi - xi;
        n += 1, sd += a, sdd += a * a, ed += fit.error[0], sx += b, sxx += b * b, ex += fit.error[1];
      }
      std::printf("d_F %g xi %g,%g,%.4f,%.4f,%.3f,%.3f,%.4f,%.3f,%d,%g\n", d_f, xi, side,
                  std::sqrt((sdd - sd * sd / n) / (n - 1)), ed / n, std::sqrt((sxx - sx * sx / n) / (n - 1)), ex / n,
                  sd / n, sx / n, fields, n);
      std::fflush(stdout);
    }
}
