#include "analysis/finishing/newton_finishing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/finishing/gmres.hpp"
#include "analysis/finishing/repeated_cholesky.hpp"
#include "analysis/finishing/settling_network.hpp"
#include "analysis/vector_algebra.hpp"
#include "dem/energy.hpp"
#include "dem/equilibrium.hpp"

namespace isostat {
namespace {

using Vector = std::vector<double>;

constexpr double kFirstStep = 0.1;  // [T0] length of the first implicit step
// The attraction does work F0 D0 / 2 when two grains catch each other, at V* = sqrt(F0 D0 / m) and with contact forces
// of ten F0: what is left by that in the force network depends on dynamics, which long implicit steps don't have.
constexpr double kNearCapture = 0.5;  // [T0] how far before it the implicit steps stop
constexpr double kWorthwhile = 0.05;  // [T0] shorter steps cost more than the explicit solver does
constexpr int kMostShort = 30;
constexpr double kShortestStep = 1e-4;       // [T0] shorter ones are what the explicit solver is for
constexpr double kGrow = 4, kShrink = 0.25;  // of the step, after an easy and after a refused one
constexpr int kEasyIterations = 6, kMostIterations = 25, kMostHalvings = 8;
constexpr int kMostSteps = 400, kMostPolishing = 60, kStalled = 12;
constexpr double kStepTolerance = 1e-3;  // of the force tolerance: how well an implicit step's equations are met
constexpr double kLinearTolerance = 1e-4;
constexpr int kMostKrylov = 60;
constexpr double kDriftLeft = 1e-2;  // of the kinetic tolerance. Vibrations die at once here, but they are most
                                     // of the energy that lets floppy modes drift on under the bare law: to
                                     // stop at the tolerance itself would miss contacts (docs/equilibrium.md)
constexpr double kFreed = 10, kCaptures = 10;  // the kinetic energy may reach so many times its start, and the work of
                                               // so many attractions F0 D0 beside; beyond it is a collapse
constexpr double kShift = 1e-9;    // of K_N: inertia / dt^2 is never less, so that floppy modes stay regular
constexpr double kTarget = 1e-10;  // [F1] net force, [F1 a] moment, [F1/a] stress error at rest
constexpr double kRounding = 4;    // of the force K_N eps max(L) of one rounding of a coordinate

class Settling {
 public:
  Settling(State& state, const FinishingRequest& request, const std::function<void(const SettlingStep&)>& watch)
      : s_(state), request_(request), network_(state, request), watch_(watch) {
    for (const auto& stress : request.stress)
      if (stress) scale_ = std::max(scale_, std::abs(*stress));
    scale_ = std::max(scale_, s_.law.attraction);
    if (!(scale_ > 0)) scale_ = 1;
    const Vec2& length = state.packing.cell->length;
    floor_ =
        kRounding * s_.law.normal_stiffness * std::numeric_limits<double>::epsilon() * std::max(length[0], length[1]);
    double lightest = INFINITY;
    for (double m : s_.packing.bodies.mass) lightest = std::min(lightest, m);
    longest_ = std::sqrt(lightest / (kShift * s_.law.normal_stiffness));
    velocity_ = network_.velocities(state);
  }

  FinishingReport run() {
    const double allowed =
        kFreed * std::max(kinetic(), s_.scene.equilibrium.kinetic_energy * scale_) +
        kCaptures * s_.law.attraction * s_.law.attraction_range / static_cast<double>(network_.grains());
    double dt = kFirstStep;
    bool met = false;
    int short_steps = 0;
    while (!met && report_.steps < kMostSteps) {
      if (interrupted()) return refuse("interrupted");
      const Outcome o = step(dt, false);
      if (o.captures && dt <= kNearCapture) {
        report_.capture = true;
        if (report_.steps > 0) keep(), report_.advanced = true;
        return refuse("two grains come within reach of each other");
      }
      if (!o.accepted) {
        dt *= kShrink;
        if (dt < kShortestStep) return refuse(std::string("an implicit step failed: ") + o.refused);
        continue;
      }
      ++report_.steps;
      if (dt < kWorthwhile && ++short_steps > kMostShort) return refuse("the steps stay too short to be worth it");
      if (kinetic() > allowed) return refuse("the packing sets kinetic energy free");
      met = !request_.drift_only &&
            criteria_met(s_.law.attraction > 0 ? kDriftLeft : 1.0);  // without cohesion only rattlers drift
      dt = next_step(dt, o.iterations);
    }
    if (request_.drift_only) {
      keep(), report_.advanced = true;
      return refuse("no grains came within reach of each other");
    }
    // As for the bare law, the criteria decide; a drift that never ends is named by polish() if a force drives it.
    if (!met && !criteria_met(1))
      return refuse("the criteria are not met after " + std::to_string(kMostSteps) + " implicit steps");
    if (!polish(dt)) return refuse("interrupted");
    keep();
    report_.settled = true;
    report_.factorisations = factor_.factorisations();
    report_.residual = residual() / scale_;
    return report_;
  }

