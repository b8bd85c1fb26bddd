#include "dem/triangles/sample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "dem/input_error.hpp"
#include "dem/scene/text.hpp"
#include "dem/solver/random.hpp"
#include "dem/state/container_region.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/placement.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

constexpr int kMostTries = 100000;  // per grain
constexpr double kGap = 1e-6;       // [largest size] between grains as placed
constexpr double kRoom = 1.15;      // of the circle about a grain, for it deforms
constexpr double kFlight = 0.05;    // [sides] between two squares about to collide

State<TriangleGrains> without_grains(const Scene& scene, std::uint64_t seed) {
  State<TriangleGrains> state;
  state.scene = scene;
  state.seed = seed;
  state.law = resolve(scene.triangle_law);
  return state;
}

struct Place {
  Vec2 centre;
  double angle = 0;
};

// Places for grains, the largest first: in the periodic cell, or in the lower part of the container.
class Placement {
 public:
  Placement(const Scene& scene, const std::vector<GrainTemplate>& grains, const GrainTemplate& largest,
            const std::vector<WallGrain>& walls)
      : scene_(scene), grains_(grains), largest_(largest), room_(room()), field_(field()) {
    for (const WallGrain& w : walls)
      for (const TriangleCorners& t : placed(w.shape, w.centre, w.angle)) field_->add(t);
  }

  const std::optional<PeriodicCell<2>>& cell() const { return cell_; }

  std::vector<Place> find(Random& random) {
    std::vector<std::size_t> order(grains_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t p, std::size_t q) { return grains_[p].radius > grains_[q].radius; });
    std::vector<Place> places(grains_.size());
    for (const std::size_t k : order) {
      bool found = false;
      for (int tries = 0; tries < kMostTries && !found; ++tries) {
        Place p;
        for (int d = 0; d < 2; ++d) p.centre[d] = room_.origin[d] + random.uniform() * room_.length[d];
        p.angle = 2 * std::numbers::pi * random.uniform();
        found = try_to_place(grains_[k], p);
        if (found) places[k] = p;
      }
      if (!found)
        throw InputError("scene", 0, "grains.solid_fraction", real_text(scene_.triangle_grains.solid_fraction),
                         "random placement without overlap found no room; lower it (0.5 is safe for squares)");
    }
    return places;
  }

 private:
  double area() const {
    double sum = 0;
    for (const GrainTemplate& g : grains_) sum += grain_area(g);
    return sum / scene_.triangle_grains.solid_fraction;
  }

  // What centres are drawn from.
  Frame<2> room() {
    const ContainerScene& c = scene_.container;
    const double area = this->area();
    if (c.shape == ContainerShape::none) {
      const double width = std::sqrt(area * scene_.cell.aspect);
      cell_ = PeriodicCell<2>{{{width, area / width}}};
      if (std::min(cell_->length[0], cell_->length[1]) < 4 * largest_.radius)
        throw InputError("scene", 0, "grains.count", std::to_string(grains_.size()),
                         "too few for a periodic cell: it would be narrower than two grains");
      return {{}, cell_->length, true};
    }
    const double most = area_below(c, region_top(c));
    if (area > most)
      throw InputError("scene", 0, "grains.count", std::to_string(grains_.size()),
                       "the container is too small: at grains.solid_fraction the grains take " + real_text(area) +
                           " cm^2 of its " + real_text(most) + " cm^2");
    const double bottom = region_bottom(c), x = half_width(c);
    return {{{-x, bottom}}, {{2 * x, height_of_area(c, area) - bottom}}, false};
  }

  std::optional<TriangleField> field() const {
    Frame<2> box = room_;
    for (int d = 0; d < 2; ++d) box.origin[d] -= 2 * largest_.radius, box.length[d] += 4 * largest_.radius;
    return std::optional<TriangleField>(std::in_place, box, cell_, 2 * largest_.radius, grains_.size());
  }

  bool inside(const std::vector<TriangleCorners>& triangles) const {
    if (cell_) return true;
    const double top = room_.origin[1] + room_.length[1];
    return std::all_of(triangles.begin(), triangles.end(), [&](const TriangleCorners& t) {
      return std::all_of(t.begin(), t.end(),
                         [&](const Vec2& q) { return q[1] <= top && holds(scene_.container, q, 0); });
    });
  }

  bool try_to_place(const GrainTemplate& grain, const Place& at) {
    const std::vector<TriangleCorners> triangles = placed(grain, at.centre, at.angle);
    if (!inside(triangles) || !field_->leaves_room(triangles, 2 * kGap * largest_.radius)) return false;
    for (const TriangleCorners& t : triangles) field_->add(t);
    return true;
  }

  const Scene& scene_;
  const std::vector<GrainTemplate>& grains_;
  const GrainTemplate& largest_;
  std::optional<PeriodicCell<2>> cell_;
  Frame<2> room_;
  std::optional<TriangleField> field_;
};

std::vector<GrainTemplate> drawn_grains(const TriangleGrainsScene& g, const GrainMaterial& material, Random& random) {
  const std::vector<std::string> shapes = shape_names(g.shape);
  std::vector<TriangleMesh> meshes;  // of size 1: a file is read once
  for (const std::string& shape : shapes) meshes.push_back(grain_shape(shape, 1.0));
  std::vector<GrainTemplate> grains;
  for (std::size_t k = 0; k < idx(g.count); ++k) {
    TriangleMesh mesh = meshes[k % meshes.size()];
    const double size = g.size_min + (g.size_max - g.size_min) * random.uniform();
    for (Vec2& p : mesh.points) p = size * p;
    grains.push_back(grain_template(mesh, material));
  }
  return grains;
}

