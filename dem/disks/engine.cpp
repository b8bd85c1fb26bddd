#include "dem/disks/engine.hpp"

#include <algorithm>
#include <cmath>

#include "dem/disks/at_rest.hpp"
#include "dem/run_error.hpp"
#include "dem/solver/dispatch.hpp"
#include "dem/solver/neighbours_impl.hpp"

namespace isostat {
namespace {

using kernel::LoadSlot;
using kernel::Slot;

constexpr double kMostMove = 0.1;     // [smallest diameter] in one step: beyond, the run has blown up
constexpr double kMostOverlap = 0.5;  // [R_i + R_j]
constexpr double kBeyondJoint = 2;    // [largest diameter] that smooth walls go on behind each other

double largest_diameter(const Packing<2>& packing) {
  double largest = 0;
  for (const double r : packing.bodies.radius) largest = std::max(largest, 2 * r);
  return largest;
}

// Springs at smooth walls are those of the links to feet.
std::vector<WallContacts::Spring> wall_springs(const Packing<2>& p) {
  std::vector<WallContacts::Spring> springs;
  const auto grains = static_cast<std::int32_t>(p.grains());
  for (const Link<2>& l : p.links) {
    if (std::max(l.i, l.j) < grains || std::min(l.i, l.j) >= grains) continue;
    const bool turned = l.i >= grains;
    const Foot& foot = p.feet[static_cast<std::size_t>((turned ? l.i : l.j) - grains)];
    springs.push_back({p.bodies.id[static_cast<std::size_t>(turned ? l.j : l.i)],
                       foot.wall,
                       {l.tangential_force, turned ? -l.moment : l.moment}});
  }
  return springs;
}

}  // namespace

template class NeighbourLists<DiskPairs>;

DiskEngine::DiskEngine(const State<Disks>& state, const CellControl<2>& control, const SolverOptions& options)
    : law_(state.law),
      dt_(state.time_step),
      gravity_(state.scene.gravity),
      ledger_(state.ledger),
      begins_(state.memory.half_velocity.empty()),
      energies_(options.energies),
      rotates_(law_.friction > 0 || law_.rolling_friction > 0),
      force_kernel_(select_kernel(law_,
                                  options.energies  ? Tally::energy
                                  : control.moves() ? Tally::stress
                                                    : Tally::nothing,
                                  options.isa, control.shears() ? Flow::shear : Flow::stretch)),
      wall_kernel_(select_kernel(law_, options.energies ? Tally::energy : Tally::nothing, Isa::scalar)),
      motion_kernel_(select_motion({rotates_, control.moves(), gravity_ > 0, control.shears()})),
      team_(std::min(options.threads, Lists::chunk_count(state.packing.grains()))),
      lists_(state.packing.grains(), law_.attraction_range, DiskPairs(law_)),
      walls_(smooth_walls(state.scene.container, kBeyondJoint * largest_diameter(state.packing)),
             state.surroundings.open, law_) {
  load_bodies(state);
  if (smallest_mass_ == INFINITY) smallest_mass_ = 1;  // nothing but a container
  prediction_ = velocity_prediction(law_, smallest_mass_, dt_);
  // A stage begins: from here on the container moves in another way than it did.
  if (energies_ && !begins_ && state.time == stage_start_) ledger_.wall_work_due = 0.5 * dt_ * wall_power();
}

void DiskEngine::load_bodies(const State<Disks>& state) {
  const Bodies<2>& b = state.packing.bodies;
  const DiskMemory& m = state.memory;
  const std::size_t grains = state.packing.grains();
  bodies_.resize(grains);
  load_walls(state);
  smallest_diameter_ = smallest_mass_ = INFINITY;
  for (std::size_t k = 0; k < grains; ++k) {
    const Vec2 u = begins_ ? b.velocity[k] : m.half_velocity[k];
    const double w = begins_ ? b.spin[k] : m.half_spin[k];
    double* row = bodies_.row(k);
    bodies_.place(k, b.position[k]);
    row[Slot::half_vx] = u[0], row[Slot::half_vy] = u[1];
    row[Slot::surface_speed] = b.radius[k] * w, row[Slot::half_spin] = w;
    row[Slot::vx] = b.velocity[k][0], row[Slot::vy] = b.velocity[k][1];
    bodies_.id[k] = b.id[k];
    const bool free = is_free(state.packing.part, k);
    bodies_.constants[k] = {free ? 1 / b.mass[k] : 0, free ? 1 / b.inertia[k] : 0, b.radius[k], b.mass[k]};
    bodies_.inertia[k] = b.inertia[k];
    smallest_diameter_ = std::min(smallest_diameter_, 2 * b.radius[k]);
    if (free) smallest_mass_ = std::min(smallest_mass_, b.mass[k]);
    largest_diameter_ = std::max(largest_diameter_, 2 * b.radius[k]);
    double* load = bodies_.load(k);
    load[LoadSlot::fy] = -(b.mass[k] * gravity_) + 0.0;
    if (!begins_) {
      load[LoadSlot::fx] = m.force[k][0], load[LoadSlot::fy] = m.force[k][1], load[LoadSlot::moment] = m.torque[k];
    }
  }
  if (walls_.any()) ids_ = bodies_.id, std::sort(ids_.begin(), ids_.end());
  if (!begins_) {
    lists_.restore(bodies_, m.lists, m.pairs);
    list_walls(wall_springs(state.packing));
    return load_feet(m);
  }
  place_walls();
  std::vector<PairMemory<DiskHistory>> springs;
  for (const Link<2>& l : state.packing.links)
    if (is_contact(l.kind) && static_cast<std::size_t>(std::max(l.i, l.j)) < grains) {
      const bool swap = l.i > l.j;
      springs.push_back({swap ? l.j : l.i,
                         swap ? l.i : l.j,
                         swap ? ImageShift<2>{-l.shift[0], -l.shift[1]} : l.shift,
                         {l.tangential_force, swap ? -l.moment : l.moment}});
    }
  try {
    lists_.build(bodies_, state.packing.cell, std::move(springs));
  } catch (const ListFailure& e) {
    throw RunError(state.step, -1, e.what(), "use more grains (grains.count) or a larger cell (grains.solid_fraction)");
  }
  list_walls(wall_springs(state.packing));
}

// The forces of the last step.
void DiskEngine::load_feet(const DiskMemory& m) {
  const std::vector<std::size_t> touching = touching_walls();
  if (m.force.size() != bodies_.size() + touching.size()) return;
  for (std::size_t n = 0; n < touching.size(); ++n) {
    double* load = bodies_.load(bodies_.foot(touching[n]));
    load[LoadSlot::fx] = m.force[bodies_.size() + n][0], load[LoadSlot::fy] = m.force[bodies_.size() + n][1];
    load[LoadSlot::moment] = m.torque[bodies_.size() + n];
  }
}

// Where its bodies were built: kept by the memory, else from where they stand.
void DiskEngine::load_walls(const State<Disks>& state) {
  const std::vector<GrainPart>& part = state.packing.part;
  container_motion_ = container_motion_of(state);
  surroundings_ = state.surroundings, stage_start_ = state.progress.start_time;
  move_container(state.time);
  const ContainerPlacement& now = container_.now;
  const std::vector<Vec2>& built = state.memory.wall_position;
  for (std::size_t k = 0; k < std::min(part.size(), bodies_.size()); ++k) {
    if (part[k] == GrainPart::free) continue;
    const std::size_t w = bodies_.driven.size();
    bodies_.driven.push_back({static_cast<std::int32_t>(k),
                              built.empty() ? built_at(now, state.packing.bodies.position[k]) : built[w], part[k]});
  }
}

void DiskEngine::move_container(double time) {
  const double in_stage = time - stage_start_;
  container_ = {container_at(container_motion_, surroundings_, in_stage),
                container_at(container_motion_, surroundings_, in_stage - 0.5 * dt_)};
}

// Springs are stretched by half-step velocities, those in the middle of the step that ends now.
double DiskEngine::place_walls() {
  const auto& [now, half] = container_;
  double fastest = walls_.largest_speed(container_);
  for (const DrivenBody& d : bodies_.driven) {
    const auto k = static_cast<std::size_t>(d.body);
    const Vec2 r = point_at(now, d.built), u = velocity_at(half, point_at(half, d.built)), v = velocity_at(now, r);
    double* row = bodies_.row(k);
    bodies_.place(k, r);
    row[Slot::half_vx] = u[0], row[Slot::half_vy] = u[1];
    row[Slot::surface_speed] = bodies_.radius(k) * half.spin, row[Slot::half_spin] = half.spin;
    row[Slot::vx] = v[0], row[Slot::vy] = v[1];
    fastest = std::max(fastest, norm(u));
  }
  return fastest;
}

void DiskEngine::list_walls(std::vector<WallContacts::Spring> springs) {
  if (!walls_.any()) return;
  walls_.list(bodies_, container_, law_.attraction_range + lists_.inner_skin(), std::move(springs));
}

void DiskEngine::start_half_steps() {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    double *row = bodies_.row(k), *load = bodies_.load(k);
    const BodyConstants& c = bodies_.constants[k];
    row[Slot::half_vx] -= 0.5 * dt_ * load[LoadSlot::fx] * c.inverse_mass;
    row[Slot::half_vy] -= 0.5 * dt_ * load[LoadSlot::fy] * c.inverse_mass;
    row[Slot::half_spin] -=
        0.5 * dt_ * (c.radius * load[LoadSlot::moment_per_radius] + load[LoadSlot::moment]) * c.inverse_inertia;
    row[Slot::surface_speed] = c.radius * row[Slot::half_spin];
    for (int a = 0; a < 2; ++a) motion_tally_.kinetic[a] += c.mass * row[Slot::vx + a] * row[Slot::vx + a];
    motion_tally_.shear_kinetic += c.mass * row[Slot::vx] * row[Slot::vy];
  }
  if (energies_) set_work_due();
}

