#include "dem/triangles/stable_step.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "dem/input_error.hpp"
#include "dem/triangles/gear_scheme.hpp"
#include "dem/triangles/grain_spectrum.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// In the modes without dampers, the fastest first, in coordinates in which the mass is 1.
struct Modes {
  Index deforming = 0;                 // the first so many; after them rigid motions
  VectorXd squared_frequency;          // omega^2 [1/s^2]
  MatrixXd damping, averaged_damping;  // C [1/s], and the part of it that sees the mean of the spin
  Modes fastest(Index n) const {
    return {n, squared_frequency.head(n), damping.topLeftCorner(n, n), averaged_damping.topLeftCorner(n, n)};
  }
};

Modes modes_of(const GrainTemplate& grain, SpinInDampers spin) {
  const GrainMatrices m = grain_matrices(grain);
  const auto n = static_cast<Index>(m.size);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const VectorXd scale = Eigen::Map<const VectorXd>(m.mass.data(), n).cwiseSqrt().cwiseInverse();
  const MatrixXd damping = scale.asDiagonal() * Eigen::Map<const RowMajor>(m.damping.data(), n, n) * scale.asDiagonal();
  const MatrixXd stiffness =
      scale.asDiagonal() * Eigen::Map<const RowMajor>(m.stiffness.data(), n, n) * scale.asDiagonal();
  MatrixXd averaged = MatrixXd::Zero(n, n);  // no spin enters the torque on another body: that part is diagonal
  for (Index d = 2; d < n; d += 3)
    if (spin == SpinInDampers::torque)
      averaged(d, d) = damping(d, d);
    else
      averaged.col(d) = damping.col(d);
  const std::vector<double> omega = grain_frequencies(grain);
  Modes modes;
  modes.deforming = std::count_if(omega.begin(), omega.end(), [](double w) { return w > 0; });
  modes.squared_frequency = Eigen::Map<const VectorXd>(omega.data(), n).reverse().cwiseAbs2();
  const MatrixXd shape = Eigen::SelfAdjointEigenSolver<MatrixXd>(stiffness).eigenvectors().rowwise().reverse();
  modes.damping = shape.transpose() * damping * shape;
  modes.averaged_damping = shape.transpose() * averaged * shape;
  return modes;
}

double spectral_radius(const MatrixXd& map) {
  return Eigen::EigenSolver<MatrixXd>(map, false).eigenvalues().cwiseAbs().maxCoeff();
}

// Of (x(n), v(n-1/2) dt, a(n-1) dt^2), with D the averaged part of C and v(n-1/2) = v, a(n-1) = a:
//   (1 + D dt/2) a(n) = -K x - C v - (C - D) a dt/2,   v(n+1/2) = v + a(n) dt,   x(n+1) = x + v(n+1/2) dt
// A rigid motion acts by its acceleration alone: C v = 0 for any rigid v, so its x and v are left out.
double verlet_radius(const Modes& m, double dt) {
  const Index q = m.deforming, n = m.damping.rows();
  MatrixXd right = MatrixXd::Zero(n, 2 * q + n);
  right.topLeftCorner(q, q).diagonal() = -dt * dt * m.squared_frequency.head(q);
  right.middleCols(q, q) = -dt * m.damping.leftCols(q);
  right.rightCols(n) = -dt / 2 * (m.damping - m.averaged_damping);
  const MatrixXd left = MatrixXd::Identity(n, n) + dt / 2 * m.averaged_damping;
  MatrixXd map(2 * q + n, 2 * q + n);
  map.bottomRows(n) = left.partialPivLu().solve(right);
  map.middleRows(q, q) = map.middleRows(2 * q, q);
  map.middleRows(q, q).middleCols(q, q) += MatrixXd::Identity(q, q);
  map.topRows(q) = map.middleRows(q, q);
  map.topLeftCorner(q, q) += MatrixXd::Identity(q, q);
  return spectral_radius(map);
}

