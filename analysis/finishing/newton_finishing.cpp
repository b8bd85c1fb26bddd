#include "analysis/finishing/newton_finishing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/finishing/implicit_step.hpp"
#include "analysis/finishing/settling_network.hpp"
#include "analysis/vector_algebra.hpp"

#include "dem/disks/energy.hpp"

namespace isostat {
namespace {

using Vector = std::vector<double>;

constexpr double kFirstStep = 0.1;  // [T0] length of the first implicit step
// The attraction does work F0 D0 / 2 when two grains catch each other, at V* = sqrt(F0 D0 / m) and with contact forces
// of ten F0: what is left by that in the force network depends on dynamics, which long implicit steps don't have.
constexpr double kNearCapture = 0.5;    // [T0] how far before it the implicit steps stop
constexpr double kShortestStep = 1e-4;  // [T0] shorter ones are what the explicit solver is for
constexpr double kFactorisation =
    200;  // [explicit steps] what one costs, with its linear solve (docs/measured/equilibrium.md)
constexpr std::int64_t kOnTrial = 40;    // [factorisations] between two looks at whether they are worth it
constexpr int kEasyIterations = 6;       // of Newton
constexpr int kMostSteps = 400;          // that follow the motion
constexpr int kMostPolishing = 100;      // from rest
constexpr int kUsualPolishing = 12;      // are enough but for a mode that is softer than the longest step regularises
constexpr double kLonger = 32;           // [-] then steps grow beyond that, to 1e-12 of K_N: well above rounding
constexpr double kStepTolerance = 1e-3;  // of the force tolerance: how well an implicit step's equations are met
constexpr double kDriftLeft = 1e-2;      // of the kinetic tolerance. Vibrations die at once here, but they are most
                                         // of the energy that lets floppy modes drift on under the bare law: to
// stop at the tolerance itself would miss contacts (docs/measured/equilibrium.md)
constexpr double kFreed = 10, kCaptures = 10;  // the kinetic energy may reach so many times its start, and the work of
                                               // so many attractions F0 D0 beside; beyond it is a collapse
constexpr double kShift = 1e-9;    // of K_N: inertia / dt^2 is never less, so that floppy modes stay regular
constexpr double kTarget = 1e-10;  // [F1] net force, [F1 a] moment, [F1/a] stress error at rest
constexpr double kRounding = 4;    // of the force K_N eps max(L) of one rounding of a coordinate
constexpr double kAtRest = 1e-6;   // [a] a step of the longest dt from rest that moves nothing further found rest

// The length of the next step: up to kGrow times longer after an easy one, kShrink after a refused one, and then only
// slowly back to what was refused; up to a capture where there is one.
class StepLength {
 public:
  explicit StepLength(double first) : dt_(first) {}
  double value() const { return dt_; }
  void accepted(bool easy, double bound) {
    ceiling_ *= kRecover;
    dt_ = std::max(std::min({easy ? kGrow * dt_ : dt_, bound, ceiling_}), kShortestStep);
  }
  void refused() { ceiling_ = 0.5 * dt_, dt_ *= kShrink; }
  void shortened(double dt) { dt_ = dt; }
  bool too_short() const { return dt_ < kShortestStep; }
  template <class Io>
  void transfer(Io& io) {
    io.real(dt_), io.real(ceiling_);
  }

 private:
  static constexpr double kGrow = 4, kShrink = 0.25, kRecover = 1.5;
  double dt_, ceiling_ = INFINITY;  // [T0]
};

class Settling {
 public:
  Settling(State<Disks>& state, const FinishingRequest<2>& request,
           const std::function<void(const SettlingStep&)>& watch)
      : s_(state),
        request_(request),
        network_(state, request),
        step_(network_, network_.velocities(state), request.drag),
        watch_(watch) {
    for (const auto& stress : request.stress)
      if (stress) scale_ = std::max(scale_, std::abs(*stress));
    if (request.stress.shear) scale_ = std::max(scale_, std::abs(*request.stress.shear));
    scale_ = std::max(scale_, s_.law.attraction);
    if (!(scale_ > 0)) scale_ = 1;
    const Vec2& length = network_.extent();
    target_ = std::max(kTarget * scale_, kRounding * s_.law.normal_stiffness * std::numeric_limits<double>::epsilon() *
                                             std::max(length[0], length[1]));
    double lightest = INFINITY;
    for (double m : s_.packing.bodies.mass) lightest = std::min(lightest, m);
    longest_ = std::sqrt(lightest / (kShift * s_.law.normal_stiffness));
  }