Advance DiskEngine::advance(const MotionStep<2>& step, double drag) {
  if (energies_ && (step.keep[0] != 1 || step.keep[1] != 1 || step.shear_coupling != 0)) brake_ledger(step, drag);
  over_chunks(team_, lists_, motion_tallies_, [&](std::size_t begin, std::size_t end) {
    return motion_kernel_(bodies_, begin, end, step, prediction_, gravity_);
  });
  motion_tally_ = {};
  for (const MotionTally& t : motion_tallies_) {
    motion_tally_.largest_speed_squared = std::max(motion_tally_.largest_speed_squared, t.largest_speed_squared);
    motion_tally_.kinetic[0] += t.kinetic[0], motion_tally_.kinetic[1] += t.kinetic[1];
    motion_tally_.shear_kinetic += t.shear_kinetic;
  }
  if (step.turns != 0) lists_.turn(step.turns);
  double speed = std::sqrt(motion_tally_.largest_speed_squared);
  if (!bodies_.driven.empty() || walls_.any()) {
    move_container(step.time);
    speed = std::max(speed, place_walls());
  }
  const double move = dt_ * speed;
  const double affine = std::max(std::abs(step.scale[0] - 1), std::abs(step.scale[1] - 1)) + std::abs(step.shear);
  // Listed neighbours are nearer than two diameters and the range; the first factor covers the rescaling of the
  // peculiar move, and the rounding of travels summed over many steps.
  return {(1.01 + affine) * (2 * move + affine * (2 * largest_diameter_ + law_.attraction_range)),
          !(move <= kMostMove * smallest_diameter_)};
}

