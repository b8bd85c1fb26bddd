#include "dem/disks/sample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "dem/disks/container.hpp"
#include "dem/disks/density.hpp"
#include "dem/disks/scales.hpp"
#include "dem/input_error.hpp"
#include "dem/sample/grain_sizes.hpp"
#include "dem/sample/grains_file.hpp"
#include "dem/sample/hard_gas.hpp"
#include "dem/sample/push_apart.hpp"
#include "dem/sample/random_placement.hpp"
#include "dem/scene/check.hpp"
#include "dem/scene/text.hpp"
#include "dem/solver/random.hpp"
#include "dem/state/container_motion.hpp"
#include "dem/state/container_region.hpp"
#include "dem/state/lower_tilt.hpp"
#include "dem/state/smooth_walls.hpp"
#include "dem/state/touching.hpp"

namespace isostat {
namespace {

constexpr int kMostTries = 20000;      // per disk
constexpr double kBeforeGrowth = 0.4;  // [-] solid fraction at which the disks of a dense start are placed

}  // namespace

void set_disk_inertia(Bodies<2>& b, std::size_t first) {
  for (std::size_t k = first; k < b.size(); ++k) {
    const double d = 2 * b.radius[k];
    b.mass[k] = d * d;
    b.inertia[k] = b.mass[k] * d * d / 8;
  }
}

namespace {

// c of a scene that leaves it open: the reference, and less where small or light grains bring the bound near.
// Production goes up to three fifths of the bound, 0.12 at the sizes of the paper.
double step_fraction(const Scene& scene, double normal_stiffness, double heaviest, const Packing<2>& packing) {
  constexpr double kReference = 0.06, kOfBound = 0.5;
  LawScene law = scene.law;
  law.normal_stiffness = normal_stiffness;
  const double bound = critical_time_step(resolve(law), packing) / std::sqrt(heaviest / normal_stiffness);
  return std::min(kReference, kOfBound * bound);
}

}  // namespace

double time_step(const Scene& scene, double normal_stiffness, const Packing<2>& packing) {
  const std::vector<double>& mass = packing.bodies.mass;
  double heaviest = 0;
  for (std::size_t k = 0; k < mass.size(); ++k)
    if (is_free(packing.part, k)) heaviest = std::max(heaviest, mass[k]);
  for (std::size_t k = 0; k < mass.size() && !(heaviest > 0); ++k) heaviest = mass[k];  // all grains have left
  return scene.step.fraction.value_or(step_fraction(scene, normal_stiffness, heaviest, packing)) *
         std::sqrt(heaviest / normal_stiffness);
}

namespace {

constexpr double kMostOverlapAtStart = 0.1;  // [R_i + R_j] beyond, stored energy makes the first steps an explosion

State<Disks> without_bodies(const Scene& scene, std::uint64_t seed) {
  State<Disks> state;
  state.scene = scene;
  state.seed = seed;
  state.law = resolve(scene.law);
  return state;
}

// What a scene asks of the cell, of a file that has none.
void refuse_without_cell(const Scene& scene, const std::string& path) {
  std::vector<Fault> faults;
  const auto refuse = [&](const std::string& key) {
    faults.push_back({"scene", 0, key, "",
                      "needs a periodic cell; the packing of " + path + " is isolated (grains.box gives it one)"});
  };
  for (std::size_t k = 0; k < scene.stages.size(); ++k) {
    const StageScene& s = scene.stages[k];
    if (s.pressure) refuse(stage_key(k, "pressure"));
    if (s.stress_1) refuse(stage_key(k, "stress_1"));
    if (s.stress_2) refuse(stage_key(k, "stress_2"));
    if (s.driven(0)) refuse(stage_key(k, "strain_rate_1"));
    if (s.driven(1)) refuse(stage_key(k, "strain_rate_2"));
    if (s.stress_12) refuse(stage_key(k, "stress_12"));
    if (s.shear_driven()) refuse(stage_key(k, "shear_rate"));
  }
  if (!scene.output.snapshot_solid_fractions.empty()) refuse("output.snapshot_solid_fractions");
  if (!faults.empty()) throw InputError(std::move(faults));
}

// Smooth walls that are put around grains.
void refuse_walls_within(const State<Disks>& state, const std::string& path) {
  const Bodies<2>& b = state.packing.bodies;
  for (const SmoothWall& wall : smooth_walls(state.scene.container, 0))
    for (std::size_t k = 0; k < b.size(); ++k)
      if (const double gap = norm(foot_point(wall, b.position[k]).place - b.position[k]) - b.radius[k];
          gap < -kMostOverlapAtStart * b.radius[k])
        throw InputError(path, 0, "grains.file", path,
                         "a wall of the container closes on grains: grain " + std::to_string(b.id[k]) +
                             " overlaps it by " + std::to_string(-gap) +
                             " a; at most a tenth of its radius is allowed");
}

// The container of a file stays where it stands; the scene has to know which it is. A packing without one gets that of
// the scene around it.
void contain(State<Disks>& state, const State<Disks>& file, const std::string& path) {
  const bool walls = !state.packing.part.empty() || file.scene.container.shape != ContainerShape::none;
  const ContainerScene& wanted = state.scene.container;
  if (!walls && wanted.shape == ContainerShape::none) return;
  if (!walls && state.packing.cell)
    throw InputError(path, 0, "grains.file", path, "it has a periodic cell, and the scene puts a container around it");
  if (!walls) {
    add_container(state);
    return refuse_walls_within(state, path);
  }
  if (wanted != file.scene.container)
    throw InputError(path, 0, "grains.file", path, "it has a container; the scene needs the same [container]");
  const ContainerPlacement stands = container_of(file);
  state.surroundings.start_offset = stands.offset, state.surroundings.start_angle = stands.angle;
  state.surroundings.open = file.surroundings.open;
}

// With the rules for the step that need to know the grains; `origin` says what these are from.
void set_time_step(State<Disks>& state, const std::string& origin) {
  const Scene& scene = state.scene;
  const Bodies<2>& b = state.packing.bodies;
  state.time_step = time_step(scene, state.law.normal_stiffness, state.packing);
  double smallest = INFINITY;
  for (std::size_t k = 0; k < b.size(); ++k)
    if (is_free(state.packing.part, k)) smallest = std::min(smallest, 2 * b.radius[k]);
  const double critical = critical_time_step(state.law, state.packing);
  if (scene.step.fraction && !(state.time_step < critical))
    throw InputError(origin, 0, "step.fraction", real_text(*scene.step.fraction),
                     "unstable for the smallest grain of this file, diameter " + real_text(smallest) + " a; below " +
                         real_text(*scene.step.fraction * critical / state.time_step) +
                         ", or without this key as the grains bear");
  for (const SceneConflict& c : wall_motion_conflicts(scene, state.time_step, smallest))
    throw InputError("scene", 0, c.key, c.value, c.rule);
}

// grains.file: bodies, cell and spring histories of a packing under the scene's law, at time 0.
State<Disks> state_from_file(const Scene& scene, std::uint64_t seed) {
  const std::string& path = scene.grains.file;
  PackingFile file = read_grains_file(path, scene.grains.box);
  if (file.packing_3d) throw InputError(path, 0, "grains.file", path, "a packing of disks is wanted; this one is 3D");
  if (file.triangles)
    throw InputError(path, 0, "grains.file", path, "a packing of disks is wanted; this one is of triangles");
  Packing<2>& packing = file.state.packing;
  if (!packing.cell) refuse_without_cell(scene, path);
  if (!packing.beams.empty())
    throw InputError(path, 0, "grains.file", path, "it has beams, which no run of disks can march yet");
  if (packing.bodies.size() == 0) throw InputError(path, 0, "grains.file", path, "it holds no grain");
  State<Disks> state = without_bodies(scene, seed);
  state.packing = std::move(packing);
  const bool weighed = file.densities_given || densities_differ(state.packing.bodies, [](std::size_t) { return true; });
  lower_tilt(state.packing);
  contain(state, file.state, path);
  if (!weighed) set_disk_inertia(state.packing.bodies);
  if (!file.links_given) state.packing.links.clear();
  const Bodies<2>& b = state.packing.bodies;
  for (const Link<2>& l : touching_links(state.packing, 0.0)) {
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    const double sum = b.radius[i] + b.radius[j];
    if (l.gap < -kMostOverlapAtStart * sum)
      throw InputError(path, 0, "grains.file", path,
                       "grains " + std::to_string(b.id[i]) + " and " + std::to_string(b.id[j]) + " overlap by " +
                           std::to_string(-l.gap) + " a; at most a tenth of the sum of radii is allowed");
  }
  set_time_step(state, path);
  if (state.packing.cell) state.cell_motion.reference_length = state.packing.cell->length;
  return state;
}

// Where grains are put in: the periodic cell, or the lower part of a container.
struct Room {
  Frame<2> frame;
  const ContainerScene* container = nullptr;
  bool holds(const Vec2& r, double radius) const {
    return !container || (isostat::holds(*container, r, radius) && r[1] + radius <= frame.origin[1] + frame.length[1]);
  }
  Vec2 random_point(Random& random) const {
    Vec2 r;
    for (int a = 0; a < 2; ++a) r[a] = random.uniform() * frame.length[a] + frame.origin[a];
    return r;
  }
};

constexpr double kFlight = 0.5;  // [diameter] between two disks that are to collide

// The left disk is higher and flies along x.
State<Disks> about_to_collide(const Scene& scene, std::uint64_t seed) {
  const GrainsScene& g = scene.grains;
  State<Disks> state = without_bodies(scene, seed);
  Bodies<2>& b = state.packing.bodies;
  b.resize(2);
  b.id = {0, 1};
  b.radius.assign(2, 0.5 * g.diameter_max);
  b.position[0] = {{-(1 + kFlight) * g.diameter_max, g.offset * g.diameter_max}};
  b.velocity[0] = {{g.speed, 0}};
  set_disk_inertia(b);
  state.time_step = time_step(scene, state.law.normal_stiffness, state.packing);
  return state;
}

[[noreturn]] void refuse_density(const GrainsScene& g) {
  if (g.solid_fraction > kDensestGas)
    throw InputError("scene", 0, "grains.solid_fraction", real_text(g.solid_fraction),
                     "the disks jam before; lower it (those of like sizes jam at about 0.84, and sooner if "
                     "law.attraction_range keeps them apart)");
  throw InputError("scene", 0, "grains.solid_fraction", real_text(g.solid_fraction),
                   "no room was found for disks that keep law.attraction_range apart; lower it (0.5 is safe)");
}

constexpr double kRoomAtLeast = 8;  // [largest diameter^2] of a container: for a few grains

// area [a^2] of the room.
Room room_of(const Scene& scene, double area) {
  const ContainerScene& c = scene.container;
  if (c.shape == ContainerShape::none) {
    const double width = std::sqrt(area * scene.cell.aspect);
    return {{{}, {{width, area / width}}, true}};
  }
  const double bottom = region_bottom(c), has = area_below(c, region_top(c));
  if (area > has)
    throw InputError("scene", 0, "container", "",
                     "too small for the grains: at grains.solid_fraction = " + real_text(scene.grains.solid_fraction) +
                         " they take an area of " + real_text(area) + " a^2, it has " + real_text(has));
  const double half = half_width(c), diameter = scene.grains.diameter_max;
  const double top = height_of_area(c, std::max(area, kRoomAtLeast * diameter * diameter));
  return {{{{-half, bottom}}, {{2 * half, top - bottom}}, false}, &scene.container};
}

}  // namespace

State<Disks> initial_disks(const Scene& scene, std::uint64_t seed) {
  const GrainsScene& g = scene.grains;
  if (!g.file.empty()) return state_from_file(scene, seed);
  if (is_collision(scene)) return about_to_collide(scene, seed);
  State<Disks> state = without_bodies(scene, seed);
  Random random(seed);

  const auto n = static_cast<std::size_t>(g.count);
  const DrawnSizes drawn = GrainSizes(g, 2).draw(n, random);
  const std::vector<double>& diameters = drawn.diameter;
  double area = 0;
  for (const double d : diameters) area += std::numbers::pi / 4 * d * d;
  const Room room = room_of(scene, area / g.solid_fraction);
  if (room.frame.periodic) {
    state.packing.cell = PeriodicCell<2>{room.frame.length};
    state.cell_motion.reference_length = room.frame.length;
  }

  Bodies<2>& b = state.packing.bodies;
  b.resize(n);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t p, std::size_t q) { return diameters[p] > diameters[q]; });
  const double gap = state.law.attraction_range;
  const bool dense = g.solid_fraction > kDensestAtRandom;
  const double part = dense ? std::sqrt(kBeforeGrowth / g.solid_fraction) : 1.0;
  Placement<2> placement(room.frame, diameters[order[0]], gap, n);
  for (std::size_t k : order) {
    b.id[k] = static_cast<std::int64_t>(k);
    b.radius[k] = part * diameters[k] / 2;
    int tries = 0;
    Vec2 r;
    do {
      if (++tries > kMostTries) refuse_density(g);
      r = room.random_point(random);
    } while (!room.holds(r, b.radius[k]) || !placement.free(r, b.radius[k], b));
    b.position[k] = r;
    placement.add(r, k);
  }
  if (dense) {
    std::vector<double> radii(n);
    for (std::size_t k = 0; k < n; ++k) radii[k] = diameters[k] / 2;
    if (g.solid_fraction > kDensestGas) b.radius = radii;
    if (!(g.solid_fraction > kDensestGas ? push_apart(*state.packing.cell, gap, b)
                                         : grow_and_mix({*state.packing.cell, gap}, radii, placement, b, random)))
      refuse_density(g);
  }
  set_disk_inertia(b);
  for (std::size_t k = 0; k < drawn.density.size(); ++k)
    b.mass[k] *= drawn.density[k], b.inertia[k] *= drawn.density[k];
  if (room.container) add_container(state);
  if (scene.step.fraction && g.law() != SizeLaw::table)
    state.time_step = time_step(scene, state.law.normal_stiffness, state.packing);  // the scene was checked for it
  else
    set_time_step(state, g.law() == SizeLaw::table ? g.size_table : "scene");
  state.random_counter = random.counter();
  return state;
}

}  // namespace isostat