// Of the five values of each mode. Rigid motions meet no force and are left out.
double gear_radius(const Modes& m, double dt) {
  const Index q = m.deforming;
  MatrixXd predicted = MatrixXd::Zero(5 * q, 5 * q);
  for (Index k = 0; k < 5; ++k)
    for (Index l = k; l < 5; ++l)
      predicted.block(k * q, l * q, q, q).diagonal().setConstant(kGearPredictor[idx(k)][idx(l)]);
  MatrixXd error = -predicted.middleRows(2 * q, q);  // a dt^2/2 of the force less that predicted
  error -= dt * dt / 2 * (m.squared_frequency.head(q).asDiagonal() * predicted.topRows(q));
  error -= dt / 2 * (m.damping.topLeftCorner(q, q) * predicted.middleRows(q, q));
  for (Index k = 0; k < 5; ++k) predicted.middleRows(k * q, q) += kGearCorrector[idx(k)] * error;
  return spectral_radius(predicted);
}

constexpr double kFirst = 0.02, kRatio = 1.25;  // scan: first step [1/(omega_max + largest damping rate)], then times
constexpr double kWidth = 1e-7;                 // relative, of the answer
constexpr Index kFewModes = 24;                 // scanned first, where the grain has more
constexpr double kFirstStride = 1e-3;           // from there on with all modes, relative
constexpr double kCoarseWidth = 1e-5;           // then, for maps of thousands of rows are slow

// The first step at which stable(dt) fails, from below: stable(low) holds.
template <class Stable>
double bisect(double low, double high, const Stable& stable, double width) {
  while (high - low > width * low) {
    const double middle = low + (high - low) / 2;
    (stable(middle) ? low : high) = middle;
  }
  return low;
}

// The fastest modes set the limit, and give it within a few percent; it is then bracketed with all of them.
Modes fastest_of(const Modes& modes) { return modes.deforming > kFewModes ? modes.fastest(kFewModes) : modes; }

template <class Radius>
double limit(const Modes& modes, const Radius& radius) {
  if (modes.deforming == 0) return std::numeric_limits<double>::infinity();
  const auto stable_with = [&](const Modes& m) {
    return [&m, &radius](double dt) { return radius(m, dt) <= 1 + kStableGrowth; };
  };
  const Modes few = fastest_of(modes);
  const auto stable = stable_with(few);
  double unstable = kFirst / (std::sqrt(few.squared_frequency[0]) + few.damping.norm());
  while (stable(unstable)) unstable *= kRatio;
  const double found = bisect(unstable / kRatio, unstable, stable, kWidth);
  if (few.deforming == modes.deforming) return found;
  const auto all = stable_with(modes);
  double low = found, high = found, step = kFirstStride;
  if (all(found)) {
    do low = high, high *= 1 + step, step *= 4;
    while (all(high));
  } else {
    do high = low, low /= 1 + step, step *= 4;
    while (!all(low));
  }
  return bisect(low, high, all, kCoarseWidth);
}

void refuse_many(const GrainTemplate& grain) {
  if (grain.triangles.size() > kMostTrianglesOfAStep)
    throw InputError("grain", 0, "shape", std::to_string(grain.triangles.size()) + " triangles",
                     "at most " + std::to_string(kMostTrianglesOfAStep) + " for the stable step of a grain");
}

}  // namespace

StableStep stable_step(const GrainTemplate& grain, SpinInDampers spin) {
  refuse_many(grain);
  const Modes modes = modes_of(grain, spin);
  return {limit(modes, gear_radius), limit(modes, verlet_radius)};
}

double stable_step_estimate(const GrainTemplate& grain, Integrator integrator) {
  refuse_many(grain);
  const Modes modes = fastest_of(modes_of(grain, SpinInDampers::torque_and_force));
  return integrator == Integrator::gear ? limit(modes, gear_radius) : limit(modes, verlet_radius);
}

}  // namespace isostat
