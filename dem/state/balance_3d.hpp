// What the static forces of the links of a packing in space add up to: loads of the bodies and the stress of the cell.
// Knows no law. The twin of dem/state/balance.hpp.
#pragma once
#include <array>
#include <vector>

#include "dem/state/packing.hpp"

namespace isostat {

// (1/V) [sum m v_a v_b + sum over links F_a r_b], each pair once, compression positive, peculiar velocities, static
// forces [F0/a^2]; rows a, columns b.
using StressTensor3 = std::array<Vec3, 3>;
inline Vec3 diagonal(const StressTensor3& s) { return {{s[0][0], s[1][1], s[2][2]}}; }
StressTensor3 measured_stress(const Packing<3>& packing);  // needs a cell

struct BodyLoad3 {
  Vec3 force{}, moment{};  // [F0], [F0 a]
  int links = 0;
};
std::vector<BodyLoad3> net_loads(const Packing<3>& packing);

}  // namespace isostat
