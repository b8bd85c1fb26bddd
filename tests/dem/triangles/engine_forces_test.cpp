// The forces of the engine against those of dem/triangles/certificate.hpp, which knows no lists and no lanes, and those
// against the energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "dem/solver/random.hpp"
#include "dem/triangles/certificate.hpp"
#include "dem/triangles/energy.hpp"
#include "dem/triangles/engine.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/overlap_search.hpp"
#include "dem/triangles/sample.hpp"
#include "geometry/base/index.hpp"
#include "tests/support/machine_isas.hpp"
#include "tests/support/moving_triangles.hpp"

namespace isostat {
namespace {

using oracle::moving_triangles;
using oracle::MovingTriangles;

// Grains pushed into each other and out of shape, at rest.
State<TriangleGrains> dense_state(MovingTriangles m, double squeeze = 0.85) {
  State<TriangleGrains> s = moving_triangles(m);
  TrianglePacking& p = s.packing;
  Random random(m.seed + 77);
  for (std::size_t g = 0; g < p.grains.size(); ++g) {
    if (p.grains.part[g] != GrainPart::free) continue;
    const Vec2 first = p.bodies.position[idx(p.grains.begin[g])], shift = (squeeze - 1) * first;
    for (auto k = idx(p.grains.begin[g]); k < idx(p.grains.begin[g + 1]); ++k) {
      p.bodies.position[k] += shift + Vec2{{0.004 * random.normal(), 0.004 * random.normal()}};
      p.angle[k] += 0.1 * random.normal();
    }
  }
  if (p.cell)
    for (int a = 0; a < 2; ++a) p.cell->length[a] *= squeeze;
  s.cell_motion.reference_length = p.cell ? p.cell->length : Vec2{};
  std::fill(p.bodies.velocity.begin(), p.bodies.velocity.end(), Vec2{});
  std::fill(p.bodies.spin.begin(), p.bodies.spin.end(), 0.0);
  p.overlaps = overlaps_of(p, s.law, overlapping_triangles(p));
  return s;
}

// Largest difference of a component of a load, over the largest load.
double difference(const State<TriangleGrains>& s) {
  const std::vector<BodyLoad> loads = net_loads(s.packing, s.law, 0);
  double largest = 0, most = 0;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    largest = std::max({largest, std::abs(loads[k].fx), std::abs(loads[k].fy)});
    most = std::max({most, std::abs(loads[k].fx - s.memory.force[k][0]), std::abs(loads[k].fy - s.memory.force[k][1]),
                     std::abs(loads[k].moment - s.memory.torque[k])});
  }
  EXPECT_GT(largest, 1);
  return most / largest;
}

TEST(EngineForces, AreThoseAtRestForEveryInstructionSet) {
  for (const char* shapes : {"square", "square,L,polygon5,rod,star,triangle"})
    for (const ContainerShape around : {ContainerShape::none, ContainerShape::box})
      for (const ContactLaw law : {ContactLaw::overlap_energy, ContactLaw::paper})
        for (const double friction : {0.0, 0.4}) {
          if (law == ContactLaw::paper && friction > 0) continue;
          SCOPED_TRACE(std::string(shapes) + (around == ContainerShape::box ? " in a box, " : " in a cell, ") +
                       std::string(kContactLawNames[static_cast<std::size_t>(law)]) + std::to_string(friction));
          MovingTriangles m;
          m.count = 60, m.shapes = shapes;
          m.law.contact = law, m.law.friction = friction;
          m.container.shape = around, m.container.walls = ContainerWalls::smooth, m.container.width = 2.5;
          State<TriangleGrains> s = dense_state(m);
          ASSERT_GT(s.packing.overlaps.size(), 40u);
          Random random(5);
          for (Overlap& o : s.packing.overlaps)
            o.tangential_force = friction * o.normal_force * (2 * random.uniform() - 1);
          CellControl<2> control;
          if (s.packing.cell) control.stress = isotropic<2>(0.0);
          for (const Isa isa : machine_isas()) {
            SolverOptions options;
            options.isa = isa;
            State<TriangleGrains> end = s;
            Solver<TriangleGrains>(s, control, options).snapshot(end);
            EXPECT_LT(difference(end), 1e-12) << name(isa);
            if (!s.packing.cell) continue;
            const StressTensor stress = measured_stress(end);
            const double scale = std::abs(stress.xx) + std::abs(stress.yy);
            EXPECT_NEAR(end.cell_motion.stress[0], stress.xx, 1e-12 * scale) << name(isa);
            EXPECT_NEAR(end.cell_motion.stress[1], stress.yy, 1e-12 * scale) << name(isa);
          }
        }
}

// In fast flow lists and candidates live through many rebuilds; a missed pair of triangles would leave its force out.
TEST(EngineForces, MissNoOverlapInFastFlow) {
  for (const char* shapes : {"square", "square,L,polygon5"})
    for (const bool box : {false, true}) {
      SCOPED_TRACE(std::string(shapes) + (box ? " in a shaken box" : " in a cell that shrinks"));
      MovingTriangles m;
      m.count = 50, m.shapes = shapes, m.speed = 60;
      if (m.shapes != "square") m.law = oracle::soft_beams();
      m.law.damping = 0;  // so that all forces are those at rest
      CellControl<2> control;
      if (box) {
        m.container.shape = ContainerShape::box, m.container.walls = ContainerWalls::grains, m.container.width = 2;
        m.gravity = 981, m.motion.vibration_amplitude = 0.05, m.motion.vibration_frequency = 300;
      } else {
        control.strain_rate = {{30, 20}};
      }
      State<TriangleGrains> s = moving_triangles(m);
      Solver<TriangleGrains> solver(s, control);
      double worst = 0;
      std::size_t pairs = 0;
      for (int k = 0; k < 1000; ++k) {
        solver.step();
        solver.snapshot(s);
        worst = std::max(worst, difference(s));
        pairs = std::max(pairs, overlapping_triangles(s.packing).size());
      }
      EXPECT_LT(worst, 1e-12);
      EXPECT_GT(pairs, 20u);
      EXPECT_GE(solver.engine().lists().inner_rebuilds(), 2u);  // since a grain last outgrew its circle
    }
}

// A rod of soft beams that is drawn out far beyond its circle still meets the squares beside its ends.
TEST(EngineForces, FollowAGrainThatOutgrowsItsCircle) {
  MovingTriangles m;
  m.count = 1, m.shapes = "rod";
  m.law.damping = 0;
  m.container.shape = ContainerShape::box, m.container.walls = ContainerWalls::smooth, m.solid_fraction = 0.02;
  State<TriangleGrains> s = moving_triangles(m);
  s.packing = {};
  const GrainTemplate rod = grain_template(grain_shape("rod", 0.2), {1, 500, 0.1, 0}),
                      square = grain_template(grain_shape("square", 0.1), {});
  append_grain(s.packing, rod, {}, 0, GrainPart::free, 0);
  for (const double side : {-1.0, 1.0})
    append_grain(s.packing, square, {{0.45 * side, 0.01}}, 0.2, GrainPart::free, side < 0 ? 1 : 2);
  for (std::size_t k = 0; k < rod.triangles.size(); ++k)
    s.packing.bodies.velocity[k] = {{s.packing.bodies.position[k][0] / 0.1 * 400, 0}};
  const double circle = s.packing.grains.radius[0];
  double length = 0;
  Solver<TriangleGrains> solver(s, {});
  std::size_t met = 0;
  for (int k = 0; k < 600; ++k) {
    solver.step();
    solver.snapshot(s);
    EXPECT_LT(difference(s), 1e-11) << "step " << k;
    std::vector<double> x;
    for (std::size_t t = 0; t < 8; ++t)
      for (const Vec2& c : corners_of(s.packing, t)) x.push_back(c[0]);
    length = std::max(length, *std::max_element(x.begin(), x.end()) - *std::min_element(x.begin(), x.end()));
    met = std::max(met, s.packing.overlaps.size());
  }
  EXPECT_GT(length, 4 * circle);
  EXPECT_EQ(met, 2u);
}

// Central differences of the energy in every coordinate; where corners pass edges its second derivative jumps.
TEST(EngineForces, AreTheGradientOfTheEnergy) {
  MovingTriangles m;
  m.count = 20, m.shapes = "square,L,rod,triangle";
  State<TriangleGrains> s = dense_state(m);
  const auto energy = [&] {
    s.packing.overlaps = overlaps_of(s.packing, s.law, overlapping_triangles(s.packing));
    return energies(s).total();
  };
  const std::vector<BodyLoad> loads = net_loads(s.packing, s.law, 0);
  double scale = 0;
  for (const BodyLoad& l : loads) scale = std::max({scale, std::abs(l.fx), std::abs(l.fy)});
  const auto slope = [&](double& coordinate, double by) {
    const double here = coordinate;
    coordinate = here + by;
    const double above = energy();
    coordinate = here - by;
    const double below = energy();
    coordinate = here;
    return (above - below) / (2 * by);
  };
  for (std::size_t k = 0; k < loads.size(); ++k) {
    EXPECT_NEAR(-slope(s.packing.bodies.position[k][0], 1e-7), loads[k].fx, 1e-6 * scale);
    EXPECT_NEAR(-slope(s.packing.bodies.position[k][1], 1e-7), loads[k].fy, 1e-6 * scale);
    EXPECT_NEAR(-slope(s.packing.angle[k], 1e-6), loads[k].moment, 1e-6 * scale);
  }
}

}  // namespace
}  // namespace isostat