void DiskEngine::update_lists(const Cell& cell, double displacement) {
  const std::size_t before = lists_.inner_rebuilds();
  lists_.update(bodies_, cell, displacement);
  if (!walls_.any()) return;
  if (lists_.inner_rebuilds() != before)
    list_walls(walls_.springs());
  else
    walls_.place(bodies_, container_);
}

void DiskEngine::compute_forces(const Cell& cell, const CellFlow<2>& flow, double time_step) {
  cell_ = cell, flow_ = flow;
  PairForceInput in;
  in.rows = bodies_.rows.data();
  in.loads = bodies_.loads.data();
  in.pairs = {lists_.i(),
              lists_.j(),
              lists_.shift(),
              lists_.columns().damping(),
              lists_.columns().radius_sum(),
              lists_.columns().tangential(),
              lists_.columns().moment()};
  in.law = law_;
  in.time_step = time_step;
  for (int a = 0; a < 2; ++a) in.flow_half[a] = flow_.half[a], in.flow_now[a] = flow_.now[a];
  in.shear_half = flow_.shear_half, in.shear_now = flow_.shear_now;
  for (std::uint8_t code = 0; code < 9 && cell; ++code) {
    const Vec2 offset = cell->offset(image_shift<2>(code));
    in.offset_x[code] = offset[0], in.offset_y[code] = offset[1];
  }
  force_tally_ = over_groups(team_, lists_, force_tallies_, [&](const PairGroup& group) {
    PairForceTally tally;
    PairForceInput part = in;
    part.begin = group.begin, part.end = group.images, part.images = false;
    if (part.begin < part.end) tally += force_kernel_(part);
    part.begin = group.images, part.end = group.end, part.images = true;
    if (part.begin < part.end) tally += force_kernel_(part);
    return tally;
  });
  if (walls_.size() == 0) return;
  // Pair by pair, so that its sums do not depend on which disks are listed but do not touch; after all other forces.
  in.pairs = walls_.arrays();
  in.begin = 0, in.end = walls_.size();
  in.rows = bodies_.rows.data(), in.loads = bodies_.loads.data();
  force_tally_ += wall_kernel_(in);
}

