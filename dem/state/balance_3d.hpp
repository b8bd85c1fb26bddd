// What the static forces of the links add up to in space: loads of the bodies and the stress of the cell; the twin of
// dem/state/balance.hpp.
#pragma once
#include <array>
#include <vector>

#include "dem/state/packing.hpp"

namespace isostat {

// (1/V) [sum m v_a v_b + sum over links F_a r_b], compression positive: rows a, columns b [F0/a^2]. Needs a cell.
using StressTensor3 = std::array<Vec3, 3>;
inline Vec3 diagonal(const StressTensor3& s) { return {{s[0][0], s[1][1], s[2][2]}}; }
inline double shear_of(const StressTensor3& s) { return s[0][1]; }
StressTensor3 measured_stress(const Packing<3>& packing);

struct BodyLoad3 {
  Vec3 force{}, moment{};  // [F0], [F0 a]
  int links = 0;
};
std::vector<BodyLoad3> net_loads(const Packing<3>& packing);

}  // namespace isostat
