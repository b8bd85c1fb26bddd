#include "dem/spheres/engine.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dem/run_error.hpp"
#include "dem/solver/dispatch.hpp"
#include "dem/solver/neighbours_impl.hpp"
#include "dem/spheres/walls.hpp"

namespace isostat {
namespace {

constexpr double kMostMove = 0.1;     // [smallest diameter] in one step: beyond, the run has blown up
constexpr double kMostOverlap = 0.5;  // [R_i + R_j]

}  // namespace

template class NeighbourLists<SpherePairs>;

void SphereEngine::choose_kernels() {
  using spheres::Flow;
  using spheres::Tally;
  const bool rolls = law_.rolling_friction > 0;
  rotates_ = law_.friction > 0 || rolls || (law_.wall_friction > 0 && !walls_.empty());
  force_kernel_ = spheres::select_kernel(law_, free_cell_ ? Tally::stress : Tally::nothing, isa_, unlike_,
                                         shears_ ? Flow::shear : Flow::stretch);
  motion_kernel_ = select_motion({rotates_, free_cell_, rolls, shears_}, isa_);
}

void SphereEngine::start_half_steps() {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const SphereConstants& c = bodies_.constants[k];
    const Vec3 v = triple_at(bodies_.row(k) + spheres::Slot::velocity);
    bodies_.set_half_velocity(k, bodies_.half_velocity(k) - 0.5 * dt_ * c.inverse_mass * bodies_.force(k));
    bodies_.set_half_spin(k, bodies_.half_spin(k) - 0.5 * dt_ * c.inverse_inertia * bodies_.torque(k));
    for (std::size_t a = 0; a < 3; ++a) motion_tally_.kinetic[a] += c.mass * v.c[a] * v.c[a];
    motion_tally_.shear_kinetic += c.mass * v[0] * v[1];
  }
}

Advance SphereEngine::advance(const MotionStep<3>& step, double) {
  const SphereMotionKernel kernel = next_motion_kernel_ ? next_motion_kernel_ : motion_kernel_;
  next_motion_kernel_ = nullptr;
  const SphereArrays arrays = arrays_of(bodies_);
  over_chunks(team_, lists_, motion_tallies_, [&](std::size_t begin, std::size_t end) {
    return kernel(arrays, begin, end, step, prediction_, gravity_);
  });
  motion_tally_ = {};
  for (const SphereMotionTally& t : motion_tallies_) {
    motion_tally_.largest_speed_squared = std::max(motion_tally_.largest_speed_squared, t.largest_speed_squared);
    for (std::size_t a = 0; a < 3; ++a) motion_tally_.kinetic[a] += t.kinetic[a];
    motion_tally_.shear_kinetic += t.shear_kinetic;
  }
  if (step.turns != 0) lists_.turn(step.turns);
  double speed = std::sqrt(motion_tally_.largest_speed_squared), affine = 0;
  for (SphereWall& w : walls_) {
    move_wall(w, dt_);
    speed = std::max(speed, norm(w.velocity));
  }
  for (const double scale : step.scale) affine = std::max(affine, std::abs(scale - 1));
  affine += std::abs(step.shear);
  const double move = dt_ * speed;
  // Listed neighbours are nearer than two diameters and the range; the first factor covers the rescaling of the
  // peculiar move, and the rounding of travels summed over many steps.
  return {(1.01 + affine) * (2 * move + affine * (2 * largest_diameter_ + law_.attraction_range)),
          !(move <= kMostMove * smallest_diameter_)};
}

void SphereEngine::update_lists(const Cell& cell, double displacement) {
  lists_.update(bodies_, cell, displacement);
  if (lists_.inner_rebuilds() != rebuilds_seen_) lists_are_new();
}

void SphereEngine::lists_are_new() {
  rebuilds_seen_ = lists_.inner_rebuilds();
  prediction_ = velocity_prediction(law_, law_.damping > 0 ? stiffest_contact() : 0, dt_);
  if (!walls_.empty()) find_near_walls();
}

// As the inner list found them: a restart finds the same.
double SphereEngine::stiffest_contact() const {
  double stiffest = 0;
  const std::vector<Vec3>& position = lists_.inner_position();
  lists_.for_each([&](std::size_t, std::int32_t i, std::int32_t j, std::uint8_t shift) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    Vec3 r = position[b] - position[a];
    if (lists_.inner_cell()) r += lists_.inner_cell()->offset(image_shift<3>(shift));
    const double gap = facing(r, bodies_.body(a), bodies_.body(b)).gap;
    if (!(gap < 0)) return;
    const double lighter = std::max(bodies_.constants[a].inverse_mass, bodies_.constants[b].inverse_mass);
    const ContactStiffness c = pair_stiffness(law_, bodies_.body(a), bodies_.body(b));
    stiffest = std::max(stiffest, lighter * normal_stiffness(law_, c, gap));
  });
  return stiffest;
}

