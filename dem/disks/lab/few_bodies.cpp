#include "dem/disks/lab/few_bodies.hpp"

#include <cmath>

#include "dem/disks/sample.hpp"

namespace isostat::lab {

State<Disks> few_bodies(const LawScene& law, const std::vector<Disk>& disks, double fraction) {
  constexpr double kMargin = 50;  // [a] around the disks
  State<Disks> state;
  state.scene.law = law;
  state.scene.step.fraction = fraction;
  state.law = resolve(law);
  double extent = 0;
  Bodies<2>& b = state.packing.bodies;
  b.resize(disks.size());
  for (std::size_t k = 0; k < disks.size(); ++k) {
    b.id[k] = static_cast<std::int64_t>(k);
    b.position[k] = {{disks[k].x, disks[k].y}};
    b.velocity[k] = {{disks[k].vx, disks[k].vy}};
    b.spin[k] = disks[k].spin;
    b.radius[k] = disks[k].radius;
    extent = std::max({extent, std::abs(disks[k].x), std::abs(disks[k].y)});
  }
  set_disk_inertia(b);
  const double edge = 2 * (extent + kMargin);
  for (Vec2& r : b.position) r += Vec2{{edge / 2, edge / 2}};
  state.packing.cell = PeriodicCell<2>{{{edge, edge}}};
  state.cell_motion.reference_length = state.packing.cell->length;
  state.time_step = time_step(state.scene, state.law.normal_stiffness, state.packing);
  return state;
}

Disk disk(const State<Disks>& state, std::int64_t id) {
  const Bodies<2>& b = state.packing.bodies;
  for (std::size_t k = 0; k < b.size(); ++k)
    if (b.id[k] == id)
      return {b.position[k][0], b.position[k][1], b.radius[k], b.velocity[k][0], b.velocity[k][1], b.spin[k]};
  return {};
}

const Link<2>* find_link(const State<Disks>& state, std::int64_t id_i, std::int64_t id_j) {
  for (const Link<2>& l : state.packing.links) {
    const auto a = state.packing.bodies.id[static_cast<std::size_t>(l.i)];
    const auto b = state.packing.bodies.id[static_cast<std::size_t>(l.j)];
    if ((a == id_i && b == id_j) || (a == id_j && b == id_i)) return &l;
  }
  return nullptr;
}

}  // namespace isostat::lab
