#include "dem/spheres/sample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "dem/input_error.hpp"
#include "dem/sample/grain_sizes.hpp"
#include "dem/sample/grains_file.hpp"
#include "dem/sample/push_apart.hpp"
#include "dem/sample/random_placement.hpp"
#include "dem/scene/check.hpp"
#include "dem/scene/text.hpp"
#include "dem/solver/random.hpp"
#include "dem/spheres/time_step.hpp"
#include "dem/state/lower_tilt.hpp"
#include "dem/state/touching.hpp"

namespace isostat {
namespace {

constexpr std::uint64_t kMaterialStream = std::uint64_t{1} << 48;
constexpr int kMostTries = 20000;            // per sphere
constexpr double kDensestAtRandom = 0.36;    // [-] solid fraction that random sequential placement reaches
constexpr double kBeforePushing = 0.3;       // [-] at which the spheres of a dense start are placed
constexpr double kMostOverlapAtStart = 0.3;  // [R_i + R_j] beyond, Hertz's law says nothing

State<Spheres> without_bodies(const Scene& scene, std::uint64_t seed) {
  State<Spheres> state;
  state.scene = scene;
  state.seed = seed;
  state.law = resolve(scene.sphere_grains, scene.sphere_law);
  return state;
}

double smallest_radius(const Bodies<3>& b) { return *std::min_element(b.radius.begin(), b.radius.end()); }

SphereDensities densities_of(const SphereGrainsScene& g) {
  return {g.density, g.second_density.value_or(g.density), g.soft_density.value_or(0.7 * g.density)};
}

// [T0] the same for grains lighter than their material.
double contact_time_of_light(const State<Spheres>& s) {
  const SpherePacking& p = s.packing;
  const SphereDensities densities = densities_of(s.scene.sphere_grains);
  SphereLaw law = resolve(s.scene.sphere_grains, s.scene.sphere_law);
  double time = INFINITY;
  for (std::size_t k = 0; k < p.bodies.size(); ++k) {
    const SphereKind kind = p.kind.empty() ? SphereKind::grain : p.kind[k];
    if (kind == SphereKind::soft) continue;
    const double r = p.bodies.radius[k], density = p.bodies.mass[k] / (4.0 / 3.0 * std::numbers::pi * (r * r * r));
    const bool second = kind == SphereKind::second;
    if (!(density < (1 - 1e-9) * (second ? densities.second : densities.grain))) continue;
    SphereLaw of_kind = law;
    if (second) of_kind.grain = law.second;
    time = std::min(time, contact_time(of_kind, r, density));
  }
  return time;
}

void set_time_step(State<Spheres>& s) {
  const double smallest = smallest_radius(s.packing.bodies);
  s.time_step =
      step_fraction(s.scene, smallest) * std::min(shortest_contact_time(s.scene, smallest), contact_time_of_light(s));
  if (s.packing.cell) s.cell_motion.reference_length = s.packing.cell->length;
}

// Which grains are of the second material: draws of a stream of their own.
void draw_materials(State<Spheres>& s) {
  const double share = s.scene.sphere_grains.second_share;
  if (!(share > 0)) return;
  SpherePacking& p = s.packing;
  p.kind.resize(p.bodies.size(), SphereKind::grain);
  Random random(s.seed + kMaterialStream);
  for (SphereKind& kind : p.kind)
    if (random.uniform() < share && kind == SphereKind::grain) kind = SphereKind::second;
}

// What follows from radii and kinds; ratios: of densities over that of a grain's material, of the first grains.
void complete(State<Spheres>& s, const std::vector<double>& ratios = {}) {
  draw_materials(s);
  set_sphere_inertia(s.packing, densities_of(s.scene.sphere_grains));
  Bodies<3>& b = s.packing.bodies;
  for (std::size_t k = 0; k < ratios.size(); ++k) b.mass[k] *= ratios[k], b.inertia[k] *= ratios[k];
  set_time_step(s);
}

// What a scene asks of the cell, of a file that has none.
void refuse_without_cell(const Scene& scene, const std::string& path) {
  std::vector<Fault> faults;
  for (std::size_t k = 0; k < scene.stages.size(); ++k)
    for (const std::string& key : cell_keys(scene.stages[k], k))
      faults.push_back({"scene", 0, key, "",
                        "needs a periodic cell; the packing of " + path + " is isolated (grains.box gives it one)"});
  if (!faults.empty()) throw InputError(std::move(faults));
}

// Masses of a file count where grains of one kind differ in density.
void weigh(SpherePacking& p, const SphereDensities& densities, bool ratios_given) {
  Bodies<3>& b = p.bodies;
  const auto are = [&](SphereKind kind) {
    return densities_differ(b, [&](std::size_t k) { return (p.kind.empty() ? SphereKind::grain : p.kind[k]) == kind; });
  };
  if (!ratios_given && !are(SphereKind::grain) && !are(SphereKind::second) && !are(SphereKind::soft))
    return set_sphere_inertia(p, densities);
  if (!ratios_given) return;
  const double unit = densities.grain / (6 / std::numbers::pi);  // of a density in a column
  for (std::size_t k = 0; k < b.size(); ++k) b.mass[k] *= unit, b.inertia[k] *= unit;
}

// grains.file: bodies, cell and springs of a packing under the scene's law, at time 0.
State<Spheres> state_from_file(const Scene& scene, std::uint64_t seed) {
  const std::string& path = scene.sphere_grains.file;
  PackingFile file = read_grains_file(path, scene.sphere_grains.box);
  if (!file.packing_3d) throw InputError(path, 0, "grains.file", path, "a packing of spheres, in space, is wanted");
  State<Spheres> state = without_bodies(scene, seed);
  static_cast<Packing<3>&>(state.packing) = std::move(*file.packing_3d);
  state.packing.kind = std::move(file.packing_3d->kind);
  if (state.packing.kind.empty()) state.law = without_unlike(state.law);
  Packing<3>& packing = state.packing;
  if (packing.bodies.size() == 0) throw InputError(path, 0, "grains.file", path, "it holds no grain");
  if (!packing.cell) refuse_without_cell(scene, path);
  lower_tilt(packing);
  if (!file.links_given) packing.links.clear();
  weigh(state.packing, densities_of(scene.sphere_grains), file.densities_given);
  const Bodies<3>& b = packing.bodies;
  for (const Link<3>& l : touching_links(packing, 0.0)) {
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    if (l.gap < -kMostOverlapAtStart * (b.radius[i] + b.radius[j]))
      throw InputError(path, 0, "grains.file", path,
                       "grains " + std::to_string(b.id[i]) + " and " + std::to_string(b.id[j]) + " overlap by " +
                           std::to_string(-l.gap) + " a; at most 0.3 of the sum of radii is allowed");
  }
  set_time_step(state);
  return state;
}

InsertedGrains<3> inserted(const InsertionScene& insertion, std::uint64_t seed) {
  InsertedGrains<3> grains = insert_grains<3>(insertion, seed);
  if (!grains.reached)
    throw InputError("scene", 0, "grains.inserted_fraction", real_text(*insertion.solid_fraction),
                     "a million trials a grain reach only " + real_text(grains.solid_fraction) +
                         ": raise grains.volume_factor, or lower grains.diameter_min");
  return grains;
}

State<Spheres> inserted_spheres(const Scene& scene, std::uint64_t seed) {
  const SphereGrainsScene& g = scene.sphere_grains;
  State<Spheres> state = without_bodies(scene, seed);
  SpherePacking& p = state.packing;
  const InsertionScene insertion = insertion_of(g);
  switch (g.arrangement) {
    case SphereArrangement::random:
      throw std::logic_error("inserted_spheres: grains.arrangement");
    case SphereArrangement::insertion:
      p.cell = PeriodicCell<3>{{{g.edge, g.edge, g.edge}}};
      add_grains(p, inserted(insertion, seed), {}, 0);
      p.group.clear();
      break;
    case SphereArrangement::soft_wall:
      add_soft_particle(p, inserted(insertion, seed), {}, kFirstSoft);
      p.walls.push_back(soft_partner_wall(g.shell_radius));
      break;
    case SphereArrangement::soft_pair:
      add_soft_particle(p, inserted(insertion, seed), {}, kFirstSoft);
      add_soft_particle(p, inserted(insertion, seed + kSecondStream), (2 * g.shell_radius) * kSoftApproach,
                        kSecondSoft);
      break;
  }
  complete(state);
  return state;
}

}  // namespace

InsertionScene insertion_of(const SphereGrainsScene& g) {
  InsertionScene i;
  i.room = g.arrangement == SphereArrangement::insertion ? InsertionRoom::box : InsertionRoom::shell;
  i.shell_radius = g.shell_radius;
  i.box = {g.edge, g.edge, g.edge};
  i.radius_min = g.diameter_min / 2, i.radius_max = g.diameter_max / 2;
  i.exponent = g.exponent.value_or(0) + (g.share_of == ShareOf::volume ? 3 : 0);
  i.volume_factor = g.volume_factor, i.trials = g.trials;
  i.solid_fraction = g.inserted_fraction;
  i.soft_share = g.soft_share, i.soft_radius = g.soft_radius;
  return i;
}

void add_grains(SpherePacking& p, const InsertedGrains<3>& grains, const Vec3& at, std::int32_t group) {
  Bodies<3>& b = p.bodies;
  const std::size_t before = b.size();
  b.resize(before + grains.radius.size());
  p.group.resize(b.size(), group);
  if (!grains.soft.empty() || !p.kind.empty()) p.kind.resize(b.size(), SphereKind::grain);
  for (std::size_t k = before; k < b.size(); ++k) {
    b.id[k] = static_cast<std::int64_t>(k);
    b.position[k] = at + grains.position[k - before];
    b.radius[k] = grains.radius[k - before];
    if (!grains.soft.empty() && grains.soft[k - before] == 1) p.kind[k] = SphereKind::soft;
  }
}

void add_soft_particle(SpherePacking& p, const InsertedGrains<3>& grains, const Vec3& centre, std::int32_t group) {
  add_grains(p, grains, centre, group);
  SphereWall shell;
  shell.shape = WallShape::shell, shell.point = centre, shell.radius = grains.enclosure.shell_radius;
  shell.group = group;
  p.walls.push_back(shell);
}

SphereWall soft_partner_wall(double shell_radius) {
  SphereWall wall;
  wall.point = shell_radius * kSoftApproach, wall.normal = -1.0 * kSoftApproach;
  return wall;
}

void set_sphere_inertia(Bodies<3>& b, double density) {
  for (std::size_t k = 0; k < b.size(); ++k) {
    const double r = b.radius[k];
    b.mass[k] = density * (4.0 / 3.0 * std::numbers::pi * (r * r * r));
    b.inertia[k] = 0.4 * (b.mass[k] * (r * r));
  }
}

void set_sphere_inertia(SpherePacking& p, const SphereDensities& densities) {
  set_sphere_inertia(p.bodies, densities.grain);
  for (std::size_t k = 0; k < p.kind.size(); ++k) {
    if (p.kind[k] == SphereKind::grain) continue;
    const double ratio = (p.kind[k] == SphereKind::second ? densities.second : densities.soft) / densities.grain;
    p.bodies.mass[k] *= ratio, p.bodies.inertia[k] *= ratio;
  }
}

State<Spheres> initial_spheres(const Scene& scene, std::uint64_t seed) {
  const SphereGrainsScene& g = scene.sphere_grains;
  if (!g.file.empty()) return state_from_file(scene, seed);
  if (g.arrangement != SphereArrangement::random) return inserted_spheres(scene, seed);
  State<Spheres> state = without_bodies(scene, seed);
  Random random(seed);
  DrawnSizes drawn = GrainSizes(g, 3).draw(static_cast<std::size_t>(g.count), random);
  std::vector<double>& diameters = drawn.diameter;
  double volume = 0;
  for (const double d : diameters) volume += std::numbers::pi / 6 * (d * d * d);
  if (g.soft_share > 0) {
    const double one = 4 * std::numbers::pi / 3 * (g.soft_radius * g.soft_radius * g.soft_radius);
    const double softs = std::ceil(g.soft_share / (1 - g.soft_share) * volume / one);
    state.packing.kind.assign(diameters.size(), SphereKind::grain);
    diameters.resize(diameters.size() + static_cast<std::size_t>(softs), 2 * g.soft_radius);
    state.packing.kind.resize(diameters.size(), SphereKind::soft);
    volume += softs * one;
  }
  const std::size_t n = diameters.size();
  const double edge = std::cbrt(volume / g.solid_fraction);
  state.packing.cell = PeriodicCell<3>{{{edge, edge, edge}}};

  Bodies<3>& b = state.packing.bodies;
  b.resize(n);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t p, std::size_t q) { return diameters[p] > diameters[q]; });
  const Frame<3> frame{{}, state.packing.cell->length, true};
  const bool dense = g.solid_fraction > kDensestAtRandom;
  const double part = dense ? std::cbrt(kBeforePushing / g.solid_fraction) : 1.0;
  const double gap = state.law.attraction_range;
  Placement<3> placement(frame, diameters[order[0]], gap, n);
  for (const std::size_t k : order) {
    b.id[k] = static_cast<std::int64_t>(k);
    b.radius[k] = part * diameters[k] / 2;
    int tries = 0;
    Vec3 r;
    do {
      if (++tries > kMostTries)
        throw InputError("scene", 0, "grains.solid_fraction", real_text(g.solid_fraction),
                         "random placement without overlap found no room; lower it (0.3 is safe)");
      for (int a = 0; a < 3; ++a) r[a] = random.uniform() * edge;
    } while (!placement.free(r, b.radius[k], b));
    b.position[k] = r;
    placement.add(r, k);
  }
  if (dense) {
    for (std::size_t k = 0; k < n; ++k) b.radius[k] = diameters[k] / 2;
    if (!push_apart(*state.packing.cell, gap, b))
      throw InputError("scene", 0, "grains.solid_fraction", real_text(g.solid_fraction),
                       "the spheres jam before; lower it (those of like sizes jam at about 0.64, and sooner if "
                       "law.attraction_range keeps them apart)");
  }
  complete(state, drawn.density);
  state.random_counter = random.counter();
  return state;
}

}  // namespace isostat