const GrainTemplate& largest_of(const std::vector<GrainTemplate>& grains) {
  return *std::max_element(grains.begin(), grains.end(),
                           [](const GrainTemplate& a, const GrainTemplate& b) { return a.radius < b.radius; });
}

// The left square is higher and flies along x; edges along the axes.
State<TriangleGrains> about_to_collide(const Scene& scene, std::uint64_t seed) {
  const TriangleGrainsScene& g = scene.triangle_grains;
  State<TriangleGrains> state = without_grains(scene, seed);
  const GrainTemplate square = grain_template(grain_shape("square", g.size_max), material_of(scene));
  append_grain(state.packing, square, {{-(1 + kFlight) * g.size_max, g.offset * g.size_max}}, 0, GrainPart::free, 0);
  append_grain(state.packing, square, {}, 0, GrainPart::free, 1);
  for (std::size_t k = 0; k < square.triangles.size(); ++k) state.packing.bodies.velocity[k] = {{g.speed, 0}};
  state.time_step = triangle_time_step(scene, state.packing);
  return state;
}

}  // namespace

TriangleLaw resolve(const TriangleLawScene& l) {
  TriangleLaw law;
  law.contact = l.contact;
  law.modulus = l.modulus;
  law.overlap_length = l.contact == ContactLaw::overlap_energy ? l.overlap_length : 0;
  law.friction = l.friction;
  law.tangential_stiffness = l.friction > 0 ? l.tangential_stiffness : 0;
  law.damping = l.damping;
  law.failure = l.failure;
  if (l.failure != BeamFailure::none) {
    law.limit_tension = l.limit_tension.value_or(kNever);
    law.limit_shear = l.limit_shear.value_or(kNever);
    law.limit_bending = l.limit_bending.value_or(kNever);
    law.limit_stretch = l.limit_stretch.value_or(kNever);
    law.limit_angle = l.limit_angle.value_or(kNever);
  }
  return law;
}

void append_grain(TrianglePacking& packing, const GrainTemplate& grain, const Vec2& centre, double angle,
                  GrainPart part, std::int64_t id) {
  Bodies<2>& b = packing.bodies;
  const std::size_t first = b.size();
  const std::int64_t first_id = first == 0 ? 0 : b.id.back() + 1;
  b.resize(first + grain.triangles.size());
  const double c = std::cos(angle), s = std::sin(angle);
  Vec2 mean{};
  for (std::size_t k = 0; k < grain.triangles.size(); ++k) {
    const GrainTriangle& t = grain.triangles[k];
    const std::size_t body = first + k;
    b.id[body] = first_id + static_cast<std::int64_t>(k);
    b.position[body] = {
        {centre[0] + (c * t.centroid[0] - s * t.centroid[1]), centre[1] + (s * t.centroid[0] + c * t.centroid[1])}};
    b.mass[body] = t.mass, b.inertia[body] = t.inertia;
    b.radius[body] = 0;
    for (const Vec2& q : t.corner) b.radius[body] = std::max(b.radius[body], norm(q));
    packing.corner.push_back(t.corner);
    packing.angle.push_back(angle);
    mean += (1.0 / static_cast<double>(grain.triangles.size())) * t.centroid;
  }
  double radius = 0;
  for (const GrainTriangle& t : grain.triangles)
    for (const Vec2& q : t.corner) radius = std::max(radius, norm(t.centroid + q - mean));
  Grains& g = packing.grains;
  if (g.begin.empty()) g.begin.push_back(0);
  g.id.push_back(id), g.part.push_back(part), g.radius.push_back(kRoom * radius);
  g.begin.push_back(static_cast<std::int32_t>(b.size()));
  for (const GrainBeam& beam : grain.beams) {
    Link<2> link;
    link.i = static_cast<std::int32_t>(first) + beam.i, link.j = static_cast<std::int32_t>(first) + beam.j;
    link.kind = LinkKind::beam;
    link.beam = static_cast<std::int32_t>(packing.beams.size());
    packing.beams.push_back(beam.beam);
    packing.links.push_back(link);
  }
}

State<TriangleGrains> place_triangles(const Scene& scene, std::uint64_t seed) {
  if (scene.triangle_grains.arrangement == Arrangement::collision) return about_to_collide(scene, seed);
  State<TriangleGrains> state = without_grains(scene, seed);
  Random random(seed);
  const GrainMaterial material = material_of(scene);
  const std::vector<GrainTemplate> grains = drawn_grains(scene.triangle_grains, material, random);
  const GrainTemplate& largest = largest_of(grains);
  const std::vector<WallGrain> walls = wall_grains(scene.container, largest, material);
  Placement placement(scene, grains, largest, walls);
  const std::vector<Place> places = placement.find(random);
  TrianglePacking& packing = state.packing;
  packing.cell = placement.cell();
  std::int64_t id = 0;
  for (std::size_t k = 0; k < grains.size(); ++k)
    append_grain(packing, grains[k], places[k].centre, places[k].angle, GrainPart::free, id++);
  for (const WallGrain& w : walls) append_grain(packing, w.shape, w.centre, w.angle, w.part, id++);
  state.time_step = triangle_time_step(scene, packing);
  state.random_counter = random.counter();
  if (packing.cell) state.cell_motion.reference_length = packing.cell->length;
  return state;
}

}  // namespace isostat
