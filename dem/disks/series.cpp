#include "dem/disks/series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "dem/disks/energy.hpp"
#include "dem/disks/outflow.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/clusters.hpp"
#include "dem/state/container_motion.hpp"
#include "dem/state/container_region.hpp"
#include "dem/state/density_profile.hpp"
#include "dem/state/inclination.hpp"
#include "dem/state/solid_fraction.hpp"

namespace isostat {
namespace {

// Free grains against where the container stands: a vibrated hopper's slices go with it.
struct Contents {
  std::vector<Vec2> position;
  std::vector<double> mass, area;
};
Contents contents_of(const State<Disks>& s) {
  const Bodies<2>& b = s.packing.bodies;
  const Vec2 offset = container_of(s).offset;
  Contents c;
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (!is_free(s.packing.part, k)) continue;
    c.position.push_back(b.position[k] - offset);
    c.mass.push_back(b.mass[k]);
    c.area.push_back(std::numbers::pi * b.radius[k] * b.radius[k]);
  }
  return c;
}

constexpr std::array<std::string_view, 16> kDensityNames{"Phi_01", "Phi_02", "Phi_03", "Phi_04", "Phi_05", "Phi_06",
                                                         "Phi_07", "Phi_08", "Phi_09", "Phi_10", "Phi_11", "Phi_12",
                                                         "Phi_13", "Phi_14", "Phi_15", "Phi_16"};

// What flows out of a hopper, and the solid fraction of equal slices of its height, from the outlet up.
void add_hopper(std::vector<SeriesColumn>& columns, const State<Disks>& s) {
  const ContainerScene& c = s.scene.container;
  columns.push_back({"grains_left", static_cast<double>(s.surroundings.grains_left)});
  columns.push_back({"mass_left", s.surroundings.mass_left});
  columns.push_back({"grains_above", static_cast<double>(grains_above_outlet(s))});
  const Contents in = contents_of(s);
  const double top = region_top(c), slice = top / static_cast<double>(kDensityNames.size());
  const std::vector<double> area = density_profile(in.position, in.area, 0, top, kDensityNames.size());
  for (std::size_t k = 0; k < area.size(); ++k) {
    const double low = static_cast<double>(k) * slice;
    columns.push_back({kDensityNames[k], area[k] * slice / (area_below(c, low + slice) - area_below(c, low))});
  }
}

// In degrees.
void add_drum(std::vector<SeriesColumn>& columns, const State<Disks>& s) {
  const Contents in = contents_of(s);
  const Inclination i = inclination(in.position, in.mass, {}, s.scene.container.radius);
  columns.push_back({"angle", container_of(s).angle * 180 / std::numbers::pi});
  columns.push_back({"inclination_surface", i.surface * 180 / std::numbers::pi});
  columns.push_back({"inclination_mass", i.centre_of_mass * 180 / std::numbers::pi});
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
       {"z", static_cast<double>(interaction_ends(s)) / static_cast<double>(std::max<std::size_t>(count_free(p), 1))},
       {"clusters", static_cast<double>(count_clusters(p))},
       {"max_force", s.certificate.max_force},
       {"max_moment", s.certificate.max_moment}});
  if (p.cell) add({{"pressure_error", s.certificate.pressure_error}});
  add({{"kinetic_energy_per_grain", s.certificate.kinetic_energy_per_grain}});
  if (s.scene.container.shape == ContainerShape::hopper) add_hopper(columns, s);
  if (s.scene.container.shape == ContainerShape::drum) add_drum(columns, s);
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
