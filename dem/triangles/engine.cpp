#include "dem/triangles/engine.hpp"

#include <algorithm>
#include <cmath>

#include "dem/run_error.hpp"
#include "dem/triangles/kernel/rows.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Store = GrainStore;

constexpr double kMostMove = 0.3;             // [smallest circle of a triangle] in one step: beyond, it has blown up
constexpr double kMostOverlap = 0.5;          // [area of the smaller triangle] beyond, grains pass through each other
constexpr std::size_t kBlocksPerChunk = 512;  // 4096 grains, as the lists

// Of a packing that no solver has touched they are those of its overlaps.
std::vector<PairMemory<GrainHistory>> springs_of(const State<TriangleGrains>& state) {
  std::vector<PairMemory<GrainHistory>> springs = state.memory.pairs;
  if (!springs.empty() || !state.memory.half_velocity.empty()) return springs;
  for (const Overlap& o : state.packing.overlaps)
    if (o.tangential_force != 0) springs.push_back({o.grain_i, o.grain_j, o.shift, {o.tangential_force}});
  return springs;
}

}  // namespace

TriangleEngine::TriangleEngine(const State<TriangleGrains>& state, const CellControl<2>& control,
                               const SolverOptions& options)
    : law_(state.law),
      overlap_needs_{law_.contact, law_.friction > 0 && law_.contact == ContactLaw::overlap_energy, control.moves()},
      integrator_(state.scene.step.integrator),
      dt_(state.time_step),
      time_(state.time),
      gravity_(state.scene.gravity),
      motion_(container_motion_of(state)),
      surroundings_(state.surroundings),
      stage_start_(state.progress.start_time),
      ledger_(state.ledger),
      begins_(state.memory.half_velocity.empty()),
      energies_(options.energies),
      kinetic_(control.moves()),
      kernels_(triangle_kernels(overlap_needs_, {law_.damping > 0, control.moves()}, kinetic_, options.isa)),
      team_(options.threads) {
  load(state);
  // A stage begins: from here on the container moves in another way than it did.
  if (energies_ && !begins_ && time_ == stage_start_) ledger_.wall_work_due = 0.5 * dt_ * wall_power();
}

void TriangleEngine::load(const State<TriangleGrains>& state) {
  const TrianglePacking& p = state.packing;
  store_.load(p, law_, state.memory);
  cell_ = p.cell;
  events_ = p.events;
  smallest_reach_ = INFINITY;
  for (const double r : p.bodies.radius) smallest_reach_ = std::min(smallest_reach_, r);
  cut_chunks();
  kernels_.corners(0, store_.slots(), store_.arrays());
  store_.measure_circles();
  // Of a restart the circles are those that its lists were made with.
  if (state.memory.lists.inner_position.empty()) store_.grow_circles();
  lists_.emplace(store_.size(), 0.0, GrainPairs{});
  if (state.memory.lists.inner_position.empty())
    build_lists(p.cell, springs_of(state));
  else
    restore_lists(state);
}

void TriangleEngine::cut_chunks() {
  const std::vector<GrainBlock>& blocks = store_.blocks();
  const std::size_t count = std::max<std::size_t>(1, blocks.size() / kBlocksPerChunk);
  chunks_.clear();
  const auto slot_of = [&](std::size_t block) {
    return block < blocks.size() ? std::size_t{blocks[block].begin} : store_.slots();
  };
  for (std::size_t c = 0; c < count; ++c) {
    const std::size_t begin = blocks.size() * c / count, end = blocks.size() * (c + 1) / count;
    const std::size_t free = store_.free_slots();
    chunks_.push_back({begin, end, std::min(slot_of(begin), free), std::min(slot_of(end), free)});
  }
}

// ---- motion ---------------------------------------------------------------------------------------------------------

void TriangleEngine::start_half_steps() {
  if (integrator_ == Integrator::gear) {  // velocities are at the full step
    if (energies_) set_work_due();
    return;
  }
  for (std::size_t s = 0; s < store_.free_slots(); ++s) {
    const double h = 0.5 * dt_, im = store_[Store::inverse_mass][s];
    store_[Store::ux][s] -= h * store_[Store::fx][s] * im;
    store_[Store::uy][s] -= h * (store_[Store::fy][s] * im - gravity_ * store_[Store::heavy][s]);
    store_[Store::uw][s] -= h * store_[Store::torque][s] * store_[Store::inverse_inertia][s];
  }
  drift_tally_ = {};
  for (std::size_t s = 0; s < store_.free_slots(); ++s) {
    const double m = store_[Store::mass][s], vx = store_[Store::px][s], vy = store_[Store::py][s];
    drift_tally_.kinetic[0] += m * vx * vx, drift_tally_.kinetic[1] += m * vy * vy;
  }
  if (energies_) set_work_due();
}

