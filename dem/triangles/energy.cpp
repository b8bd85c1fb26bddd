#include "dem/triangles/energy.hpp"

#include <limits>

#include "dem/triangles/at_rest.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

TriangleEnergies energies(const State<TriangleGrains>& s) {
  const TrianglePacking& p = s.packing;
  TriangleEnergies e;
  e.ledger = s.ledger;
  for (std::size_t g = 0; g < p.grains.size(); ++g) {
    if (p.grains.part[g] != GrainPart::free) continue;
    for (auto k = idx(p.grains.begin[g]); k < idx(p.grains.begin[g + 1]); ++k) {
      const Bodies<2>& b = p.bodies;
      e.kinetic += 0.5 * (b.mass[k] * dot(b.velocity[k], b.velocity[k]) + b.inertia[k] * b.spin[k] * b.spin[k]);
      e.weight += b.mass[k] * s.scene.gravity * b.position[k][1];
    }
  }
  for (const Link<2>& link : p.links) {
    const BeamTurns t = beam_turns(p, link);
    e.beams += beam_energy(p.beams[idx(link.beam)], t.length, t.turn_i, t.turn_j);
  }
  if (s.law.contact == ContactLaw::paper) {
    e.overlaps = std::numeric_limits<double>::quiet_NaN();
    return e;
  }
  const std::vector<double> inverse = inverse_lengths(p, s.law);
  for (const Overlap& o : p.overlaps) {
    e.overlaps += 0.5 * overlap_stiffness(s.law, inverse[idx(o.grain_i)], inverse[idx(o.grain_j)]) * o.area * o.area;
    if (s.law.friction > 0) e.springs += o.tangential_force * o.tangential_force / (2 * s.law.tangential_stiffness);
  }
  return e;
}

}  // namespace isostat
