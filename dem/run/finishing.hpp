// Finishing a stage by static solves: what a run asks for and what it gets back. dem names the interface, analysis
// implements it, the app introduces them to each other.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "dem/state/state.hpp"

namespace isostat {

// How the cell is held while a packing settles.
template <int D>
struct FinishingRequest {
  ImposedStress<D> stress;              // [F0/a] imposed in each direction; none: that edge keeps its length
  double cell_inertia = 1;              // M of Gilabert 2007, Eq. 3 [m]
  double drag = 0;                      // [1/T0] of a global drag on what still moves
  bool drift_only = false;              // clusters still fly towards each other: on to the next capture, never to rest
  std::function<bool()> interrupted{};  // asked before every implicit step; true: give up at once
  std::function<bool()> checkpoint_due{};  // asked then, too; true: `checkpoint` is called with the solve in the state
  std::function<void()> checkpoint{};
};

struct FinishingReport {
  bool settled = false;             // the state is at rest in equilibrium
  bool advanced = false;            // the state has drifted on, at most to just before a capture
  bool interrupted = false;         // given up on request; the state holds the solve, and the same call goes on with it
  bool capture = false;             // a pair is about to come within reach: for the dynamics to follow
  bool stuck = false;               // implicit steps gain nothing here for now: the dynamics is the better way on
  int steps = 0;                    // accepted implicit steps
  std::int64_t factorisations = 0;  // of the tangent stiffness
  double residual = 0;              // [F1] largest net force (moment / a, stress error a) at the end
  std::int64_t moving = 0;          // grains that a residual force still moves, in floppy or very soft modes
  std::string reason;               // why it did not settle, or what is left
};

template <class System>
class StaticSolver {
 public:
  virtual ~StaticSolver() = default;
  // From a state in which only creep is left to rest in equilibrium under the same law, spring histories included.
  // Where two grains are about to come within reach of each other's attraction it stops, and leaves the moving packing
  // as it is just before (advanced), to be marched through the event; also where it gets no further (stuck). If it can
  // do neither, the state stays as it is, bit for bit. `time` does not advance; the solver's memory is emptied, so that
  // a Solver made from the state starts from packing and links; the energy that the solve takes out goes to
  // ledger.injected. The result depends neither on threads nor on the order in which the grains are stored.
  virtual FinishingReport settle(State<System>& state, const FinishingRequest<System::dimension>& request) = 0;
};

}  // namespace isostat
