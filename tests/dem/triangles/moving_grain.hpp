// A grain of triangles and beams in motion, the slow and obvious way: energy, forces and dampers in the plane from the
// formulas of one beam, no linearisation. Coordinates x, y, theta of each triangle, of which theta is 0 as built.
#pragma once
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "dem/state/beam.hpp"
#include "dem/state/link.hpp"
#include "dem/triangles/grain_template.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

using Coordinates = std::vector<double>;  // 3 a triangle; velocities alike

inline Coordinates as_built(const GrainTemplate& grain) {
  Coordinates x;
  for (const GrainTriangle& t : grain.triangles) x.insert(x.end(), {t.centroid[0], t.centroid[1], 0.0});
  return x;
}

struct BeamShape {
  LinkFrame<double> frame;
  double turn_i, turn_j;  // T_a, T_b
};
inline BeamShape shape_of(const GrainBeam& b, const Coordinates& x) {
  const std::size_t i = 3 * idx(b.i), j = 3 * idx(b.j);
  const Vec2 chord{{x[j] - x[i], x[j + 1] - x[i + 1]}};
  const auto turn = [&](double angle, double rest) {
    const Vec2 d = rest_direction(rest);
    const double c = std::cos(angle), s = std::sin(angle);
    return end_rotation({{c * d[0] - s * d[1], s * d[0] + c * d[1]}}, chord);
  };
  const double half = b.beam.rest_length / 2;
  return {link_frame(chord[0], chord[1], half, half), turn(x[i + 2], b.beam.rest_angle_i),
          turn(x[j + 2], b.beam.rest_angle_j)};
}

inline double energy(const GrainTemplate& grain, const Coordinates& x) {
  double sum = 0;
  for (const GrainBeam& b : grain.beams) {
    const BeamShape s = shape_of(b, x);
    sum += beam_energy(b.beam, s.frame.distance, s.turn_i, s.turn_j);
  }
  return sum;
}

inline void add_load(const GrainBeam& b, const LinkLoad<double>& l, Coordinates& f) {
  const std::size_t i = 3 * idx(b.i), j = 3 * idx(b.j);
  f[i] -= l.fx, f[i + 1] -= l.fy, f[i + 2] += l.moment_i;
  f[j] += l.fx, f[j + 1] += l.fy, f[j + 2] += l.moment_j;
}

inline Coordinates elastic_forces(const GrainTemplate& grain, const Coordinates& x) {
  Coordinates f(x.size(), 0.0);
  for (const GrainBeam& b : grain.beams) {
    const BeamShape s = shape_of(b, x);
    const BeamForce force = beam_force(b.beam, s.frame.distance, s.turn_i, s.turn_j);
    add_load(b, link_load(s.frame, force.normal, force.tangential, force.moment), f);
  }
  return f;
}

inline Coordinates damper_forces(const GrainTemplate& grain, const Coordinates& x, const Coordinates& v) {
  Coordinates f(x.size(), 0.0);
  for (const GrainBeam& b : grain.beams) {
    const BeamShape s = shape_of(b, x);
    const std::size_t i = 3 * idx(b.i), j = 3 * idx(b.j);
    const LinkVelocity<double> rate = link_velocity(s.frame, v[j] - v[i], v[j + 1] - v[i + 1], v[i + 2], v[j + 2]);
    const BeamDamping c = beam_damping(b.beam, grain.material.damping, s.frame.distance);
    add_load(b, link_load(s.frame, -c.normal * rate.normal, -c.tangential * rate.tangential, -c.rolling * rate.rolling),
             f);
  }
  return f;
}

inline double inertia_of(const GrainTemplate& grain, std::size_t d) {
  return d % 3 == 2 ? grain.triangles[d / 3].inertia : grain.triangles[d / 3].mass;
}

inline double kinetic_energy(const GrainTemplate& grain, const Coordinates& v) {
  double sum = 0;
  for (std::size_t d = 0; d < v.size(); ++d) sum += 0.5 * inertia_of(grain, d) * v[d] * v[d];
  return sum;
}

// Momentum and angular momentum about the origin; of forces in place of momenta m v, their resultant.
inline std::array<double, 3> resultant(const Coordinates& x, const Coordinates& load) {
  std::array<double, 3> sum{};
  for (std::size_t t = 0; t < x.size(); t += 3) {
    sum[0] += load[t], sum[1] += load[t + 1];
    sum[2] += x[t] * load[t + 1] - x[t + 1] * load[t] + load[t + 2];
  }
  return sum;
}

// Every coordinate by up to `amplitude` times the radius of the grain (angles: times 1).
inline Coordinates random_motion(const GrainTemplate& grain, double amplitude, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<> unit(-amplitude, amplitude);
  Coordinates u(3 * grain.triangles.size());
  for (std::size_t d = 0; d < u.size(); ++d) u[d] = unit(random) * (d % 3 == 2 ? 1 : grain.radius);
  return u;
}

inline Coordinates sum(Coordinates a, const Coordinates& b, double factor = 1) {
  for (std::size_t d = 0; d < a.size(); ++d) a[d] += factor * b[d];
  return a;
}

}  // namespace isostat