Advance TriangleEngine::advance(const MotionStep<2>& step, double drag) {
  drag_ = drag;
  if (energies_) integrator_ == Integrator::gear ? add_gear_drag() : brake_ledger(step);
  double move = integrator_ == Integrator::gear ? predict() : drift(step);
  time_ = step.time;
  move_container();
  move = std::max(move, container_move_);
  const double affine = std::max(std::abs(step.scale[0] - 1), std::abs(step.scale[1] - 1));
  const double range = affine > 0 ? lists_->inner_skin() + 4 * store_.largest_radius() : 0;
  const double displacement = (1.01 + affine) * (2 * move + affine * range);  // two neighbours, each by its move
  return {displacement, !(move <= kMostMove * smallest_reach_)};
}

double TriangleEngine::drift(const MotionStep<2>& step) {
  drift_tallies_.resize(chunks_.size());
  DriftInput in;
  in.arrays = store_.arrays();
  in.time_step = dt_, in.weight = gravity_;
  for (int a = 0; a < 2; ++a)
    in.scale[a] = step.scale[a], in.drift[a] = dt_ * step.half_scale[a], in.keep[a] = step.keep[a];
  in.keep_spin = step.keep_spin;
  team_.run(static_cast<int>(chunks_.size()), [&](int c) {
    DriftInput part = in;
    part.begin = chunks_[idx(c)].slot_begin, part.end = chunks_[idx(c)].slot_end;
    drift_tallies_[idx(c)] = kernels_.drift(part);
  });
  drift_tally_ = {};
  for (const DriftTally& t : drift_tallies_) {
    const auto larger = [](double a, double b) { return a > b ? a : b; };
    drift_tally_.speed_squared = larger(t.speed_squared, drift_tally_.speed_squared);
    drift_tally_.surface_speed = larger(t.surface_speed, drift_tally_.surface_speed);
    if (std::isnan(t.speed_squared + t.surface_speed)) drift_tally_.speed_squared = t.speed_squared + t.surface_speed;
    for (int a = 0; a < 2; ++a) drift_tally_.kinetic[a] += t.kinetic[a];
  }
  return dt_ * (std::sqrt(drift_tally_.speed_squared) + drift_tally_.surface_speed);
}

// Driven grains stand where the container does.
void TriangleEngine::move_container() {
  container_move_ = 0;
  if (store_.free_slots() == store_.slots() || !moves(motion_)) return;
  const ContainerPlacement at = container_at(motion_, surroundings_, time_ - stage_start_);
  ContainerPlacement start;  // of the stage
  start.offset = surroundings_.start_offset, start.angle = surroundings_.start_angle;
  auto& s = store_;
  double largest = 0;
  for (std::size_t k = s.free_slots(); k < s.slots(); ++k) {
    const Vec2 built = built_at(start, {{s[Store::wall_x][k], s[Store::wall_y][k]}}), r = point_at(at, built);
    const Vec2 v = velocity_at(at, r);
    s[Store::x][k] = r[0], s[Store::y][k] = r[1];
    s[Store::angle][k] = s[Store::wall_angle][k] + (at.angle - start.angle);
    s[Store::px][k] = s[Store::ux][k] = v[0], s[Store::py][k] = s[Store::uy][k] = v[1];
    s[Store::pw][k] = s[Store::uw][k] = at.spin;
    largest = std::max(largest, norm(v) + s[Store::reach][k] * std::abs(at.spin));
  }
  container_move_ = 1.5 * dt_ * largest;  // the velocity may have been larger within the step
  kernels_.corners(s.free_slots(), s.slots(), s.arrays());
}

// ---- forces ---------------------------------------------------------------------------------------------------------

