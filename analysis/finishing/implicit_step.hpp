// One implicit step of a packing that settles: backward Euler,
//   force(x + u) = inertia (u / dt - v) / dt,
// solved by Newton's method with the exact tangent; GMRES, preconditioned by the Cholesky factor of its symmetric part.
// Vibrations faster than dt die out; drift and momentum are kept.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/finishing/repeated_cholesky.hpp"
#include "analysis/finishing/settling_network.hpp"

namespace isostat {

// What is asked of the equations of a step.
struct StepTolerance {
  double imbalance = 0;  // [F0] to reach
  double floor = 0;      // [F0] good enough when rounding lets nothing better be found
};

struct StepOutcome {
  bool accepted = false;
  std::optional<double> capture;  // the part of the step after which it was refused as a capture
  int iterations = 0;             // of Newton
  double displacement = 0;        // [a] largest
  const char* refused = "";
};

// A step that would bring a cohesive pair within reach or into contact: refused, or taken all the same.
enum class Captures { refuse, pass };

class ImplicitStep {
 public:
  // The network is at its accepted configuration and stays so when a step is refused.
  ImplicitStep(SettlingNetwork& network, std::vector<double> velocity, double drag)
      : network_(network), drag_(drag), velocity_(std::move(velocity)), before_(velocity_.size(), 0.0) {}

  StepOutcome take(double dt, const StepTolerance& tolerance, Captures captures);  // dt [T0]
  void stop();                                                                     // from here on: at rest

  const std::vector<double>& velocity() const { return velocity_; }  // [a/T0] by unknown
  std::int64_t factorisations() const { return earlier_ + factor_.factorisations(); }

  // Between two steps, beside the network.
  template <class Io>
  void transfer(Io& io) {
    transfer_reals(io, velocity_);
    transfer_reals(io, before_);
    io.real(last_dt_), io.real(dt_before_);
    std::int64_t done = factorisations();
    io.whole(done);
    if constexpr (!Io::writes) {
      earlier_ = done - factor_.factorisations();
      SolveReader::require(velocity_.size() == network_.size() && before_.size() == network_.size());
    }
  }

 private:
  std::vector<double> imbalance(const std::vector<double>& u, double dt, Links links);
  const char* solve(std::vector<double>& u, double dt, const StepTolerance& tolerance, Links links,
                    int& iterations);                 // nullptr: solved, else why not
  double length(const std::vector<double>& x) const;  // weighted by inertia
  std::vector<double> first_guess(double dt) const;
  StepOutcome refuse(StepOutcome outcome, const char* why);

  SettlingNetwork& network_;
  double drag_;  // [1/T0]
  std::vector<double> velocity_, before_;
  double last_dt_ = 0, dt_before_ = 0;  // [T0] of the steps that made velocity_ and before_; 0: none
  RepeatedCholesky factor_;
  std::int64_t earlier_ = 0;  // factorisations before the solve was kept in a state
};

}  // namespace isostat
