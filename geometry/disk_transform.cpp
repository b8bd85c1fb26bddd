#include "geometry/disk_transform.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "geometry/smoothed_disk.hpp"
#include "geometry/union_terms.hpp"
#include "geometry/wall_points.hpp"

namespace isostat {
namespace {

constexpr double kPi = std::numbers::pi;
// Decay of the kernel against the phase pi w (1 - 1/(2 sigma)) at the first alias (Barnett et al. 2019 use .97-.98).
constexpr double kDecayFraction = 0.976;
constexpr double kLargeGrid = 3e7;           // points: beyond, less oversampling and a wider kernel
constexpr double kRadiusClassInSteps = 2;    // width of the radius classes that share a table
constexpr double kOverlapTolerance = 1e-10;  // of the overlap points, relative to a disk's area

// Even number of at least n with no prime factor above 7: fast in FFTW.
std::int64_t good_size(double at_least) {
  for (auto n = 2 * static_cast<std::int64_t>(std::ceil(at_least / 2));; n += 2) {
    auto rest = n;
    for (const int p : {2, 3, 5, 7})
      while (rest % p == 0) rest /= p;
    if (rest == 1) return n;
  }
}

struct FftwFree {
  void operator()(double* p) const { fftw_free(p); }
};

// Real grid, row by row along x, with room for its transform in place. In a tilted cell each row stands further along
// x than the one below, so that the nodes are a lattice of the cell.
class Grid {
 public:
  Grid(std::int64_t nx, std::int64_t ny, const PeriodicCell<2>& cell)
      : nx_(nx),
        ny_(ny),
        stride_(2 * (nx / 2 + 1)),
        step_{cell.length[0] / static_cast<double>(nx), cell.length[1] / static_cast<double>(ny)},
        slant_(cell.slant()),
        data_(fftw_alloc_real(static_cast<std::size_t>(stride_ * ny))) {
    if (!data_) throw std::bad_alloc();
    std::fill(data_.get(), data_.get() + stride_ * ny, 0.0);
  }
  const Vec2& step() const { return step_; }

  // Adds weight * profile(|r - centre|) at every node within its reach, images included.
  template <class Profile>
  void add(const Vec2& centre, double weight, const Profile& profile) {
    double* data = data_.get();
    visit(centre, profile, [&](std::int64_t node, double value) { data[node] += weight * value; });
  }
  // The same on two grids of one shape, the profile evaluated once.
  template <class Profile>
  static void add(Grid& a, Grid& b, const Vec2& centre, double weight_a, double weight_b, const Profile& profile) {
    double *data_a = a.data_.get(), *data_b = b.data_.get();
    a.visit(centre, profile, [&](std::int64_t node, double value) {
      data_a[node] += weight_a * value, data_b[node] += weight_b * value;
    });
  }
  // Transform in place; mode (mx >= 0, my) is then at(mx, my).
  void transform() {
    auto* out = reinterpret_cast<fftw_complex*>(data_.get());
    const auto plan =
        fftw_plan_dft_r2c_2d(static_cast<int>(ny_), static_cast<int>(nx_), data_.get(), out, FFTW_ESTIMATE);
    if (!plan) throw std::runtime_error("disk_transform: FFTW has no plan for this grid");
    fftw_execute(plan);
    fftw_destroy_plan(plan);
  }
  std::complex<double> at(std::int64_t mx, std::int64_t my) const {
    const double* c = data_.get() + stride_ * modulo(my, ny_) + 2 * mx;
    return {c[0], c[1]};
  }

 private:
  template <class Profile, class AddAt>
  void visit(const Vec2& centre, const Profile& profile, const AddAt& add_at) const {
    const double reach = profile.reach();
    const auto y0 = static_cast<std::int64_t>(std::ceil((centre[1] - reach) / step_[1]));
    const auto y1 = static_cast<std::int64_t>(std::floor((centre[1] + reach) / step_[1]));
    for (auto y = y0; y <= y1; ++y) {
      const double dy = static_cast<double>(y) * step_[1] - centre[1], dy2 = dy * dy, w2 = reach * reach - dy2;
      if (w2 < 0) continue;
      const double w = std::sqrt(w2) / step_[0];
      const double cx = (centre[0] - slant_ * (static_cast<double>(y) * step_[1])) / step_[0];
      auto x = static_cast<std::int64_t>(std::ceil(cx - w));
      const auto x1 = static_cast<std::int64_t>(std::floor(cx + w));
      const auto row = stride_ * modulo(y, ny_);
      while (x <= x1) {  // runs that do not cross the cell's edge
        const auto start = modulo(x, nx_);
        const auto end = std::min(x1 + 1, x + nx_ - start);
        auto node = row + start;
        for (; x < end; ++x, ++node) {
          const double dx = (static_cast<double>(x) - cx) * step_[0];
          add_at(node, profile(std::min(std::sqrt(dx * dx + dy2), reach)));
        }
      }
    }
  }

