// The law of a network of triangles that brings none; its beams are beam_at_rest() (dem/state/beam.hpp). Poeschel and
// Buchholtz 1995, Sec. 6.1, without friction and dampers.
#pragma once
#include "dem/triangles/triangles.hpp"

namespace isostat {

inline constexpr double kNetworkDensity = 1;  // [g/cm^2]

inline TriangleLaw triangle_network_law() {
  TriangleLaw law;
  law.contact = ContactLaw::overlap_energy;
  law.modulus = TriangleLawScene{}.modulus;
  return law;
}

}  // namespace isostat
