#include "dem/state/energy.hpp"

namespace isostat {

Energies energies(const State& s) {
  Energies e;
  e.ledger = s.ledger;
  const Bodies<2>& b = s.packing.bodies;
  for (std::size_t k = 0; k < b.size(); ++k)
    e.kinetic += 0.5 * (b.mass[k] * dot(b.velocity[k], b.velocity[k]) + b.inertia[k] * b.spin[k] * b.spin[k]);
  const LawParameters& law = s.law;
  for (const Link<2>& l : s.packing.links) {
    if (l.gap < 0) {
      e.elastic += 0.5 * law.normal_stiffness * l.gap * l.gap;
      if (law.tangential_stiffness > 0)
        e.elastic += 0.5 * l.tangential_force * l.tangential_force / law.tangential_stiffness;
      if (law.rolling_stiffness > 0) e.elastic += 0.5 * l.moment * l.moment / law.rolling_stiffness;
    }
    if (law.attraction > 0) {
      const double range = law.attraction_range, reach = range - l.gap;
      e.adhesive -= l.gap < 0 ? law.attraction * (0.5 * range - l.gap) : 0.5 * law.attraction * reach * reach / range;
    }
  }
  return e;
}

}  // namespace isostat
