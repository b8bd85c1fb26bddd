// Random states of disks for tests of the solver: moving, turning, overlapping, cohesive or not.
#pragma once
#include <cstdint>

#include "dem/disks/disks.hpp"
#include "dem/disks/sample.hpp"
#include "dem/solver/random.hpp"

namespace isostat::oracle {

struct RandomDisks {
  int count = 40;
  double solid_fraction = 0.5;  // of the non-overlapping start
  double squeeze = 0.92;        // then cell and positions shrink by this factor: some pairs overlap
  double diameter_min = 0.5;
  double aspect = 1;
  double speed = 1, spin = 2;  // [a/T0], [1/T0] scale of the velocities
  double step_fraction = 0.06;
  LawScene law;
  std::uint64_t seed = 1;
  double gravity = 0;
  ContainerScene container;  // in place of the cell; nothing is squeezed then
  ContainerMotionScene motion;
};

// A law soft enough for violent random states, with every axis on and a long attraction.
inline LawScene soft_law() {
  LawScene law;
  law.normal_stiffness = 1e3;
  law.tangential_stiffness = 7e2;
  law.damping = 0.4, law.friction = 0.3;
  law.rolling = true, law.rolling_friction = 0.02, law.rolling_stiffness = 30;
  law.attraction = 2, law.attraction_range = 0.05;
  return law;
}

inline State<Disks> random_state(const RandomDisks& r) {
  Scene scene;
  scene.grains.count = r.count;
  scene.grains.solid_fraction = r.solid_fraction;
  scene.grains.diameter_min = r.diameter_min;
  scene.cell.aspect = r.aspect;
  scene.law = r.law;
  scene.step.fraction = r.step_fraction;
  scene.gravity = r.gravity;
  scene.container = r.container;
  scene.stages.resize(1);
  scene.stages[0].container = r.motion;
  State<Disks> s = initial_disks(scene, r.seed);
  Random random(r.seed + 1000);
  const bool contained = r.container.shape != ContainerShape::none;
  s.progress.started = contained;
  if (!contained)
    for (int a = 0; a < 2; ++a) s.packing.cell->length[a] *= r.squeeze;
  for (std::size_t k = 0; k < s.packing.bodies.size(); ++k) {
    if (!contained) s.packing.bodies.position[k] = r.squeeze * s.packing.bodies.position[k];
    s.packing.bodies.velocity[k] = {{r.speed * random.normal(), r.speed * random.normal()}};
    s.packing.bodies.spin[k] = r.spin * random.normal();
  }
  if (!contained) s.cell_motion.reference_length = s.packing.cell->length;
  return s;
}

inline double total_mass(const State<Disks>& s) {
  double mass = 0;
  for (double m : s.packing.bodies.mass) mass += m;
  return mass;
}

}  // namespace isostat::oracle
