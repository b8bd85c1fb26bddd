// From a state into the engine.
#include <algorithm>
#include <cmath>

#include "dem/input_error.hpp"
#include "dem/run_error.hpp"
#include "dem/spheres/engine.hpp"
#include "dem/spheres/walls.hpp"

namespace isostat {

SphereEngine::SphereEngine(const State<Spheres>& state, const CellControl<3>& control, const SolverOptions& options)
    : law_(state.law),
      dt_(state.time_step),
      gravity_(state.scene.gravity),
      isa_(options.isa),
      begins_(state.memory.half_velocity.empty()),
      free_cell_(control.moves()),
      shears_(control.shears()),
      has_groups_(!state.packing.group.empty()),
      unlike_(!state.packing.kind.empty()),
      team_(std::min(options.threads, Lists::chunk_count(state.packing.bodies.size()))),
      lists_(state.packing.bodies.size(), law_.attraction > 0 ? law_.attraction_range : 0.0,
             SpherePairs(law_, unlike_)),
      walls_(state.packing.walls) {
  if (options.energies) throw InputError("scene", 0, "output.energies", "true", "there is no energy ledger of spheres");
  if (!state.packing.part.empty())
    throw InputError("scene", 0, "grains", "", "spheres are no parts of a container: use walls");
  if (free_cell_ && !walls_.empty()) throw InputError("scene", 0, "stage", "", "a cell with walls in it must not move");
  choose_kernels();
  load_bodies(state);
  load_springs(state);
  lists_are_new();
}

void SphereEngine::load_bodies(const State<Spheres>& state) {
  using spheres::LoadSlot;
  using spheres::Slot;
  const Bodies<3>& b = state.packing.bodies;
  const SphereMemory& m = state.memory;
  bodies_.resize(b.size());
  if (has_groups_) bodies_.group = state.packing.group;
  if (unlike_) bodies_.kind = state.packing.kind;
  smallest_diameter_ = INFINITY;
  for (std::size_t k = 0; k < b.size(); ++k) {
    double* row = bodies_.row(k);
    bodies_.id[k] = b.id[k];
    bodies_.constants[k] = {1 / b.mass[k], 1 / b.inertia[k], b.radius[k], b.mass[k]};
    bodies_.inertia[k] = b.inertia[k];
    bodies_.place(k, b.position[k]);
    put_triple(row + Slot::velocity, b.velocity[k]);
    put_triple(row + Slot::surface, b.radius[k] * b.spin[k]);
    bodies_.set_half_velocity(k, begins_ ? b.velocity[k] : m.half_velocity[k]);
    bodies_.set_half_spin(k, begins_ ? b.spin[k] : m.half_spin[k]);
    smallest_diameter_ = std::min(smallest_diameter_, 2 * bodies_.radius(k));
    largest_diameter_ = std::max(largest_diameter_, 2 * bodies_.radius(k));
    if (begins_) {
      bodies_.load(k)[LoadSlot::force + 2] = -(b.mass[k] * gravity_) + 0.0;
    } else {
      put_triple(bodies_.load(k) + LoadSlot::force, m.force[k]);
      put_triple(bodies_.moment(k), m.torque[k]);
    }
  }
  if (!begins_) next_motion_kernel_ = select_motion({rotates_, free_cell_, true, shears_}, isa_);
}

void SphereEngine::load_springs(const State<Spheres>& state) {
  if (!begins_) {
    for (const WallSpring& s : state.memory.wall_springs)
      bodies_.near_walls.push_back({s.body, s.wall, s.tangential_force});
    return lists_.restore(bodies_, state.memory.lists, state.memory.pairs);
  }
  for (const WallLink& l : state.packing.wall_links) bodies_.near_walls.push_back({l.body, l.wall, l.tangential_force});
  std::vector<PairMemory<SphereHistory, 3>> springs;
  for (const Link<3>& l : state.packing.links)
    if (is_contact(l.kind)) {
      const SphereHistory history{l.tangential_force, l.moment};
      if (l.i < l.j)
        springs.push_back({l.i, l.j, l.shift, history});
      else
        springs.push_back({l.j, l.i, {-l.shift[0], -l.shift[1], -l.shift[2]}, SpherePairs::turned(history)});
    }
  try {
    lists_.build(bodies_, state.packing.cell, std::move(springs));
  } catch (const ListFailure& e) {
    throw RunError(state.step, -1, e.what(), "use more grains (grains.count) or a larger cell (grains.solid_fraction)");
  }
}

// Every sphere that may touch a wall before the inner list is made anew. The springs known already stand by body, then
// wall.
void SphereEngine::find_near_walls() {
  const std::vector<NearWall> known = std::move(bodies_.near_walls);
  std::vector<NearWall>& near = bodies_.near_walls;
  near.clear();
  near_begin_.assign(1, 0);
  std::size_t next = 0;
  for (int chunk = 0; chunk < lists_.chunks(); ++chunk) {
    for (std::size_t k = lists_.chunk_begin(chunk); k < lists_.chunk_begin(chunk + 1); ++k)
      for (std::size_t w = 0; w < walls_.size(); ++w) {
        if (!acts_on(walls_[w], bodies_.group[k], bodies_.kind[k])) continue;
        const double gap = wall_frame(walls_[w], bodies_.position(k)).distance - bodies_.radius(k);
        if (gap > lists_.inner_skin()) continue;
        const NearWall found{static_cast<std::int32_t>(k), static_cast<std::int32_t>(w), {}};
        while (next < known.size() &&
               (known[next].body < found.body || (known[next].body == found.body && known[next].wall < found.wall)))
          ++next;
        near.push_back(found);
        if (next < known.size() && known[next].body == found.body && known[next].wall == found.wall)
          near.back().tangential_force = known[next].tangential_force;
      }
    near_begin_.push_back(near.size());
  }
}

}  // namespace isostat