StressSums<2> DiskEngine::sums() const {
  return {{motion_tally_.kinetic[0], motion_tally_.kinetic[1]},
          {force_tally_.virial[0], force_tally_.virial[1]},
          motion_tally_.shear_kinetic,
          force_tally_.shear_virial};
}

void DiskEngine::set_law(const DiskLaw& law, Springs springs) {
  if (energies_) ledger_.injected -= elastic_energy();
  for (DiskPairs* pairs : {&lists_.columns(), &walls_.columns()}) {
    if (springs == Springs::keep_elongations) {
      const auto growth = [](double now, double before) { return before > 0 ? now / before : 1.0; };
      pairs->scale_springs(growth(law.tangential_stiffness, law_.tangential_stiffness),
                           growth(law.rolling_stiffness, law_.rolling_stiffness));
    }
    pairs->set_stiffness(law.normal_stiffness);
  }
  for_each_pair(*this, [&](DiskPairs& pairs, std::size_t k, std::int32_t i, std::int32_t j, std::uint8_t) {
    pairs.set_damping(k, bodies_.constants[static_cast<std::size_t>(i)],
                      bodies_.constants[static_cast<std::size_t>(j)]);
  });
  law_ = law;
  prediction_ = velocity_prediction(law_, smallest_mass_, dt_);
  if (energies_) ledger_.injected += elastic_energy();
}

Vec2 DiskEngine::branch(std::int32_t i, std::int32_t j, std::uint8_t shift, const Cell& cell) const {
  const Vec2 far = bodies_.position(static_cast<std::size_t>(j)), near = bodies_.position(static_cast<std::size_t>(i));
  return cell ? far + cell->offset(image_shift<2>(shift)) - near : far - near;
}

void DiskEngine::check_bodies(std::int64_t step) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const double* row = bodies_.row(k);
    const double move = dt_ * std::hypot(row[Slot::half_vx], row[Slot::half_vy]);
    if (!std::isfinite(row[Slot::x] + row[Slot::y] + row[Slot::half_vx] + row[Slot::half_vy] + row[Slot::half_spin]))
      throw RunError(step, bodies_.id[k], "its position or velocity is not a number", "lower step.fraction");
    if (!(move <= kMostMove * smallest_diameter_))
      throw RunError(step, bodies_.id[k], "it moves " + std::to_string(move) + " a in one step",
                     "lower step.fraction or stage.velocity");
  }
}

void DiskEngine::check_overlaps(const Cell& cell, std::int64_t step) const {
  for_each_pair(*this, [&](const DiskPairs&, std::size_t, std::int32_t i, std::int32_t j, std::uint8_t shift) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const double sum = bodies_.radius(a) + bodies_.radius(b), distance = norm(branch(i, j, shift, cell));
    if (distance < (1 - kMostOverlap) * sum)
      throw RunError(step, bodies_.id[a],
                     "it overlaps " +
                         (b < bodies_.size() ? "grain " + std::to_string(bodies_.id[b]) : std::string("a wall")) +
                         " by " + std::to_string(sum - distance) + " a",
                     "raise law.normal_stiffness or lower stage.pressure");
  });
}

void DiskEngine::snapshot(State<Disks>& s) const {
  s.ledger = ledger_;
  s.law = law_;
  snapshot_bodies(s);
  snapshot_feet(s);
  lists_.remember(s.memory.lists, s.memory.pairs);
  snapshot_links(s);
}

void DiskEngine::snapshot_bodies(State<Disks>& s) const {
  const std::size_t n = bodies_.size();
  const double half = 0.5 * dt_;
  Bodies<2>& b = s.packing.bodies;
  b.resize(n);
  DiskMemory& m = s.memory;
  m.half_velocity.resize(n), m.half_spin.resize(n), m.force.resize(n), m.torque.resize(n);
  s.packing.part.assign(bodies_.driven.empty() ? 0 : n, GrainPart::free);
  m.wall_position.clear();
  for (std::size_t k = 0; k < n; ++k) {
    const double *row = bodies_.row(k), *load = bodies_.load(k);
    const BodyConstants& c = bodies_.constants[k];
    const double torque = c.radius * load[LoadSlot::moment_per_radius] + load[LoadSlot::moment];
    b.id[k] = bodies_.id[k];
    b.position[k] = bodies_.position(k);
    b.velocity[k] = {{row[Slot::half_vx] + half * load[LoadSlot::fx] * c.inverse_mass,
                      row[Slot::half_vy] + half * load[LoadSlot::fy] * c.inverse_mass}};
    b.spin[k] = row[Slot::half_spin] + half * torque * c.inverse_inertia;
    b.radius[k] = c.radius, b.mass[k] = c.mass, b.inertia[k] = bodies_.inertia[k];
    m.half_velocity[k] = {{row[Slot::half_vx], row[Slot::half_vy]}};
    m.half_spin[k] = row[Slot::half_spin];
    m.force[k] = {{load[LoadSlot::fx], load[LoadSlot::fy]}};
    m.torque[k] = torque;
  }
  for (const DrivenBody& d : bodies_.driven) {
    const auto k = static_cast<std::size_t>(d.body);
    const double* row = bodies_.row(k);
    b.velocity[k] = {{row[Slot::vx], row[Slot::vy]}};
    s.packing.part[k] = d.part;
    m.wall_position.push_back(d.built);
  }
}