  FinishingReport run() {
    if (!s_.memory.solve.numbers.empty()) go_on();
    if (polishing_ || follow()) polish();
    if (!report_.interrupted) s_.memory.solve = {};
    return report_;
  }

 private:
  // What the packing still does, inertia and all, until the criteria are met and no drift is left. False: that is
  // where it ends, the report says why.
  bool follow() {
    StepLength& dt = dt_;
    const EquilibriumScene& t = s_.scene.equilibrium;
    const StepTolerance tolerance{std::max(kStepTolerance * std::min(t.force, t.pressure) * scale_, target_), 0};
    if (!(allowed_ > 0))
      allowed_ = kFreed * std::max(kinetic(), t.kinetic_energy * scale_) +
                 kCaptures * s_.law.attraction * s_.law.attraction_range / static_cast<double>(network_.grains());
    while (report_.steps < kMostSteps) {
      if (interrupted()) return give_up("interrupted");
      if (step_.factorisations() >= due_) {
        const bool worth_it = gained_ >= kFactorisation * static_cast<double>(kOnTrial) * s_.time_step;
        const char* const why = "the steps are too short to be worth it";
        if (!worth_it) return due_ == kOnTrial ? give_up(why) : stuck(why);
        gained_ = 0, due_ = step_.factorisations() + kOnTrial;
      }
      const StepOutcome o = take(dt.value(), tolerance, Captures::refuse);
      if (o.capture && dt.value() <= kNearCapture) {
        report_.capture = true;
        return stop_here("two grains come within reach of each other");
      }
      if (o.capture) {
        dt.shortened(std::max(*o.capture * dt.value() - 0.5 * kNearCapture, kNearCapture));
        continue;
      }
      if (!o.accepted) {
        dt.refused();
        if (dt.too_short()) return give_up(std::string("an implicit step failed: ") + o.refused);
        continue;
      }
      if (kinetic() > allowed_) return give_up("the packing sets kinetic energy free");
      gained_ += dt.value();
      const double drift = network_.largest_displacement(step_.velocity());  // [a] per T0
      dt.accepted(o.iterations <= kEasyIterations,
                  drift > 0 ? std::min(longest_, 0.5 * network_.largest_step() / drift) : longest_);
      // Without cohesion only rattlers drift.
      if (!request_.drift_only && criteria_met(s_.law.attraction > 0 ? kDriftLeft : 1.0)) return true;
    }
    if (request_.drift_only) return stop_here("no grains came within reach of each other");
    // As for the bare law, the criteria decide.
    return criteria_met(1) ||
           stop_here("the criteria are not met after " + std::to_string(kMostSteps) + " implicit steps");
  }

  // From here on every step starts from rest: what moves, moves because a force drives it.
  void polish() {
    StepLength& dt = dt_;
    const StepTolerance tolerance{0.1 * target_, target_};
    if (!polishing_) {
      polishing_ = true;
      step_.stop();
      last_.assign(network_.size(), 0.0);
    }
    for (int& k = polished_; k < kMostPolishing && !dt.too_short() && !report_.settled; ++k) {
      report_.settled = residual() <= target_;
      if (report_.settled) break;
      if (interrupted()) {
        give_up("interrupted");
        return;
      }
      const StepOutcome o = take(dt.value(), tolerance, Captures::pass);
      if (!o.accepted) {
        dt.refused();
        continue;
      }
      report_.settled = o.displacement < kAtRest && dt.value() >= longest_;
      last_ = step_.velocity();
      step_.stop();
      dt.accepted(true, longest_ * std::clamp(std::exp2(k - kUsualPolishing), 1.0, kLonger));
    }
    if (report_.settled) {
      keep();
      return;
    }
    const double fast = 0.1 * network_.largest_displacement(last_);
    for (std::size_t r = 0; r < network_.grains(); ++r)
      report_.moving += std::hypot(last_[3 * r], last_[3 * r + 1]) > fast;
    if (report_.moving == 0) report_.moving = static_cast<std::int64_t>(network_.grains());  // the cell carries all
    stuck("floppy or very soft modes still move " + std::to_string(report_.moving) + " grains");
  }

