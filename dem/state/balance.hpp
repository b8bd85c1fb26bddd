// What the static forces of the links add up to: loads of the bodies and the stress of the cell. Knows no law.
#pragma once
#include <vector>

#include "dem/state/packing.hpp"

namespace isostat {

// Eq. 3 of Gilabert 2007 with each pair once, compression positive: (1/A) [sum m v_a v_b + sum over links F_a r_b],
// peculiar velocities, static forces. [F0/a]; rows a, columns b.
struct StressTensor {
  double xx = 0, xy = 0, yx = 0, yy = 0;
};
inline Vec2 diagonal(const StressTensor& s) { return {{s.xx, s.yy}}; }
inline double shear_of(const StressTensor& s) { return s.xy; }  // conjugate to the shear of a cell
StressTensor measured_stress(const Packing<2>& packing);        // needs a cell
// Of a state whose links say all of it.
template <class State>
requires requires(const State& s) { measured_stress(s.packing); }
auto measured_stress(const State& state) { return measured_stress(state.packing); }
// Its two sums, not yet divided by the area [F0 a].
void add_kinetic(StressTensor& sum, const Bodies<2>& bodies);
void add_virial(StressTensor& sum, const Packing<2>& packing);

struct BodyLoad {
  double fx = 0, fy = 0, moment = 0;  // [F0], [F0 a]
  int links = 0;
};
std::vector<BodyLoad> net_loads(const Packing<2>& packing);

}  // namespace isostat
