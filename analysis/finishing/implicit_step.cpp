#include "analysis/finishing/implicit_step.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/finishing/gmres.hpp"
#include "analysis/vector_algebra.hpp"

namespace isostat {
namespace {

using Vector = std::vector<double>;

constexpr int kMostIterations = 15, kMostHalvings = 5, kMostKrylov = 60;
constexpr int kMostReused = 20;  // iterations of GMRES with the factor of an earlier iteration of Newton
constexpr double kLinearTolerance = 1e-4;
// Of the velocity: a change from one step to the next that is smaller is a drift that goes on, not a vibration.
constexpr double kSteady = 0.5;

}  // namespace

double ImplicitStep::length(const Vector& x) const {
  double sum = 0;
  for (std::size_t c = 0; c < x.size(); ++c) sum += network_.inertia()[c] * x[c] * x[c];
  return std::sqrt(sum);
}

Vector ImplicitStep::imbalance(const Vector& u, double dt, Links links) {
  Vector r = network_.forces(u, links);
  for (std::size_t c = 0; c < r.size(); ++c) r[c] -= network_.inertia()[c] * (u[c] / dt - velocity_[c]) / dt;
  return r;
}

// A steady drift goes on along its curve: dangling clusters turn as rigid bodies, and a straight guess would stretch
// their contacts to second order, which takes Newton's method most of its iterations to undo. Else no guess.
Vector ImplicitStep::first_guess(double dt) const {
  Vector u(velocity_.size(), 0.0), change(u.size());
  if (!(last_dt_ > 0)) return u;
  for (std::size_t c = 0; c < u.size(); ++c) change[c] = velocity_[c] - before_[c];
  if (!(length(change) < kSteady * length(velocity_))) return u;
  const double part = (dt + last_dt_) / (last_dt_ + dt_before_);  // velocities hold at the middles of their steps
  for (std::size_t c = 0; c < u.size(); ++c) u[c] = dt * (velocity_[c] + part * change[c]);
  if (network_.largest_displacement(u) > network_.largest_step()) std::fill(u.begin(), u.end(), 0.0);
  return u;
}

// Newton's method from a displacement u to the solution of the step, where the network then stands.
const char* ImplicitStep::solve(Vector& u, double dt, const StepTolerance& tolerance, Links links, int& iterations) {
  const double shift = 1 / (dt * dt);
  Vector r = imbalance(u, dt, links), trial(u.size());
  bool stale = true;  // the factor
  while (!(largest(r) <= tolerance.imbalance)) {
    if (++iterations > kMostIterations) return "Newton's method does not converge";
    if (stale && !factor_.factorise(network_.shifted_stiffness(shift), network_.patterns()))
      return "the tangent stiffness is not positive";
    const LinearSolution newton = gmres(
        [&](const Vector& x) {
          Vector y = network_.stiffness_times(x);
          for (std::size_t c = 0; c < y.size(); ++c) y[c] += shift * network_.inertia()[c] * x[c];
          return y;
        },
        [&](const Vector& x) { return factor_.solve(x); }, r, kLinearTolerance, stale ? kMostKrylov : kMostReused);
    if (!(newton.residual <= kLinearTolerance) && !stale) {
      stale = true;
      continue;
    }
    stale = false;
    if (!(newton.residual < 0.5)) return "the linear solve does not converge";
    // Natural monotonicity test (Deuflhard 2004, Sec. 3.3): imbalances are compared by the displacements that the
    // same factor answers them with. Measured as forces, the second-order stretching of stiff contacts by a long
    // floppy motion would look like a failure, although the next iteration takes it away at no cost.
    const double size = length(factor_.solve(r));
    double fraction = std::min(1.0, network_.largest_step() / network_.largest_displacement(newton.x));
    bool better = false;
    for (int half = 0; half <= kMostHalvings && !better; ++half, fraction *= 0.5) {
      for (std::size_t c = 0; c < u.size(); ++c) trial[c] = u[c] + fraction * newton.x[c];
      Vector after = imbalance(trial, dt, links);
      better = largest(after) <= tolerance.imbalance ||  // solved: what is left of floppy displacements is rounding
               length(factor_.solve(after)) <= (1 - 0.25 * fraction) * size;
      if (better) r = std::move(after);
    }
    if (!better) {
      if (!(largest(r) <= tolerance.floor)) return "no step along Newton's direction lowers the imbalance";
      network_.forces(u, links);  // back from the last trial
      return nullptr;
    }
    u.swap(trial);
    if (network_.largest_displacement(u) > 1.5 * network_.largest_step()) return "a grain moves too far in one step";
  }
  return nullptr;
}

StepOutcome ImplicitStep::take(double dt, const StepTolerance& tolerance, Captures captures) {
  StepOutcome o;
  Vector u = first_guess(dt);
  const auto captured = [&] {
    if (captures == Captures::refuse) o.capture = network_.first_capture();
    return o.capture.has_value();
  };
  if (network_.cohesive()) {
    if (const char* why = solve(u, dt, tolerance, Links::hold, o.iterations)) return refuse(o, why);
    if (captured()) return refuse(o, "two grains come within reach");
  }
  if (const char* why = solve(u, dt, tolerance, Links::act, o.iterations)) return refuse(o, why);
  if (captured()) return refuse(o, "two grains come within reach");
  network_.accept(u);
  before_ = velocity_, dt_before_ = last_dt_, last_dt_ = dt;
  for (std::size_t c = 0; c < u.size(); ++c) velocity_[c] = u[c] / (dt * (1 + drag_ * dt));
  for (std::size_t g = 0; g < network_.grains(); ++g)  // a rattler rests until it is met
    if (!network_.counts(g)) std::fill_n(velocity_.begin() + static_cast<std::ptrdiff_t>(3 * g), 3, 0.0);
  o.accepted = true;
  o.displacement = network_.largest_displacement(u);
  return o;
}

StepOutcome ImplicitStep::refuse(StepOutcome o, const char* why) {
  network_.forces(Vector(network_.size(), 0.0));
  o.refused = why;
  return o;
}

void ImplicitStep::stop() {
  std::fill(velocity_.begin(), velocity_.end(), 0.0);
  last_dt_ = 0;
}

}  // namespace isostat