void TriangleEngine::compute_forces(const Cell& cell, const CellFlow<2>& flow, double time_step) {
  cell_ = cell, flow_ = flow;
  if (kinetic_) candidates_.set_offsets(cell);
  const GrainArrays arrays = store_.arrays();
  OverlapInput in;
  candidates_.show(in);
  in.rows = arrays.rows, in.loads = arrays.loads;
  in.px = arrays.px, in.py = arrays.py, in.pw = arrays.pw, in.x = arrays.x, in.y = arrays.y;
  in.modulus = law_.modulus, in.friction = law_.friction, in.spring_stiffness = law_.tangential_stiffness;
  in.time_step = time_step;
  const std::size_t work = std::max(kOverlapWork * candidates_.most_rows(), store_.most_work()) + 8;
  overlap_tally_ = {};
  for (int p = 0; p < Candidates::kPhases; ++p) {
    const std::vector<Candidates::Group>& groups = candidates_.phase(p);
    overlap_tallies_.assign(groups.size(), {});
    if (work_.size() < groups.size()) work_.resize(groups.size());
    team_.run(static_cast<int>(groups.size()), [&](int g) {
      AlignedVector<double>& scratch = work_[idx(g)];
      if (scratch.size() < work) scratch.resize(work);
      OverlapInput part = in;
      part.begin = groups[idx(g)].begin, part.end = groups[idx(g)].end, part.work = scratch.data();
      overlap_tallies_[idx(g)] = kernels_.overlap(part);
    });
    for (const OverlapTally& t : overlap_tallies_) overlap_tally_ += t;
  }
  BeamInput beams;
  beams.blocks = store_.blocks().data(), beams.arrays = arrays;
  beams.half_step = integrator_ == Integrator::gear ? 0 : 0.5 * time_step;
  beams.flow[0] = flow.now[0], beams.flow[1] = flow.now[1];
  beam_tallies_.assign(chunks_.size(), {});
  if (work_.size() < chunks_.size()) work_.resize(chunks_.size());
  team_.run(static_cast<int>(chunks_.size()), [&](int c) {
    AlignedVector<double>& scratch = work_[idx(c)];
    if (scratch.size() < work) scratch.resize(work);
    BeamInput part = beams;
    part.begin = chunks_[idx(c)].block_begin, part.end = chunks_[idx(c)].block_end, part.work = scratch.data();
    beam_tallies_[idx(c)] = kernels_.beams(part);
  });
  beam_tally_ = {};
  for (const BeamTally& t : beam_tallies_) beam_tally_ += t;
}

StressSums<2> TriangleEngine::sums() const {
  StressSums<2> sums;
  for (int a = 0; a < 2; ++a) {
    sums.kinetic[a] = drift_tally_.kinetic[a];
    sums.virial[a] = overlap_tally_.virial[a] + beam_tally_.virial[a];
  }
  return sums;
}

void TriangleEngine::keep_books() {
  if (energies_) add_works();
  if (law_.failure == BeamFailure::none) return;
  if (strain_beams()) split_grains();
}

// ---- sanity ---------------------------------------------------------------------------------------------------------

std::size_t TriangleEngine::triangles() const {
  std::size_t n = 0;
  for (std::size_t g = 0; g < store_.grains(); ++g) n += store_.triangles(g);
  return n;
}

void TriangleEngine::check_bodies(std::int64_t step) const {
  for (std::size_t g = 0; g < store_.grains(); ++g)
    for (std::size_t t = 0; t < store_.triangles(g); ++t) {
      const std::size_t s = store_.slot(g, t);
      const double vx = store_[Store::ux][s], vy = store_[Store::uy][s], w = store_[Store::uw][s];
      const double move = dt_ * (std::hypot(vx, vy) + store_[Store::reach][s] * std::abs(w));
      if (!std::isfinite(store_[Store::x][s] + store_[Store::y][s] + store_[Store::angle][s] + vx + vy + w))
        throw RunError(step, store_.body_id[s], "its position or velocity is not a number", "lower step.fraction");
      if (!(move <= kMostMove * smallest_reach_))
        throw RunError(step, store_.body_id[s], "it moves " + std::to_string(move) + " cm in one step",
                       "lower step.fraction");
    }
}

void TriangleEngine::check_overlaps(const Cell&, std::int64_t step) const {
  const auto triangle = [this](std::uint32_t slot, const Vec2& offset) {
    const double* row = store_.rows.data() + kernel::kCornerRow * std::size_t{slot};
    kernel::TriangleLanes<kernel::Scalar> t;
    for (int c = 0; c < 3; ++c) t.x[c] = row[2 * c] + offset[0], t.y[c] = row[2 * c + 1] + offset[1];
    return t;
  };
  const auto area = [](const kernel::TriangleLanes<kernel::Scalar>& t) {
    return 0.5 * ((t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) - (t.x[2] - t.x[0]) * (t.y[1] - t.y[0]))[0];
  };
  candidates_.for_each([&](std::size_t i, std::size_t j, std::uint32_t a, std::uint32_t b, const Vec2& offset) {
    const auto near = triangle(a, {}), far = triangle(b, offset);
    const double overlap = kernel::overlap_lanes(near, far).area[0];
    if (overlap > kMostOverlap * std::min(area(near), area(far)))
      throw RunError(step, store_.id[i],
                     "a triangle of it overlaps one of grain " + std::to_string(store_.id[j]) + " by " +
                         std::to_string(overlap) + " cm^2, more than half of it",
                     "raise law.modulus, or lower stage.pressure or gravity");
  });
}

}  // namespace isostat
