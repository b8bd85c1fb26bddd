// Finishing by static solves (docs/equilibrium.md): what the packing would still do is followed in implicit steps of
// growing length, inertia and all, until the criteria of equilibrium are met; then Newton steps from rest bring forces
// down to rounding. Sparse direct factorisations; one thread.
#pragma once
#include <functional>

#include "dem/disks/disks.hpp"
#include "dem/run/finishing.hpp"

namespace isostat {

// What one implicit step did, for those who want to watch.
struct SettlingStep {
  int step = 0;
  bool polishing = false;  // from rest, beyond the criteria
  double length = 0;       // [T0]
  bool accepted = false;
  int iterations = 0;         // of Newton
  double residual = 0;        // [F1] static, after the step
  double kinetic_energy = 0;  // [F1 a] per counted grain
  double displacement = 0;    // [a] largest
  const char* refused = "";   // why it was not accepted
};

class NewtonFinishing : public StaticSolver<Disks> {
 public:
  explicit NewtonFinishing(std::function<void(const SettlingStep&)> watch = {}) : watch_(std::move(watch)) {}
  FinishingReport settle(State<Disks>& state, const FinishingRequest<2>& request) override;

 private:
  std::function<void(const SettlingStep&)> watch_;
};

}  // namespace isostat
