// A packing that another engine has moved, put back into the state that it comes from (convert --from): positions,
// velocities, spins and cell are those of the packing, everything else is the state's.
#pragma once
#include <string>

#include "dem/state/packing.hpp"
#include "dem/state/state.hpp"

namespace isostat {

struct MovedGrains {
  bool sizes = true;        // the packing brings radii; else they are not looked at, and gaps follow from the state's
  bool velocities = false;  // the packing brings them; else the state's stay
  bool spins = false;
  bool links = false;  // the packing lists its contacts; else they are found by the law, and springs stay on their
                       // pairs; of a state that was never in a run, by touching and without forces
};

// Grains go by their ids: both have the same ones, or all of the packing's are larger by one number; of the same radii
// to six digits (the state's stay). A run goes on
// from the result as from a packing that no solver has touched. Throws InputError naming the grain that does not fit,
// and where contacts with walls would be lost.
template <class System>
State<System> hand_over(const State<System>& state, const Packing<System::dimension>& moved, const MovedGrains& brings,
                        const std::string& path);

}  // namespace isostat
