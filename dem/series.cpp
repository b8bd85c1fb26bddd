#include "dem/series.hpp"

#include <cstdio>
#include <numbers>
#include <numeric>
#include <vector>

#include "dem/energy.hpp"
#include "dem/equilibrium.hpp"

namespace isostat {
namespace {

// Connected components of the grains under all links; a grain alone is a cluster.
std::size_t clusters(const Packing<2>& p) {
  std::vector<std::size_t> parent(p.bodies.size());
  std::iota(parent.begin(), parent.end(), 0);
  auto root = [&](std::size_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  std::size_t count = p.bodies.size();
  for (const Link<2>& l : p.links) {
    const std::size_t a = root(static_cast<std::size_t>(l.i)), b = root(static_cast<std::size_t>(l.j));
    if (a != b) parent[a] = b, --count;
  }
  return count;
}

}  // namespace

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
                                static_cast<double>(clusters(p)),
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
