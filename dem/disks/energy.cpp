#include "dem/disks/energy.hpp"

#include "dem/disks/at_rest.hpp"

namespace isostat {

Energies energies(const State<Disks>& s) {
  Energies e;
  e.ledger = s.ledger;
  const Bodies<2>& b = s.packing.bodies;
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (!is_free(s.packing.part, k)) continue;  // a container's motion is no energy of the grains
    e.kinetic += 0.5 * (b.mass[k] * dot(b.velocity[k], b.velocity[k]) + b.inertia[k] * b.spin[k] * b.spin[k]);
    e.weight += b.mass[k] * s.scene.gravity * b.position[k][1];
  }
  for (const Link<2>& l : s.packing.links) {
    const AtRest normal = at_rest(s.law, l.gap);
    const SpringEnergy springs = spring_energy(s.law, l.tangential_force, l.moment);  // 0 across a gap
    e.elastic += normal.elastic;
    e.elastic += springs.tangential;
    e.elastic += springs.rolling;
    e.adhesive += normal.adhesive;
  }
  return e;
}

}  // namespace isostat
