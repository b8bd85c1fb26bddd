// One grain as it is built, at rest: triangles, and beams between those that share an edge. Poeschel and Buchholtz
// 1995, Secs. 2 and 4. Units cm, g, s: the paper's E is a force per elongation, its E I a bending stiffness.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "dem/state/packing.hpp"
#include "geometry/triangle_mesh.hpp"

namespace isostat {

// Of Sec. 6.1.
struct GrainMaterial {
  double density = 1;      // rho [g/cm^2]
  double stiffness = 1e5;  // E [g/s^2] of every beam
  double bending = 10;     // E I [g cm^3/s^2]
  double damping = 9;      // gamma [g/s]
};

struct GrainTriangle {
  std::array<Vec2, 3> corner;  // [cm] about the centroid, anticlockwise; the body frame of the triangle as built
  Vec2 centroid;               // [cm] about the centroid of the grain
  double mass, inertia;        // [g], [g cm^2] about the centroid
};

// i < j; without load as built. The rest angles are those of the bodies' frames against the chord from i to j.
struct GrainBeam {
  std::int32_t i = 0, j = 0;
  Beam beam;
};

struct GrainTemplate {
  std::vector<GrainTriangle> triangles;
  std::vector<GrainBeam> beams;  // by ascending pairs
  double mass = 0, inertia = 0;  // of the grain, about its centroid
  double radius = 0;             // [cm] of the circle about the centroid that holds it
  GrainMaterial material;
};

// Throws InputError for a material that is not positive (damping may be zero), and for a triangle whose area is zero to
// rounding.
GrainTemplate grain_template(const TriangleMesh& mesh, const GrainMaterial& material);

}  // namespace isostat
