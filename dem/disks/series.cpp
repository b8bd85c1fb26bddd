#include "dem/disks/series.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/disks/energy.hpp"
#include "dem/disks/outflow.hpp"
#include "dem/run/container_series.hpp"
#include "dem/run/stage_series.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/clusters.hpp"
#include "dem/state/container_motion.hpp"
#include "dem/state/solid_fraction.hpp"

namespace isostat {
namespace {

Contents contents_of(const State<Disks>& s, const ContainerPlacement& placement) {
  const Bodies<2>& b = s.packing.bodies;
  Contents c;
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (!is_free(s.packing.part, k)) continue;
    c.position.push_back(b.position[k] - placement.offset);
    c.mass.push_back(b.mass[k]);
    c.area.push_back(std::numbers::pi * b.radius[k] * b.radius[k]);
  }
  c.above = static_cast<std::size_t>(grains_above_outlet(s));
  return c;
}

// Ends of interactions on free grains.
std::size_t interaction_ends(const State<Disks>& s) {
  std::size_t ends = 0;
  for (const Link<2>& l : s.packing.links) {
    if (!(s.law.attraction > 0 || l.normal_force > kLoadTolerance * s.certificate.force_scale)) continue;
    ends += is_free(s.packing.part, static_cast<std::size_t>(l.i));
    ends += is_free(s.packing.part, static_cast<std::size_t>(l.j));
  }
  return ends;
}

}  // namespace

std::vector<SeriesColumn> series_columns(const State<Disks>& s, bool with_energies) {
  const Packing<2>& p = s.packing;
  const Energies e = energies(s);
  std::vector<SeriesColumn> columns{{"t", s.time}};
  const auto add = [&columns](std::initializer_list<SeriesColumn> more) {
    columns.insert(columns.end(), more.begin(), more.end());
  };
  std::array<double, 1> shear{};
  if (p.cell) {
    const StressTensor stress = measured_stress(p);
    add({{"Phi", solid_fraction(p.bodies, p.cell)},
         {"L1", p.cell->length[0]},
         {"L2", p.cell->length[1]},
         {"sigma11", stress.xx},
         {"sigma22", stress.yy},
         {"strain_rate1", s.cell_motion.strain_rate[0]},
         {"strain_rate2", s.cell_motion.strain_rate[1]}});
    shear[0] = 0.5 * (stress.xy + stress.yx);
  }
  add_stage_columns(columns, s, shear);
  add({{"kinetic_energy", e.kinetic},
       {"z", static_cast<double>(interaction_ends(s)) / static_cast<double>(std::max<std::size_t>(count_free(p), 1))},
       {"clusters", static_cast<double>(count_clusters(p))},
       {"max_force", s.certificate.max_force},
       {"max_moment", s.certificate.max_moment}});
  if (p.cell) add({{"pressure_error", s.certificate.pressure_error}});
  add({{"kinetic_energy_per_grain", s.certificate.kinetic_energy_per_grain}});
  if (s.scene.container.shape != ContainerShape::none) {
    const ContainerPlacement placement = container_of(s);
    add_container_columns(columns, s.scene.container, s.surroundings, placement, contents_of(s, placement));
  }
  if (with_energies)
    add({{"E_kinetic", e.kinetic},
         {"E_elastic", e.elastic},
         {"E_adhesive", e.adhesive},
         {"E_viscous", e.ledger.viscous},
         {"E_sliding", e.ledger.sliding},
         {"E_rolling", e.ledger.rolling},
         {"E_drag", e.ledger.drag},
         {"E_cell_work", e.ledger.cell_work}});
  if (with_energies && s.scene.container.shape != ContainerShape::none)
    add({{"E_weight", e.weight}, {"E_wall_work", e.ledger.wall_work}, {"E_injected", e.ledger.injected}});
  if (with_energies) add({{"E_total", e.total()}});
  return columns;
}

}  // namespace isostat
