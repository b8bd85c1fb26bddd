// Grains of triangles at rest: forces of beams and of overlaps from positions alone. Certificate, snapshots, energies
// and stiffness ask here; the kernels (dem/triangles/kernel/) have the same formulas in lanes.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "dem/state/beam.hpp"
#include "dem/state/link_ends.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

// Area of a triangle of the packing [cm^2].
inline double triangle_area(const TrianglePacking& p, std::size_t k) {
  const auto& c = p.corner[k];
  const Vec2 u = c[1] - c[0], v = c[2] - c[0];
  return 0.5 * (u[0] * v[1] - u[1] * v[0]);
}
inline double grain_area(const TrianglePacking& p, std::size_t g) {
  double area = 0;
  for (auto k = p.grains.begin[g]; k < p.grains.begin[g + 1]; ++k)
    area += triangle_area(p, static_cast<std::size_t>(k));
  return area;
}

// A wall much larger than any free grain is a smooth one. Those stand last in the order of grains; the neighbour lists
// hold the others only.
inline constexpr double kSmoothWall = 16;  // [area of the largest free grain]
inline std::size_t listed_grains(const TrianglePacking& p) {
  double largest = 0;
  for (std::size_t g = 0; g < p.grains.size(); ++g)
    if (p.grains.part[g] == GrainPart::free) largest = std::max(largest, grain_area(p, g));
  std::size_t listed = p.grains.size();
  while (listed > 0 && p.grains.part[listed - 1] != GrainPart::free &&
         grain_area(p, listed - 1) > kSmoothWall * largest)
    --listed;
  return listed;
}

// 1/l of a grain, l the root of its area; of the law's own length where it has one. A smooth wall counts as infinitely
// long: 1/l = 0, so that L_c of a grain against it is 2 l.
inline std::vector<double> inverse_lengths(const TrianglePacking& p, const TriangleLaw& law) {
  const std::size_t listed = listed_grains(p);
  std::vector<double> inverse(p.grains.size());
  for (std::size_t g = 0; g < inverse.size(); ++g)
    inverse[g] = law.overlap_length > 0 ? 1 / law.overlap_length : g < listed ? 1 / std::sqrt(grain_area(p, g)) : 0.0;
  return inverse;
}
// Y / L_c, 1/L_c = (1/l_i + 1/l_j)/2: pressure per area of overlap [g/(cm^2 s^2) per cm].
inline double overlap_stiffness(const TriangleLaw& law, double inverse_i, double inverse_j) {
  return 0.5 * law.modulus * (inverse_i + inverse_j);
}

// Rotations of the ends of a beam against its chord, less those at rest, and its length.
struct BeamTurns {
  Vec2 chord;
  double length, turn_i, turn_j;
};
inline BeamTurns beam_turns(const TrianglePacking& p, const Link<2>& link) {
  const auto i = static_cast<std::size_t>(link.i), j = static_cast<std::size_t>(link.j);
  const Beam& beam = p.beams[static_cast<std::size_t>(link.beam)];
  Vec2 chord = p.bodies.position[j] - p.bodies.position[i];
  if (p.cell) chord += p.cell->offset(link.shift);
  const auto turned = [&](double rest, double angle) {
    const Vec2 d = rest_direction(rest);
    const double c = std::cos(angle), s = std::sin(angle);
    return Vec2{{c * d[0] - s * d[1], s * d[0] + c * d[1]}};
  };
  return {chord, norm(chord), end_rotation(turned(beam.rest_angle_i, p.angle[i]), chord),
          end_rotation(turned(beam.rest_angle_j, p.angle[j]), chord)};
}
// Brings gap and forces of a link of kind beam up to the positions of its bodies.
inline void set_beam_force(const TrianglePacking& p, Link<2>& link) {
  const Beam& beam = p.beams[static_cast<std::size_t>(link.beam)];
  const BeamTurns t = beam_turns(p, link);
  const BeamForce f = beam_force(beam, t.length, t.turn_i, t.turn_j);
  link.gap = t.length - beam.rest_length;
  link.normal_force = f.normal, link.tangential_force = f.tangential, link.moment = f.moment;
}

}  // namespace isostat