  static std::int64_t modulo(std::int64_t a, std::int64_t n) {
    const auto r = a % n;
    return r < 0 ? r + n : r;
  }
  std::int64_t nx_, ny_, stride_;
  Vec2 step_;
  double slant_;
  std::unique_ptr<double, FftwFree> data_;
};

void check(std::span<const Vec2> centre, std::span<const double> radius, const PeriodicCell<2>& cell,
           const TransformOptions& o) {
  if (centre.size() != radius.size()) throw std::invalid_argument("disk_transform: as many radii as centres");
  if (!(cell.length[0] > 0 && cell.length[1] > 0))
    throw std::invalid_argument("disk_transform: the cell's edges must be positive");
  if (!(o.k_max > 0 && std::isfinite(o.k_max))) throw std::invalid_argument("disk_transform: k_max must be positive");
  if (o.kernel_width < 2 || o.kernel_width > 16)
    throw std::invalid_argument("disk_transform: kernel width from 2 to 16");
  for (std::size_t i = 0; i < centre.size(); ++i)
    if (!std::isfinite(centre[i][0]) || !std::isfinite(centre[i][1]) || !(radius[i] >= 0) || !std::isfinite(radius[i]))
      throw std::invalid_argument("disk_transform: coordinates and radii must be finite, radii not negative");
}

// Disks by radius class, and by place within a class so that neighbours touch the same part of the grid.
std::vector<std::size_t> spreading_order(const std::vector<Vec2>& at, std::span<const double> radius,
                                         double class_width, double tile) {
  std::vector<std::size_t> order(at.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::size_t i) {
    return std::tuple(std::floor(radius[i] / class_width), std::floor(at[i][1] / tile), at[i][0], at[i][1]);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

void spread_disks(Grid& grid, const RadialKernel& kernel, const std::vector<Vec2>& at, std::span<const double> radius,
                  const std::vector<double>& weight, double step) {
  const double width = kRadiusClassInSteps * step;
  const auto order = spreading_order(at, radius, width, 8 * step);
  SmoothedDiskTable::Profile profile;
  for (std::size_t begin = 0; begin < order.size();) {
    const double bin = std::floor(radius[order[begin]] / width);
    double low = radius[order[begin]], high = low;
    auto end = begin;
    for (; end < order.size() && std::floor(radius[order[end]] / width) == bin; ++end)
      low = std::min(low, radius[order[end]]), high = std::max(high, radius[order[end]]);
    if (high > 0) {  // points have no area
      const SmoothedDiskTable table(kernel, low, high, step);
      for (auto k = begin; k < end; ++k) {
        const auto i = order[k];
        if (weight[i] == 0) continue;
        table.set_profile(radius[i], profile);
        grid.add(at[i], weight[i], profile);
      }
    }
    begin = end;
  }
}

void spread_points(Grid& grid, const RadialKernel& kernel, std::span<const Vec2> at, std::span<const double> weight,
                   const PeriodicCell<2>& cell, double step) {
  if (at.empty()) return;
  const SmoothedDiskTable table(kernel, 0, 0, step);
  SmoothedDiskTable::Profile profile;
  table.set_profile(0, profile);
  for (std::size_t n = 0; n < at.size(); ++n) grid.add(cell.wrap(at[n]), weight[n], profile);
}

// What a transform needs beside the disks.
struct Plan {
  double modes_x, modes_y;  // mode numbers up to k_max
  std::int64_t nx, ny;      // of the grid
  double step;              // [length] the larger one
  RadialKernel kernel;
};

Plan plan(const PeriodicCell<2>& cell, const TransformOptions& options, int more_width) {
  const double modes_x = options.k_max * cell.length[0] / (2 * kPi),
               modes_y = options.k_max * cell.length[1] / (2 * kPi);
  double oversampling = options.oversampling;
  int width = options.kernel_width + more_width;
  if (oversampling <= 1) {
    const bool large = (4 * modes_x + 4) * (4 * modes_y + 4) > kLargeGrid;
    oversampling = large ? 1.5 : 2;
    if (large) width += 1 + width / 8;  // the same accuracy: w (1 - 1/(2 sigma)) kept
  }
  const double points_x = 2 * oversampling * (modes_x + 1), points_y = 2 * oversampling * (modes_y + 1);
  if (points_x * points_y > kMostGridPoints)
    throw std::length_error("a grid of " + std::to_string(static_cast<long long>(points_x)) + " x " +
                            std::to_string(static_cast<long long>(points_y)) + " points is needed: lower k_max");
  const auto nx = good_size(points_x), ny = good_size(points_y);
  const double step = std::max(cell.length[0] / static_cast<double>(nx), cell.length[1] / static_cast<double>(ny));
  return {modes_x, modes_y,
          nx,      ny,
          step,    {0.5 * width * step, kDecayFraction * kPi * width * (1 - 0.5 / oversampling), options.k_max}};
}

DiskTransform empty_transform(const PeriodicCell<2>& cell, double k_max, const Plan& p) {
  DiskTransform out;
  out.cell = cell, out.k_max = k_max;
  out.mx_max = static_cast<std::int64_t>(std::floor(p.modes_x)),
  // ky = 2 pi (my - mx tilt/L1) / L2
      out.my_max = static_cast<std::int64_t>(
          std::floor(p.modes_y + static_cast<double>(out.mx_max) * std::abs(cell.tilt) / cell.length[0]));
  out.value.assign(static_cast<std::size_t>((out.mx_max + 1) * (2 * out.my_max + 1)), 0.0);
  return out;
}

// Adds the grid's transform times factor(mx, my, k^2) to every mode within k_max.
template <class Factor>
void collect(const Grid& grid, const Plan& p, DiskTransform& out, const Factor& factor) {
  const double cell_area = grid.step()[0] * grid.step()[1], k2_max = out.k_max * out.k_max;
  for (std::int64_t mx = 0; mx <= out.mx_max; ++mx)
    for (std::int64_t my = -out.my_max; my <= out.my_max; ++my) {
      const double k2 = out.k2(mx, my);
      if (k2 > k2_max) continue;
      out.value[static_cast<std::size_t>(mx * (2 * out.my_max + 1) + my + out.my_max)] +=
          cell_area * p.kernel.inverse_transform(k2) * factor(mx, my, k2) * grid.at(mx, my);
    }
}

// chi_hat = (i / k^2) integral of (k.n) exp(-ik.r) along the walls: any overlaps cost no more than the walls are long.
// The wider kernel makes up for the division by k.
DiskTransform transform_of_walls(const WallPoints& walls, const PeriodicCell<2>& cell,
                                 const TransformOptions& options) {
  const Plan p = plan(cell, options, 1);
  Grid grid_x(p.nx, p.ny, cell), grid_y(p.nx, p.ny, cell);
  const SmoothedDiskTable table(p.kernel, 0, 0, p.step);
  SmoothedDiskTable::Profile profile;
  table.set_profile(0, profile);
  for (std::size_t n = 0; n < walls.at.size(); ++n)
    Grid::add(grid_x, grid_y, cell.wrap(walls.at[n]), walls.normal_x[n], walls.normal_y[n], profile);
  auto out = empty_transform(cell, options.k_max, p);
  const auto collect_along = [&](Grid& grid, int axis) {
    grid.transform();
    collect(grid, p, out, [&](std::int64_t mx, std::int64_t my, double k2) {
      const double k = out.k(mx, my)[axis];
      return k2 > 0 ? std::complex<double>(0, k / k2) : 0.0;
    });
  };
  collect_along(grid_x, 0), collect_along(grid_y, 1);
  out.value[static_cast<std::size_t>(out.my_max)] = walls.covered_area;
  return out;
}

}  // namespace

Vec2 DiskTransform::k(std::int64_t mx, std::int64_t my) const {
  const double row = static_cast<double>(my) - static_cast<double>(mx) * cell.tilt / cell.length[0];
  return {{2 * kPi * static_cast<double>(mx) / cell.length[0], 2 * kPi * row / cell.length[1]}};
}

double DiskTransform::k2(std::int64_t mx, std::int64_t my) const {
  const Vec2 wave = k(mx, my);
  return wave[0] * wave[0] + wave[1] * wave[1];
}

DiskTransform disk_transform(std::span<const Vec2> centre, std::span<const double> radius, const PeriodicCell<2>& cell,
                             const TransformOptions& options) {
  check(centre, radius, cell, options);
  const Plan p = plan(cell, options, 0);
  UnionTerms terms;
  if (options.correct_overlaps) {
    auto shallow = union_terms(centre, radius, cell, options.k_max, kOverlapTolerance);
    if (!shallow)
      return transform_of_walls(wall_points(centre, radius, cell, options.k_max, kOverlapTolerance), cell, options);
    terms = std::move(*shallow);
  } else {
    terms.disk_weight.assign(centre.size(), 1);
  }
  Grid grid(p.nx, p.ny, cell);
  std::vector<Vec2> at(centre.begin(), centre.end());
  for (auto& c : at) c = cell.wrap(c);
  spread_disks(grid, p.kernel, at, radius, terms.disk_weight, p.step);
  spread_points(grid, p.kernel, terms.point, terms.point_weight, cell, p.step);
  grid.transform();
  auto out = empty_transform(cell, options.k_max, p);
  collect(grid, p, out, [](std::int64_t, std::int64_t, double) { return 1.0; });
  return out;
}

}  // namespace isostat