 private:
  struct Outcome {
    bool accepted = false, captures = false;
    int iterations = 0;
    double displacement = 0;  // [a]
    const char* refused = "";
  };

  bool interrupted() {
    report_.interrupted = request_.interrupted && request_.interrupted();
    return report_.interrupted;
  }

  void keep() {
    const double before = without_injection(s_);
    network_.store(s_, velocity_);
    s_.ledger.injected += without_injection(s_) - before;
  }

  FinishingReport refuse(std::string reason) {
    report_.reason = std::move(reason);
    report_.residual = residual() / scale_;
    report_.factorisations = factor_.factorisations();
    return report_;
  }

  static double without_injection(const State& state) {
    Energies e = energies(state);
    e.ledger.injected = 0;
    return e.total();
  }

  // As the certificate counts it [F0 a].
  double kinetic() const {
    double energy = 0;
    std::size_t counted = 0;
    for (std::size_t r = 0; r < network_.grains(); ++r) {
      if (!network_.counts(r)) continue;
      ++counted;
      for (std::size_t c = 3 * r; c < 3 * r + 3; ++c)
        energy += 0.5 * network_.inertia()[c] * velocity_[c] * velocity_[c];
    }
    return counted ? energy / static_cast<double>(counted) : 0.0;
  }
  double residual() const {
    const SettlingNetwork::Balance b = network_.balance();
    return std::max({b.force, b.moment, b.stress});
  }
  bool criteria_met(double kinetic_part) const {
    const SettlingNetwork::Balance b = network_.balance();
    const EquilibriumScene& t = s_.scene.equilibrium;
    return b.force < t.force * scale_ && b.moment < t.force * scale_ && b.stress < t.pressure * scale_ &&
           kinetic() < kinetic_part * t.kinetic_energy * scale_;
  }

  double next_step(double dt, int iterations) const {
    if (iterations <= kEasyIterations) dt *= kGrow;
    const double drift = network_.largest_displacement(velocity_);  // per T0
    if (drift > 0) dt = std::min(dt, 0.5 * network_.largest_step() / drift);
    return std::clamp(dt, kShortestStep, longest_);
  }