void SphereEngine::compute_forces(const Cell& cell, const CellFlow<3>& flow, double time_step) {
  cell_ = cell, flow_ = flow;
  spheres::PairForceInput in;
  in.rows = bodies_.rows.data(), in.spins = bodies_.spins.data();
  in.loads = bodies_.loads.data(), in.moments = bodies_.moments.data();
  in.pairs = lists_.columns().arrays(lists_.i(), lists_.j(), lists_.shift());
  in.law = law_;
  const ContactStiffness unit = pair_stiffness(law_, 1, 1);
  in.tangential_ratio = unit.tangential / unit.normal;
  in.time_step = time_step;
  in.flow_half = flow.half, in.flow_now = flow.now;
  in.shear_half = flow.shear_half, in.shear_now = flow.shear_now;
  for (std::uint8_t code = 0; code < kImages<3> && cell; ++code) {
    const Vec3 offset = cell->offset(image_shift<3>(code));
    for (std::size_t a = 0; a < 3; ++a) in.offset[a][code] = offset.c[a];
  }
  force_tally_ = over_groups(team_, lists_, force_tallies_, [&](const PairGroup& group) {
    spheres::PairForceTally tally;
    spheres::PairForceInput part = in;
    part.begin = group.begin, part.end = group.images, part.images = false;
    if (part.begin < part.end) tally += force_kernel_(part);
    part.begin = group.images, part.end = group.end, part.images = true;
    if (part.begin < part.end) tally += force_kernel_(part);
    return tally;
  });
  if (!walls_.empty()) add_wall_loads(time_step);
}

// Chunks of bodies side by side: a load belongs to one body.
void SphereEngine::add_wall_loads(double time_step) {
  using spheres::LoadSlot;
  using spheres::Slot;
  const WallLaw wall_law(law_);
  team_.run(lists_.chunks(), [&](int chunk) {
    const auto c = static_cast<std::size_t>(chunk);
    for (std::size_t n = near_begin_[c]; n < near_begin_[c + 1]; ++n) {
      NearWall& near = bodies_.near_walls[n];
      const auto k = static_cast<std::size_t>(near.body);
      const double* row = bodies_.row(k);
      const WallMotion motion{triple_at(row + Slot::half_velocity), triple_at(row + Slot::half_surface),
                              triple_at(row + Slot::velocity), triple_at(row + Slot::surface)};
      const WallLoad add =
          wall_load(wall_law, walls_[static_cast<std::size_t>(near.wall)], bodies_.body(k), bodies_.constants[k].mass,
                    bodies_.position(k), motion, time_step, near.tangential_force);
      if (!add.touches) continue;
      double* load = bodies_.load(k);
      put_triple(load + LoadSlot::force, bodies_.force(k) + add.force);
      put_triple(load + LoadSlot::moment_per_radius,
                 triple_at(load + LoadSlot::moment_per_radius) + add.moment_per_radius);
    }
  });
}

StressSums<3> SphereEngine::sums() const {
  return {motion_tally_.kinetic, force_tally_.virial, motion_tally_.shear_kinetic, force_tally_.shear_virial};
}

void SphereEngine::set_law(const SphereLaw& law, Springs springs) {
  if (law.attraction > 0 && law.attraction_range > (law_.attraction > 0 ? law_.attraction_range : 0.0))
    throw std::logic_error("SphereEngine::set_law: the attraction reaches beyond the lists");
  SpherePairs& pairs = lists_.columns();
  if (springs == Springs::keep_elongations) {
    const auto growth = [](double now, double before) { return before > 0 ? now / before : 1.0; };
    pairs.scale_springs(growth(pair_stiffness(law, 1, 1).tangential, pair_stiffness(law_, 1, 1).tangential),
                        growth(law.rolling_stiffness, law_.rolling_stiffness));
    const double at_walls = growth(wall_stiffness(law, 1).tangential, wall_stiffness(law_, 1).tangential);
    for (NearWall& w : bodies_.near_walls) w.tangential_force = at_walls * w.tangential_force;
  }
  law_ = law;
  pairs.set_law(law);
  lists_.for_each([&](std::size_t k, std::int32_t i, std::int32_t j, std::uint8_t) {
    pairs.fill(k, bodies_, static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  });
  choose_kernels();
  lists_are_new();
}

Vec3 SphereEngine::branch(std::int32_t i, std::int32_t j, std::uint8_t shift, const Cell& cell) const {
  const Vec3 far = bodies_.position(static_cast<std::size_t>(j)), near = bodies_.position(static_cast<std::size_t>(i));
  return cell ? far + cell->offset(image_shift<3>(shift)) - near : far - near;
}

void SphereEngine::check_bodies(std::int64_t step) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Vec3 r = bodies_.position(k), u = bodies_.half_velocity(k), w = bodies_.half_spin(k);
    const double move = dt_ * norm(u);
    if (!std::isfinite(norm(r) + norm(u) + norm(w)))
      throw RunError(step, bodies_.id[k], "its position or velocity is not a number", "lower step.fraction");
    if (!(move <= kMostMove * smallest_diameter_))
      throw RunError(step, bodies_.id[k], "it moves " + std::to_string(move) + " a in one step",
                     "lower step.fraction or stage.velocity");
  }
}

void SphereEngine::check_overlaps(const Cell& cell, std::int64_t step) const {
  lists_.for_each([&](std::size_t, std::int32_t i, std::int32_t j, std::uint8_t shift) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const double sum = bodies_.signed_radius(a) + bodies_.signed_radius(b), distance = norm(branch(i, j, shift, cell));
    if (distance < (1 - kMostOverlap) * sum)
      throw RunError(
          step, bodies_.id[a],
          "it overlaps grain " + std::to_string(bodies_.id[b]) + " by " + std::to_string(sum - distance) + " a",
          "raise law.modulus or law.normal_stiffness, or lower stage.pressure");
  });
}

}  // namespace isostat
