#include "dem/disks/series.hpp"

#include "dem/disks/energy.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/clusters.hpp"
#include "dem/state/solid_fraction.hpp"

namespace isostat {

std::vector<SeriesColumn> series_columns(const State<Disks>& s, bool with_energies) {
  const Packing<2>& p = s.packing;
  const Energies e = energies(s);
  std::size_t interactions = 0;
  for (const Link<2>& l : p.links)
    interactions += s.law.attraction > 0 || l.normal_force > kLoadTolerance * s.certificate.force_scale;

  std::vector<SeriesColumn> columns{{"t", s.time}};
  const auto add = [&columns](std::initializer_list<SeriesColumn> more) {
    columns.insert(columns.end(), more.begin(), more.end());
  };
  if (p.cell) {
    const StressTensor stress = measured_stress(p);
    add({{"Phi", solid_fraction(p.bodies, p.cell)},
         {"L1", p.cell->length[0]},
         {"L2", p.cell->length[1]},
         {"sigma11", stress.xx},
         {"sigma22", stress.yy},
         {"strain_rate1", s.cell_motion.strain_rate[0]},
         {"strain_rate2", s.cell_motion.strain_rate[1]}});
  }
  add({{"kinetic_energy", e.kinetic},
       {"z", 2 * static_cast<double>(interactions) / static_cast<double>(p.bodies.size())},
       {"clusters", static_cast<double>(count_clusters(p))},
       {"max_force", s.certificate.max_force},
       {"max_moment", s.certificate.max_moment}});
  if (p.cell) add({{"pressure_error", s.certificate.pressure_error}});
  add({{"kinetic_energy_per_grain", s.certificate.kinetic_energy_per_grain}});
  if (with_energies)
    add({{"E_kinetic", e.kinetic},
         {"E_elastic", e.elastic},
         {"E_adhesive", e.adhesive},
         {"E_viscous", e.ledger.viscous},
         {"E_sliding", e.ledger.sliding},
         {"E_rolling", e.ledger.rolling},
         {"E_drag", e.ledger.drag},
         {"E_cell_work", e.ledger.cell_work},
         {"E_total", e.total()}});
  return columns;
}

}  // namespace isostat
