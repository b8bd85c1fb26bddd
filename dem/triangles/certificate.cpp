#include "dem/triangles/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/triangles/at_rest.hpp"
#include "dem/triangles/overlap_search.hpp"
#include "geometry/base/index.hpp"
#include "geometry/union_find.hpp"

namespace isostat {
namespace {

bool is_free(const TrianglePacking& p, std::size_t g) { return p.grains.part[g] == GrainPart::free; }

double kinetic_energy(const TrianglePacking& p, std::size_t g) {
  double energy = 0;
  for (auto k = idx(p.grains.begin[g]); k < idx(p.grains.begin[g + 1]); ++k)
    energy += 0.5 * (p.bodies.mass[k] * dot(p.bodies.velocity[k], p.bodies.velocity[k]) +
                     p.bodies.inertia[k] * p.bodies.spin[k] * p.bodies.spin[k]);
  return energy;
}

double heaviest(const TrianglePacking& p) {
  double mass = 0;
  for (std::size_t g = 0; g < p.grains.size(); ++g) {
    double m = 0;
    for (auto k = idx(p.grains.begin[g]); k < idx(p.grains.begin[g + 1]); ++k) m += p.bodies.mass[k];
    if (is_free(p, g)) mass = std::max(mass, m);
  }
  return mass;
}

}  // namespace

double grain_length(const TrianglePacking& p) {
  double largest = 0;
  for (std::size_t g = 0; g < p.grains.size(); ++g)
    if (is_free(p, g)) largest = std::max(largest, grain_area(p, g));
  return std::sqrt(largest);
}

double force_scale(const TrianglePacking& p, const ImposedStress<2>& imposed, double gravity) {
  const double pressure = std::abs(largest_stress(imposed).value_or(0.0));
  const double scale = std::max(grain_length(p) * pressure, heaviest(p) * gravity);
  return scale > 0 ? scale : 1.0;
}

std::vector<BodyLoad> net_loads(const TrianglePacking& p, const TriangleLaw& law, double gravity,
                                StressTensor* virial) {
  std::vector<BodyLoad> loads(p.bodies.size());
  StressTensor sum;
  for (Link<2> link : p.links) {
    set_beam_force(p, link);
    const BeamTurns t = beam_turns(p, link);
    const double half = 0.5 * p.beams[idx(link.beam)].rest_length;
    const LinkLoad<double> f = link_load(link_frame(t.chord[0], t.chord[1], half, half), link.normal_force,
                                         link.tangential_force, link.moment);
    BodyLoad &on_i = loads[idx(link.i)], &on_j = loads[idx(link.j)];
    on_i.fx -= f.fx, on_i.fy -= f.fy, on_i.moment += f.moment_i, ++on_i.links;
    on_j.fx += f.fx, on_j.fy += f.fy, on_j.moment += f.moment_j, ++on_j.links;
    sum.xx += f.fx * t.chord[0], sum.xy += f.fx * t.chord[1];
    sum.yx += f.fy * t.chord[0], sum.yy += f.fy * t.chord[1];
  }
  add_overlap_loads(p, law, overlapping_triangles(p), loads, sum);
  for (std::size_t k = 0; k < loads.size(); ++k) loads[k].fy -= p.bodies.mass[k] * gravity;
  if (virial) *virial = sum;
  return loads;
}

StressTensor measured_stress(const State<TriangleGrains>& state) {
  const TrianglePacking& p = state.packing;
  StressTensor s;
  net_loads(p, state.law, 0, &s);
  add_kinetic(s, p.bodies);
  const double area = p.cell.value().measure();
  return {s.xx / area, s.xy / area, s.yx / area, s.yy / area};
}

Certificate evaluate_certificate(const TrianglePacking& p, const TriangleLaw& law, const ImposedStress<2>& imposed,
                                 const EquilibriumScene& tolerance, double gravity) {
  Certificate c;
  const double length = grain_length(p);
  c.force_scale = force_scale(p, imposed, gravity);
  c.tolerance_force = tolerance.force;
  c.tolerance_pressure = tolerance.pressure;
  c.tolerance_kinetic = tolerance.kinetic_energy;
  c.pressure_controlled = largest_stress(imposed).has_value() && p.cell.has_value();
  StressTensor stress;
  const std::vector<BodyLoad> loads = net_loads(p, law, gravity, &stress);
  double largest_force = 0, largest_moment = 0, kinetic = 0;
  std::size_t free = 0;
  const double unit = c.force_scale * length;  // [erg]
  for (std::size_t g = 0; g < p.grains.size(); ++g) {
    if (!is_free(p, g)) continue;
    for (auto k = idx(p.grains.begin[g]); k < idx(p.grains.begin[g + 1]); ++k) {
      largest_force = largest_of(largest_force, std::hypot(loads[k].fx, loads[k].fy));
      largest_moment = largest_of(largest_moment, std::abs(loads[k].moment));
    }
    const double energy = kinetic_energy(p, g);
    kinetic += energy, ++free;
    c.moving += !(energy <= tolerance.kinetic_energy * unit);
  }
  c.max_force = largest_force / c.force_scale;
  c.max_moment = largest_moment / unit;
  c.kinetic_energy_per_grain = free > 0 ? kinetic / static_cast<double>(free) / unit : 0;
  if (law.friction > 0 && law.contact == ContactLaw::overlap_energy)
    for (const Overlap& o : p.overlaps) {
      const double margin = 1 - std::abs(o.tangential_force) / (law.friction * o.normal_force);
      c.sliding += margin <= 1e-6;
      c.smallest_margin = std::min(c.smallest_margin, margin);
    }
  if (c.pressure_controlled) {
    add_kinetic(stress, p.bodies);
    const double area = p.cell->measure(), pressure_unit = c.force_scale / length;
    if (imposed[0]) c.pressure_error = std::abs(stress.xx / area - *imposed[0]) / pressure_unit;
    if (imposed[1])
      c.pressure_error = largest_of(c.pressure_error, std::abs(stress.yy / area - *imposed[1]) / pressure_unit);
  }
  c.equilibrated = worst_criterion(c).ratio < 1;
  return c;
}

Certificate evaluate_certificate(const State<TriangleGrains>& s) {
  Certificate c = evaluate_certificate(s.packing, s.law, s.imposed_stress, s.scene.equilibrium, s.scene.gravity);
  keep_record(c, s.certificate);
  return c;
}

double inertial_time(const State<TriangleGrains>& s, double pressure) {
  return std::sqrt(heaviest(s.packing) / pressure);
}

std::size_t loaded_contacts(const State<TriangleGrains>& s) {
  return static_cast<std::size_t>(
      std::count_if(s.packing.overlaps.begin(), s.packing.overlaps.end(),
                    [&s](const Overlap& o) { return o.normal_force > kLoadTolerance * s.certificate.force_scale; }));
}

double solid_fraction(const TrianglePacking& p, const std::optional<PeriodicCell<2>>& cell) {
  if (!cell) return std::numeric_limits<double>::quiet_NaN();
  double area = 0;
  for (std::size_t k = 0; k < p.bodies.size(); ++k) area += triangle_area(p, k);
  return area / cell->measure();
}

std::size_t count_clusters(const TrianglePacking& p) {
  UnionFind sets(p.grains.size());
  std::size_t count = p.grains.size();
  for (const Overlap& o : p.overlaps) count -= sets.join(idx(o.grain_i), idx(o.grain_j));
  return count;
}

std::uint64_t contact_set(const TrianglePacking& p) {
  std::uint64_t sum = 0;  // order does not matter
  for (const Overlap& o : p.overlaps) {
    const auto a = static_cast<std::uint64_t>(p.grains.id[idx(o.grain_i)]);
    const auto b = static_cast<std::uint64_t>(p.grains.id[idx(o.grain_j)]);
    std::uint64_t h = std::min(a, b) * 0x9e3779b97f4a7c15u ^ std::max(a, b) * 0xc2b2ae3d27d4eb4fu;
    h ^= h >> 31, h *= 0xbf58476d1ce4e5b9u, h ^= h >> 29;
    sum += h;
  }
  return sum;
}

}  // namespace isostat
