// The system of grains of triangles joined by beams: its types alone, no kernel in sight. Units cm, g, s. Poeschel and
// Buchholtz 1995; bodies are triangles, a grain is triangles joined by beams, links are beams and overlaps.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "dem/state/grain_part.hpp"
#include "dem/state/list_memory.hpp"
#include "dem/state/packing.hpp"
#include "dem/state/state.hpp"

namespace isostat {

// The overlap of two grains: one record for each pair of grains with positive area.
struct Overlap {
  std::int32_t grain_i = 0, grain_j = 0;  // indices of grains; i < j
  ImageShift<2> shift{};                  // of grain j
  double area = 0;                        // A_c [cm^2]
  double normal_force = 0;                // [dyn] N > 0, of the whole overlap: |sum over its triangle pairs|
  Vec2 normal{};                          // unit vector, of the force on j
  Vec2 point{};                           // [cm] where it acts, mean of the overlaps' points, on the side of grain i
  double tangential_force = 0;            // [dyn] T on j along z x normal: the friction spring
};

// A beam that has broken or yielded: what the event log holds.
enum class BeamMode : std::uint8_t { tension, shear, bending };
inline constexpr std::array<std::string_view, 3> kBeamModeNames{"tension", "shear", "bending"};
struct BeamEvent {
  double time = 0;                      // [s]
  std::int64_t body_i = 0, body_j = 0;  // ids of the triangles
  BeamMode mode = BeamMode::tension;
  bool broken = true;  // else it has yielded for the first time
};

// Arrays over grains.
struct Grains {
  std::vector<std::int64_t> id;     // distinct
  std::vector<std::int32_t> begin;  // grain g is the triangles begin[g] .. begin[g + 1]; one entry more than grains
  std::vector<GrainPart> part;
  std::vector<double> radius;  // [cm] of the circle about the mean of its centroids that holds it, with room
  std::size_t size() const { return id.size(); }
};

struct TrianglePacking {
  std::optional<PeriodicCell<2>> cell;
  Bodies<2> bodies;                         // triangles; radius: of the circle about the centroid that holds it
  std::vector<std::array<Vec2, 3>> corner;  // [cm] in the body frame, about the centroid, anticlockwise
  std::vector<double> angle;                // [rad] of the body frame; only its sine and cosine act
  Grains grains;
  std::vector<Link<2>> links;  // of kind beam; a broken beam is gone
  std::vector<Beam> beams;
  std::vector<Overlap> overlaps;  // static: without friction's viscous parts, at the positions of the bodies
  std::vector<BeamEvent> events;  // in order of time
};

// Grains that are neither wall nor lid.
inline std::size_t count_free(const TrianglePacking& p) {
  return static_cast<std::size_t>(std::count(p.grains.part.begin(), p.grains.part.end(), GrainPart::free));
}

// Corners of triangle k in the plane, anticlockwise, as its position, angle and body frame say.
inline std::array<Vec2, 3> corners_of(const TrianglePacking& p, std::size_t k) {
  const double c = std::cos(p.angle[k]), s = std::sin(p.angle[k]);
  const Vec2& r = p.bodies.position[k];
  std::array<Vec2, 3> corners;
  for (std::size_t n = 0; n < 3; ++n) {
    const Vec2& q = p.corner[k][n];
    corners[n] = {{r[0] + (c * q[0] - s * q[1]), r[1] + (s * q[0] + c * q[1])}};
  }
  return corners;
}

// The grain that each triangle belongs to.
inline std::vector<std::int32_t> grain_of(const Grains& grains) {
  std::vector<std::int32_t> of(grains.begin.empty() ? 0 : static_cast<std::size_t>(grains.begin.back()));
  for (std::size_t g = 0; g < grains.size(); ++g)
    for (auto k = static_cast<std::size_t>(grains.begin[g]); k < static_cast<std::size_t>(grains.begin[g + 1]); ++k)
      of[k] = static_cast<std::int32_t>(g);
  return of;
}

inline constexpr double kNever = std::numeric_limits<double>::infinity();  // a limit that no beam reaches

// The law with its defaults filled in.
struct TriangleLaw {
  ContactLaw contact = ContactLaw::overlap_energy;
  double modulus = 0;                             // Y [g/(cm s^2)]; 0: no law
  double overlap_length = 0;                      // L_c [cm]; 0: of the grains
  double friction = 0, tangential_stiffness = 0;  // [-], [g/s^2]
  double damping = 0;                             // gamma [g/s] of every beam; stiffnesses are each beam's own
  BeamFailure failure = BeamFailure::none;
  double limit_tension = kNever, limit_shear = kNever, limit_bending = kNever, limit_stretch = kNever,
         limit_angle = kNever;
  friend bool operator==(const TriangleLaw&, const TriangleLaw&) = default;
};

// Friction spring of the overlap of two grains.
struct GrainHistory {
  double tangential_force = 0;  // [dyn] T
  friend bool operator==(const GrainHistory&, const GrainHistory&) = default;
};

// What a restart needs beside the packing. Of Verlet: half-step velocities and the total forces at `time`. Of Gear: the
// force is the corrected acceleration times the mass, and the third and fourth derivatives.
struct TriangleMemory {
  std::vector<Vec2> half_velocity;  // [cm/s] at time - dt/2
  std::vector<double> half_spin;
  std::vector<Vec2> force;  // [dyn] total
  std::vector<double> torque;
  std::vector<std::array<Vec2, 2>> derivatives;  // Gear: b dt^3/6, c dt^4/24 of positions
  std::vector<Vec2> spin_derivatives;            // the same two of angles
  std::vector<Vec2> candidate_position;          // of every triangle when candidates were last looked for
  std::vector<double> candidate_angle;
  std::vector<Vec2> wall_position;  // of wall and lid triangles, in storage order, where the stage found the container
  std::vector<double> wall_angle;
  std::vector<PairMemory<GrainHistory>> pairs;  // of grains
  ListMemory<2> lists;                          // of grains
};

class TriangleEngine;

struct TriangleGrains {
  static constexpr std::string_view name = "triangles";
  static constexpr int dimension = 2;
  using Packing = TrianglePacking;
  using Law = TriangleLaw;
  using Memory = TriangleMemory;
  using Engine = TriangleEngine;
};

}  // namespace isostat