  StepOutcome take(double dt, const StepTolerance& tolerance, Captures captures) {
    const StepOutcome o = step_.take(dt, tolerance, captures);
    report_.steps += o.accepted;
    if (watch_)
      watch_({report_.steps, captures == Captures::pass, dt, o.accepted, o.iterations, residual() / scale_,
              kinetic() / scale_, o.displacement, o.refused});
    return o;
  }

  // The solve stands between two steps: it may be kept in the state here.
  bool interrupted() {
    report_.interrupted = request_.interrupted && request_.interrupted();
    const bool due = request_.checkpoint_due && request_.checkpoint_due();
    if (report_.interrupted || due) {
      SolveWriter io;
      network_.transfer(io);
      step_.transfer(io);
      transfer(io);
      s_.memory.solve = io.take();
    }
    if (due) request_.checkpoint();
    return report_.interrupted;
  }
  void go_on() {
    const SolveMemory memory = std::move(s_.memory.solve);
    s_.memory.solve = {};
    SolveReader io(memory);
    network_.transfer(io);
    step_.transfer(io);
    transfer(io);
    io.end();
    SolveReader::require(!polishing_ || last_.size() == network_.size());
  }
  template <class Io>
  void transfer(Io& io) {
    dt_.transfer(io);
    io.real(gained_), io.real(allowed_);
    io.whole(due_), io.whole(report_.steps), io.whole(polished_);
    std::int32_t polishing = polishing_;
    io.whole(polishing);
    if constexpr (!Io::writes) polishing_ = polishing != 0;
    transfer_reals(io, last_);
  }

  void keep() {
    const double before = without_injection(s_);
    network_.store(s_, step_.velocity());
    s_.ledger.injected += without_injection(s_) - before;
    report_.residual = residual() / scale_;
    report_.factorisations = step_.factorisations();
  }
  bool stop_here(std::string reason) {
    report_.advanced = report_.steps > 0;
    if (report_.advanced) keep();
    return give_up(std::move(reason));
  }
  bool stuck(std::string reason) {
    report_.stuck = true;
    return stop_here(std::move(reason));
  }
  bool give_up(std::string reason) {
    report_.reason = std::move(reason);
    report_.residual = residual() / scale_;
    report_.factorisations = step_.factorisations();
    return false;
  }

  static double without_injection(const State<Disks>& state) {
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
        energy += 0.5 * network_.inertia()[c] * step_.velocity()[c] * step_.velocity()[c];
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

  State<Disks>& s_;
  const FinishingRequest<2>& request_;
  SettlingNetwork network_;
  ImplicitStep step_;
  const std::function<void(const SettlingStep&)>& watch_;
  double scale_ = 0, target_ = 0;  // [F0] F1, and the imbalance at rest
  double longest_ = 0;             // [T0]
  StepLength dt_{kFirstStep};
  double gained_ = 0;            // [T0] since the last look at whether the steps are worth it
  std::int64_t due_ = kOnTrial;  // [factorisations] the next one
  double allowed_ = 0;           // [F0 a] kinetic energy per grain that is no collapse; 0: not known yet
  bool polishing_ = false;       // from rest
  int polished_ = 0;             // steps from rest
  Vector last_;                  // [a/T0] velocities of the last one
  FinishingReport report_;
};

}  // namespace

FinishingReport NewtonFinishing::settle(State<Disks>& state, const FinishingRequest<2>& request) {
  return Settling(state, request, watch_).run();
}

}  // namespace isostat
