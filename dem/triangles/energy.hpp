// Where the energy of a state of triangle grains is [erg].
#pragma once
#include "dem/triangles/triangles.hpp"

namespace isostat {

struct TriangleEnergies {
  double kinetic = 0;   // translation and rotation of the triangles
  double beams = 0;     // E (L - L0)^2/2 + (EI/L0)(2 Ta^2 + 2 Ta Tb + 2 Tb^2)
  double overlaps = 0;  // Y A_c^2/(2 L_c); not a number with the paper's law, whose forces have no energy
  double springs = 0;   // T^2/(2 k_t)
  double weight = 0;    // m g y
  double total() const { return kinetic + beams + overlaps + springs + weight; }
};
TriangleEnergies energies(const State<TriangleGrains>& state);

}  // namespace isostat
