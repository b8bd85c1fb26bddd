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
  double speed = 80;              // [cm/s] scale of the velocities of grains; of triangles against theirs a tenth
  double spin = 150;              // [1/s] scale of the spins of grains
  double step_fraction = 0.25;    // [1/omega]
  Integrator integrator = Integrator::verlet;
  TriangleLawScene law;
  double gravity = 0;
  ContainerScene container;     // none: a periodic cell
  ContainerMotionScene motion;  // of the only stage
  std::uint64_t seed = 1;
};
State<TriangleGrains> moving_triangles(const MovingTriangles& m);

// Sum over the free grains.
double total_mass(const State<TriangleGrains>& state);
Vec2 momentum(const State<TriangleGrains>& state);
double angular_momentum(const State<TriangleGrains>& state);  // about the origin

}  // namespace isostat::oracle