  // Backward Euler:  force(x + u) = inertia (u / dt - v) / dt, solved by Newton's method with the exact tangent, GMRES
  // preconditioned by the factorised symmetric part. Vibrations faster than dt die out; drift and momentum are kept.
  Outcome step(double dt, bool from_rest) {
    Outcome o;
    const Vector& inertia = network_.inertia();
    Vector u(network_.size(), 0.0), trial(u.size());
    const auto imbalance = [&](const Vector& at) {
      Vector r = network_.forces(at);
      for (std::size_t c = 0; c < r.size(); ++c)
        r[c] -= inertia[c] * (at[c] / dt - (from_rest ? 0.0 : velocity_[c])) / dt;
      return r;
    };
    const auto length = [&](const Vector& x) {  // weighted by inertia
      double sum = 0;
      for (std::size_t c = 0; c < x.size(); ++c) sum += inertia[c] * x[c] * x[c];
      return std::sqrt(sum);
    };
    const double shift = 1 / (dt * dt);
    Vector r = imbalance(u);
    const double tolerance =
        from_rest
            ? 0.1 * std::max(kTarget * scale_, floor_)
            : std::max(kStepTolerance * std::min(s_.scene.equilibrium.force, s_.scene.equilibrium.pressure) * scale_,
                       floor_);
    while (!(largest(r) <= tolerance)) {
      if (++o.iterations > kMostIterations) return reject(o, dt, "Newton's method does not converge");
      if (!factor_.factorise(network_.shifted_stiffness(shift), network_.patterns()))
        return reject(o, dt, "the tangent stiffness is not positive");
      const LinearSolution newton = gmres(
          [&](const Vector& x) {
            Vector y = network_.stiffness_times(x);
            for (std::size_t c = 0; c < y.size(); ++c) y[c] += shift * inertia[c] * x[c];
            return y;
          },
          [&](const Vector& x) { return factor_.solve(x); }, r, kLinearTolerance, kMostKrylov);
      if (!(newton.residual < 0.5)) return reject(o, dt, "the linear solve does not converge");
      // Natural monotonicity test (Deuflhard 2004, Sec. 3.3): imbalances are compared by the displacements that the
      // same factor answers them with. Measured as forces, the second-order stretching of stiff contacts by a long
      // floppy motion would look like a failure, although the next iteration takes it away at no cost.
      const double size = length(factor_.solve(r));
      double fraction = std::min(1.0, network_.largest_step() / network_.largest_displacement(newton.x));
      bool better = false;
      for (int half = 0; half <= kMostHalvings && !better; ++half, fraction *= 0.5) {
        for (std::size_t c = 0; c < u.size(); ++c) trial[c] = u[c] + fraction * newton.x[c];
        Vector after = imbalance(trial);
        better = length(factor_.solve(after)) <= (1 - 0.25 * fraction) * size;
        if (better) r = std::move(after);
      }
      if (!better) {
        // At the floor of rounding there is nothing left to win.
        if (from_rest && largest(r) <= std::max(kTarget * scale_, floor_)) break;
        return reject(o, dt, "no step along Newton's direction lowers the imbalance");
      }
      u.swap(trial);
      if (network_.largest_displacement(u) > 1.5 * network_.largest_step())
        return reject(o, dt, "a grain moves too far in one step");
    }
    network_.forces(u);
    if (!from_rest && network_.captures()) {
      o.captures = true;
      return reject(o, dt, "two grains come within reach");
    }
    network_.accept(u);
    for (std::size_t c = 0; c < u.size(); ++c) velocity_[c] = u[c] / (dt * (1 + request_.drag * dt));
    for (std::size_t g = 0; g < network_.grains(); ++g)  // a rattler rests until it is met
      if (!network_.counts(g)) std::fill_n(velocity_.begin() + static_cast<std::ptrdiff_t>(3 * g), 3, 0.0);
    o.accepted = true;
    o.displacement = network_.largest_displacement(u);
    tell(o, dt, from_rest);
    return o;
  }

  Outcome reject(Outcome o, double dt, const char* why) {
    network_.forces(Vector(network_.size(), 0.0));
    o.refused = why;
    tell(o, dt, false);
    return o;
  }
  void tell(const Outcome& o, double dt, bool polishing) const {
    if (watch_)
      watch_({report_.steps, polishing, dt, o.accepted, o.iterations, residual() / scale_, kinetic() / scale_,
              o.displacement, o.refused});
  }

  // From here on every step starts from rest: what moves, moves because a force drives it. False: interrupted.
  bool polish(double dt) {
    const double target = std::max(kTarget * scale_, floor_);
    double best = residual();
    int since_best = 0;
    std::fill(velocity_.begin(), velocity_.end(), 0.0);
    Vector last(network_.size(), 0.0);
    for (int k = 0; k < kMostPolishing && residual() > target && since_best < kStalled; ++k) {
      if (interrupted()) return false;
      const Outcome o = step(dt, true);
      if (!o.accepted) {
        dt *= kShrink;
        if (dt < kShortestStep) break;
        ++since_best;
        continue;
      }
      ++report_.steps;
      last = velocity_;
      std::fill(velocity_.begin(), velocity_.end(), 0.0);
      dt = std::min(kGrow * dt, longest_);
      since_best = residual() < 0.5 * best ? 0 : since_best + 1;
      best = std::min(best, residual());
    }
    if (residual() <= target) return true;
    const double fast = 0.1 * network_.largest_displacement(last);
    for (std::size_t r = 0; r < network_.grains(); ++r)
      report_.moving += std::hypot(last[3 * r], last[3 * r + 1]) > fast;
    if (report_.moving == 0) report_.moving = static_cast<std::int64_t>(network_.grains());  // the cell carries all
    report_.reason = "a floppy or very soft mode is still moving";
    return true;
  }

  State& s_;
  const FinishingRequest& request_;
  SettlingNetwork network_;
  const std::function<void(const SettlingStep&)>& watch_;
  RepeatedCholesky factor_;
  Vector velocity_;  // [a/T0] by unknown
  double scale_ = 0, floor_ = 0, longest_ = 0;
  FinishingReport report_;
};

}  // namespace

FinishingReport NewtonFinishing::settle(State& state, const FinishingRequest& request) {
  return Settling(state, request, watch_).run();
}

}  // namespace isostat
