#include "dem/spheres/series.hpp"

#include <algorithm>
#include <array>

#include "dem/run/stage_series.hpp"
#include "dem/spheres/certificate.hpp"
#include "dem/state/clusters.hpp"
#include "dem/state/solid_fraction.hpp"

namespace isostat {
namespace {

double kinetic_energy(const Bodies<3>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < b.size(); ++k)
    sum += 0.5 * (b.mass[k] * dot(b.velocity[k], b.velocity[k]) + b.inertia[k] * dot(b.spin[k], b.spin[k]));
  return sum;
}

}  // namespace

std::vector<SeriesColumn> series_columns(const State<Spheres>& s, bool) {
  const SpherePacking& p = s.packing;
  std::vector<SeriesColumn> columns{{"t", s.time}};
  const auto add = [&columns](std::initializer_list<SeriesColumn> more) {
    columns.insert(columns.end(), more.begin(), more.end());
  };
  std::array<double, 3> shear{};
  if (p.cell) {
    const StressTensor3 tensor = measured_stress(p);
    const Vec3 stress = diagonal(tensor), rate = s.cell_motion.strain_rate;
    const auto mean = [&](std::size_t a, std::size_t b) { return 0.5 * (tensor[a][b] + tensor[b][a]); };
    shear = {mean(0, 1), mean(0, 2), mean(1, 2)};
    add({{"Phi", solid_fraction(p.bodies, p.cell)},
         {"L1", p.cell->length[0]},
         {"L2", p.cell->length[1]},
         {"L3", p.cell->length[2]},
         {"sigma11", stress[0]},
         {"sigma22", stress[1]},
         {"sigma33", stress[2]},
         {"strain_rate1", rate[0]},
         {"strain_rate2", rate[1]},
         {"strain_rate3", rate[2]}});
  }
  add_stage_columns(columns, s, shear);
  const auto grains = static_cast<double>(std::max<std::size_t>(p.bodies.size(), 1));
  const std::size_t interactions = s.law.attraction > 0 ? p.links.size() : loaded_contacts(s);
  add({{"kinetic_energy", kinetic_energy(p.bodies)},
       {"z", 2 * static_cast<double>(interactions) / grains},
       {"clusters", static_cast<double>(count_clusters(p))},
       {"max_force", s.certificate.max_force},
       {"max_moment", s.certificate.max_moment}});
  if (p.cell) add({{"pressure_error", s.certificate.pressure_error}});
  add({{"kinetic_energy_per_grain", s.certificate.kinetic_energy_per_grain}});
  return columns;
}

}  // namespace isostat