// By the ids of their disks and the numbers of their walls: the order must not depend on the storage.
std::vector<std::size_t> DiskEngine::touching_walls() const {
  std::vector<std::size_t> touching;
  walls_.for_each([&](std::size_t k, std::int32_t i, std::int32_t j) {
    const double radius = bodies_.radius(static_cast<std::size_t>(i)), distance = norm(branch(i, j, kNoImage<2>, {}));
    const double gap = distance - radius;
    if (gap < 0 || (law_.attraction > 0 && gap < law_.attraction_range)) touching.push_back(k);
  });
  std::sort(touching.begin(), touching.end(), [this](std::size_t a, std::size_t b) {
    return std::pair(walls_.disk(a), walls_.wall(a)) < std::pair(walls_.disk(b), walls_.wall(b));
  });
  return touching;
}

// The foot of a disk on a wall has the same id as long as the same disks are there.
void DiskEngine::snapshot_feet(State<Disks>& s) const {
  Bodies<2>& b = s.packing.bodies;
  DiskMemory& m = s.memory;
  s.packing.feet.clear();
  if (!walls_.any()) return;
  if (s.packing.part.empty()) s.packing.part.assign(b.size(), GrainPart::free);
  for (const std::size_t k : touching_walls()) {
    const std::size_t foot = bodies_.foot(k);
    const double *row = bodies_.row(foot), *load = bodies_.load(foot);
    const auto rank = std::lower_bound(ids_.begin(), ids_.end(), walls_.disk(k)) - ids_.begin();
    b.id.push_back(ids_.back() + 1 + walls_.walls() * rank + walls_.wall(k));
    b.position.push_back(bodies_.position(foot));
    b.velocity.push_back({{row[Slot::vx], row[Slot::vy]}});
    b.spin.push_back(container_.now.spin);
    b.radius.push_back(0), b.mass.push_back(0), b.inertia.push_back(0);
    s.packing.part.push_back(walls_.part(k));
    s.packing.feet.push_back({walls_.wall(k), walls_.turning(k)});
    m.half_velocity.push_back({{row[Slot::half_vx], row[Slot::half_vy]}});
    m.half_spin.push_back(row[Slot::half_spin]);
    m.force.push_back({{load[LoadSlot::fx], load[LoadSlot::fy]}});
    m.torque.push_back(load[LoadSlot::moment]);
  }
}

// Static forces, by the law at rest: what a step adds for viscosity and for contacts that form in it is no part of
// them.
void DiskEngine::snapshot_links(State<Disks>& s) const {
  s.packing.links.clear();
  std::vector<std::int32_t> foot_at(walls_.size(), -1);  // in the packing
  if (walls_.any())
    for (std::size_t n = 0; const std::size_t k : touching_walls())
      foot_at[k] = static_cast<std::int32_t>(s.packing.grains() + n++);
  for_each_pair(*this, [&](const DiskPairs& pairs, std::size_t k, std::int32_t i, std::int32_t j, std::uint8_t shift) {
    const Vec2 r = branch(i, j, shift, s.packing.cell);
    const LinkFrame<double> frame = link_frame(r[0], r[1], bodies_.radius(static_cast<std::size_t>(i)),
                                               bodies_.radius(static_cast<std::size_t>(j)));
    const bool touches = frame.gap < 0;
    if (!touches && !(law_.attraction > 0 && frame.gap < law_.attraction_range)) return;
    const DiskHistory springs = touches ? pairs.history(k) : DiskHistory{};
    Link<2> link;
    link.i = i, link.j = static_cast<std::size_t>(j) < bodies_.size() ? j : foot_at[k],
    link.shift = image_shift<2>(shift), link.gap = frame.gap;
    link.normal_force = at_rest(law_, frame.gap).force;
    link.tangential_force = springs.tangential_force, link.moment = springs.moment;
    link.kind = kind_of(law_, frame.gap, link.tangential_force, link.moment);
    s.packing.links.push_back(link);
  });
}

}  // namespace isostat
