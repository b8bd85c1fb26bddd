// Starting from the state of a file: what is taken over from it, and what is refused.
#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/input_error.hpp"
#include "dem/scene/check.hpp"
#include "dem/scene/text.hpp"
#include "dem/state/container_motion.hpp"
#include "dem/triangles/placement.hpp"
#include "dem/triangles/sample.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

constexpr double kClosesOn = 0.1;  // [radius of a grain] that a wall may reach into a grain at the start

void refuse(const std::string& path, const std::string& rule) { throw InputError(path, 0, "grains.file", path, rule); }

// What a scene asks of a cell or a container that the packing of the file cannot have.
void check_room(const TrianglePacking& packing, const std::string& path, const Scene& scene) {
  if (scene.container.shape != ContainerShape::none) {
    if (packing.cell)
      refuse(path, "its packing lies in a periodic cell, which no container can replace: container.shape is \"none\"");
    return;
  }
  if (packing.cell) return;
  std::vector<Fault> faults;
  for (std::size_t i = 0; i < scene.stages.size(); ++i)
    for (const std::string& key : cell_keys(scene.stages[i], i))
      faults.push_back({"scene", 0, key, "", "needs a periodic cell; the packing of " + path + " is isolated"});
  if (!faults.empty()) throw InputError(std::move(faults));
}

// The free grains of a packing in their order, their beams, and the overlaps between them.
TrianglePacking free_grains(const TrianglePacking& from, std::vector<std::int32_t>& new_grain) {
  TrianglePacking to;
  to.cell = from.cell;
  to.grains.begin.push_back(0);
  std::vector<std::int32_t> new_body(from.bodies.size(), -1);
  new_grain.assign(from.grains.size(), -1);
  for (std::size_t g = 0; g < from.grains.size(); ++g) {
    if (from.grains.part[g] != GrainPart::free) continue;
    new_grain[g] = static_cast<std::int32_t>(to.grains.size());
    for (std::size_t k = idx(from.grains.begin[g]); k < idx(from.grains.begin[g + 1]); ++k) {
      const std::size_t n = to.bodies.size();
      new_body[k] = static_cast<std::int32_t>(n);
      Bodies<2>& b = to.bodies;
      const Bodies<2>& o = from.bodies;
      b.resize(n + 1);
      b.id[n] = o.id[k], b.position[n] = o.position[k], b.velocity[n] = o.velocity[k], b.spin[n] = o.spin[k];
      b.radius[n] = o.radius[k], b.mass[n] = o.mass[k], b.inertia[n] = o.inertia[k];
      to.corner.push_back(from.corner[k]), to.angle.push_back(from.angle[k]);
    }
    to.grains.id.push_back(from.grains.id[g]), to.grains.part.push_back(GrainPart::free);
    to.grains.radius.push_back(from.grains.radius[g]);
    to.grains.begin.push_back(static_cast<std::int32_t>(to.bodies.size()));
  }
  for (Link<2> l : from.links) {
    if (new_body[idx(l.i)] < 0) continue;
    l.i = new_body[idx(l.i)], l.j = new_body[idx(l.j)];
    to.beams.push_back(from.beams[idx(l.beam)]);
    l.beam = static_cast<std::int32_t>(to.beams.size()) - 1;
    to.links.push_back(l);
  }
  for (Overlap o : from.overlaps) {
    o.grain_i = new_grain[idx(o.grain_i)], o.grain_j = new_grain[idx(o.grain_j)];
    if (o.grain_i >= 0 && o.grain_j >= 0) to.overlaps.push_back(o);
  }
  return to;
}

double depth_allowed(const GrainTemplate& grain) { return kClosesOn * std::sqrt(grain_area(grain)); }

