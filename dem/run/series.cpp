#include "dem/run/series.hpp"

#include <cstdio>
#include <numbers>
#include <vector>

#include "dem/state/balance.hpp"
#include "dem/state/certificate.hpp"
#include "dem/state/clusters.hpp"
#include "dem/state/energy.hpp"

namespace isostat {
std::string series_header(bool energies) {
  std::string h =
      "t,Phi,L1,L2,sigma11,sigma22,strain_rate1,strain_rate2,kinetic_energy,z,clusters,max_force,max_moment,"
      "pressure_error,kinetic_energy_per_grain";
  if (energies) h += ",E_kinetic,E_elastic,E_adhesive,E_viscous,E_sliding,E_rolling,E_drag,E_cell_work,E_total";
  return h + "\n";
}

std::string series_row(const State& s, bool with_energies) {
  const Packing<2>& p = s.packing;
  const StressTensor stress = measured_stress(p);
  const Energies e = energies(s);
  double area = 0;
  for (double r : p.bodies.radius) area += std::numbers::pi * r * r;
  std::size_t interactions = 0;
  for (const Link<2>& l : p.links)
    interactions += s.law.attraction > 0 || l.normal_force > kLoadTolerance * s.certificate.force_scale;

  std::vector<double> values = {s.time,
                                area / p.cell->measure(),
                                p.cell->length[0],
                                p.cell->length[1],
                                stress.xx,
                                stress.yy,
                                s.cell_motion.strain_rate[0],
                                s.cell_motion.strain_rate[1],
                                e.kinetic,
                                2 * static_cast<double>(interactions) / static_cast<double>(p.bodies.size()),
                                static_cast<double>(count_clusters(p)),
                                s.certificate.max_force,
                                s.certificate.max_moment,
                                s.certificate.pressure_error,
                                s.certificate.kinetic_energy_per_grain};
  if (with_energies)
    for (double x : {e.kinetic, e.elastic, e.adhesive, e.ledger.viscous, e.ledger.sliding, e.ledger.rolling,
                     e.ledger.drag, e.ledger.cell_work, e.total()})
      values.push_back(x);
  std::string row;
  for (double x : values) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", x);
    row += (row.empty() ? "" : ",") + std::string(text);
  }
  return row + "\n";
}

}  // namespace isostat
