#include "dem/triangles/series.hpp"

#include <algorithm>
#include <cmath>

#include "dem/run/container_series.hpp"
#include "dem/run/stage_series.hpp"
#include "dem/state/container_motion.hpp"
#include "dem/triangles/at_rest.hpp"
#include "dem/triangles/certificate.hpp"
#include "dem/triangles/energy.hpp"
#include "dem/triangles/outflow.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

Contents contents_of(const State<TriangleGrains>& s, const ContainerPlacement& placement) {
  const TrianglePacking& p = s.packing;
  Contents c;
  for (std::size_t g = 0; g < p.grains.size(); ++g) {
    if (p.grains.part[g] != GrainPart::free) continue;
    Vec2 moment{};
    double mass = 0, area = 0;
    for (auto k = idx(p.grains.begin[g]); k < idx(p.grains.begin[g + 1]); ++k) {
      moment += p.bodies.mass[k] * p.bodies.position[k];
      mass += p.bodies.mass[k];
      area += triangle_area(p, k);
    }
    c.position.push_back((1 / mass) * moment - placement.offset);
    c.mass.push_back(mass), c.area.push_back(area);
  }
  c.above = grains_above_outlet(s);
  return c;
}

}  // namespace

std::vector<SeriesColumn> series_columns(const State<TriangleGrains>& s, bool with_energies) {
  const TrianglePacking& p = s.packing;
  const TriangleEnergies e = energies(s);
  std::vector<SeriesColumn> columns{{"t", s.time}};
  const auto add = [&columns](std::initializer_list<SeriesColumn> more) {
    columns.insert(columns.end(), more.begin(), more.end());
  };
  std::array<double, 1> shear{};
  if (p.cell) {
    const StressTensor stress = measured_stress(s);
    add({{"Phi", solid_fraction(p, p.cell)},
         {"L1", p.cell->length[0]},
         {"L2", p.cell->length[1]},
         {"sigma11", stress.xx},
         {"sigma22", stress.yy},
         {"strain_rate1", s.cell_motion.strain_rate[0]},
         {"strain_rate2", s.cell_motion.strain_rate[1]}});
    shear[0] = 0.5 * (stress.xy + stress.yx);
  }
  add_stage_columns(columns, s, shear);
  const auto free = static_cast<double>(count_free(p));
  add({{"kinetic_energy", e.kinetic},
       {"z", 2 * static_cast<double>(p.overlaps.size()) / free},
       {"max_force", s.certificate.max_force},
       {"max_moment", s.certificate.max_moment}});
  if (p.cell) add({{"pressure_error", s.certificate.pressure_error}});
  add({{"kinetic_energy_per_grain", s.certificate.kinetic_energy_per_grain}});
  if (s.scene.container.shape == ContainerShape::hopper) add({{"grains", free}});
  if (s.scene.container.shape != ContainerShape::none) {
    const ContainerPlacement placement = container_of(s);
    add_container_columns(columns, s.scene.container, s.surroundings, placement, contents_of(s, placement));
  }
  double tension = 0, compression = 0, bending = 0;
  for (const Link<2>& link : p.links) {
    tension = std::max(tension, -link.normal_force), compression = std::max(compression, link.normal_force);
    bending = std::max(bending, std::abs(link.moment));
  }
  add({{"beam_tension", tension}, {"beam_compression", compression}, {"beam_moment", bending}});
  if (s.law.failure != BeamFailure::none) {
    const auto broken = std::count_if(p.events.begin(), p.events.end(), [](const BeamEvent& b) { return b.broken; });
    add({{"beams_broken", static_cast<double>(broken)},
         {"beams_yielded", static_cast<double>(p.events.size()) - static_cast<double>(broken)}});
  }
  if (with_energies)
    add({{"E_kinetic", e.kinetic},
         {"E_beams", e.beams},
         {"E_overlaps", e.overlaps},
         {"E_springs", e.springs},
         {"E_weight", e.weight},
         {"E_viscous", e.ledger.viscous},
         {"E_sliding", e.ledger.sliding},
         {"E_drag", e.ledger.drag},
         {p.cell ? "E_cell_work" : "E_wall_work", p.cell ? e.ledger.cell_work : e.ledger.wall_work},
         {"E_injected", e.ledger.injected},
         {"E_total", e.total()}});
  return columns;
}

}  // namespace isostat