// The container of the scene around the free grains of the file.
void build_walls(State<TriangleGrains>& state, const std::string& path) {
  TrianglePacking& p = state.packing;
  Frame<2> box = frame_of<2>(std::nullopt, p.bodies.position);
  double largest = 0;
  std::size_t widest = 0;
  const GrainMaterial material = material_of(state.scene);
  for (std::size_t g = 0; g < p.grains.size(); ++g) {
    if (p.grains.radius[g] > largest) widest = g;
    largest = std::max(largest, p.grains.radius[g]);
  }
  const GrainTemplate reference = template_of(p, widest, material);
  const std::vector<WallGrain> walls = wall_grains(state.scene.container, reference, material);
  for (int d = 0; d < 2; ++d) box.origin[d] -= largest, box.length[d] += 2 * largest;
  TriangleField field(box, std::nullopt, 2 * largest, p.grains.size());
  for (const WallGrain& w : walls)
    for (const TriangleCorners& t : placed(w.shape, w.centre, w.angle)) field.add(t);
  for (std::size_t k = 0; k < p.bodies.size(); ++k)
    if (!field.leaves_room({corners_of(p, k)}, -depth_allowed(reference)))
      refuse(path, "a wall of the container closes on grains: triangle " + std::to_string(p.bodies.id[k]) +
                       " of the file lies in it; a larger container, or that of the file");
  std::int64_t id = *std::max_element(p.grains.id.begin(), p.grains.id.end()) + 1;
  std::int64_t body_id = *std::max_element(p.bodies.id.begin(), p.bodies.id.end()) + 1;
  const std::size_t first = p.bodies.size();
  for (const WallGrain& w : walls) append_grain(p, w.shape, w.centre, w.angle, w.part, id++);
  for (std::size_t k = first; k < p.bodies.size(); ++k) p.bodies.id[k] = body_id++;
}

// Where the container of the file stands now.
Surroundings container_of(const State<TriangleGrains>& file) {
  Surroundings s;
  s.start_offset = file.surroundings.start_offset, s.start_angle = file.surroundings.start_angle;
  s.open = file.surroundings.open;
  const std::size_t stage = idx(file.progress.stage);
  if (file.progress.started && stage < file.scene.stages.size())
    bring_forward(s, file.scene.stages[stage].container, file.time - file.progress.start_time);
  return s;
}

void check_step(const State<TriangleGrains>& state, const std::string& path) {
  const Scene& scene = state.scene;
  double stable = std::numeric_limits<double>::infinity(), size = stable;
  for (const GrainTemplate& grain : smallest_grains(state.packing, material_of(scene))) {
    stable = std::min(stable, largest_step(grain, scene.triangle_law.modulus, scene.step.integrator));
    size = std::min(size, std::sqrt(grain_area(grain)));
  }
  if (!(state.time_step < stable))
    throw InputError(path, 0, "step.fraction", real_text(triangle_step_fraction(scene)),
                     "unstable for the smallest grain of this file; below " +
                         real_text(triangle_step_fraction(scene) * stable / state.time_step));
  std::vector<Fault> faults;
  for (const SceneConflict& c : wall_motion_conflicts(scene, state.time_step, size))
    faults.push_back({"scene", 0, c.key, c.value, c.rule});
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace

State<TriangleGrains> start_from(const State<TriangleGrains>& file, const std::string& path, const Scene& scene,
                                 std::uint64_t seed) {
  if (std::count(file.packing.grains.part.begin(), file.packing.grains.part.end(), GrainPart::free) == 0)
    refuse(path, "it holds no grain");
  check_room(file.packing, path, scene);
  State<TriangleGrains> state;
  state.scene = scene;
  state.seed = seed;
  state.law = resolve(scene.triangle_law);
  if (scene.container == file.scene.container) {
    state.packing = file.packing;
    state.memory.pairs = file.memory.pairs;
    state.surroundings = container_of(file);
  } else {
    std::vector<std::int32_t> new_grain;
    state.packing = free_grains(file.packing, new_grain);
    for (PairMemory<GrainHistory> pair : file.memory.pairs) {
      pair.i = new_grain[idx(pair.i)], pair.j = new_grain[idx(pair.j)];
      if (pair.i >= 0 && pair.j >= 0) state.memory.pairs.push_back(pair);
    }
    if (scene.container.shape != ContainerShape::none) build_walls(state, path);
  }
  state.packing.events.clear();
  for (Beam& beam : state.packing.beams)
    beam.stiffness = scene.triangle_law.stiffness, beam.bending = scene.triangle_law.bending;
  state.time_step = triangle_time_step(scene, state.packing);
  check_step(state, path);
  if (state.packing.cell) state.cell_motion.reference_length = state.packing.cell->length;
  return state;
}

}  // namespace isostat
