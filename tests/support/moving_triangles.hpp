// States of grains of triangles in violent motion, for tests of the solver.
#pragma once
#include <cstdint>
#include <string>

#include "dem/triangles/triangles.hpp"

namespace isostat::oracle {

struct MovingTriangles {
  int count = 40;
  std::string shapes = "square";  // separated by commas, in turn
  double solid_fraction = 0.5;    // of the start without overlaps
  double speed = 100;             // [cm/s] scale of the velocities of grains; of triangles against theirs a tenth
  double spin = 200;              // [1/s] scale of the spins of grains
  double step_fraction = 0;       // [1/omega] 0: 0.3, of Gear 0.1
  Integrator integrator = Integrator::verlet;
  TriangleLawScene law;
  double gravity = 0;
  ContainerScene container;     // none: a periodic cell
  ContainerMotionScene motion;  // of the only stage
  std::uint64_t seed = 1;
};

// Beams and dampers with which grains of small triangles bear the step of squares.
inline TriangleLawScene soft_beams() {
  TriangleLawScene law;
  law.bending = 0.3, law.damping = 1;
  return law;
}
State<TriangleGrains> moving_triangles(const MovingTriangles& m);

// Sum over the free grains.
double total_mass(const State<TriangleGrains>& state);
Vec2 momentum(const State<TriangleGrains>& state);
double angular_momentum(const State<TriangleGrains>& state);  // about the origin

}  // namespace isostat::oracle
