#include "dem/triangles/physical_hash.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "dem/state/digest.hpp"

namespace isostat {
namespace {

template <class Enum>
std::int64_t code(Enum e) {
  return static_cast<std::int64_t>(e);
}

void add_law(Digest& digest, const TriangleLaw& law) {
  const auto& [contact, modulus, overlap_length, friction, tangential_stiffness, damping, failure, tension, shear,
               bending, stretch, angle] = law;
  digest.add(code(contact));
  for (const double x : {modulus, overlap_length, friction, tangential_stiffness, damping}) digest.add(x);
  digest.add(code(failure));
  for (const double x : {tension, shear, bending, stretch, angle}) digest.add(x);
}

void add_grains(Digest& digest, const TrianglePacking& p) {
  const Grains& g = p.grains;
  const Bodies<2>& b = p.bodies;
  std::vector<std::size_t> order(g.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) { return g.id[x] < g.id[y]; });
  digest.add(code(g.size()));
  for (const std::size_t grain : order) {
    digest.add(g.id[grain]), digest.add(code(g.part[grain]));
    const auto begin = static_cast<std::size_t>(g.begin[grain]), end = static_cast<std::size_t>(g.begin[grain + 1]);
    digest.add(code(end - begin));
    for (std::size_t k = begin; k < end; ++k) {
      digest.add(b.id[k]);
      digest.add(b.position[k]), digest.add(p.angle[k]);
      digest.add(b.velocity[k]), digest.add(b.spin[k]);
      digest.add(b.mass[k]), digest.add(b.inertia[k]);
      for (const Vec2& corner : p.corner[k]) digest.add(corner);
    }
  }
}

void add_shift(Digest& digest, const ImageShift<2>& shift) {
  for (const int s : shift) digest.add(std::int64_t{s});
}

// A beam keeps its ends: within a grain the order of triangles is that of the grain wherever it is stored.
void add_beams(Digest& digest, const TrianglePacking& p) {
  const auto key = [&](const Link<2>& l) {
    return std::tuple(p.bodies.id[static_cast<std::size_t>(l.i)], p.bodies.id[static_cast<std::size_t>(l.j)], l.shift);
  };
  std::vector<Link<2>> links = p.links;
  std::sort(links.begin(), links.end(), [&](const Link<2>& x, const Link<2>& y) { return key(x) < key(y); });
  digest.add(code(links.size()));
  for (const Link<2>& l : links) {
    const auto [i, j, shift] = key(l);
    digest.add(i), digest.add(j), add_shift(digest, shift);
    for (const double x : {l.gap, l.normal_force, l.tangential_force, l.moment}) digest.add(x);
    const auto& [length, angle_i, angle_j, stiffness, bending] = p.beams[static_cast<std::size_t>(l.beam)];
    for (const double x : {length, angle_i, angle_j, stiffness, bending}) digest.add(x);
  }
}

// An overlap seen from its smaller id; seen from the other grain n and t turn round, so N and T keep their sign, and
// the point lies beside that grain. Where this moves the point by a cell it is rounded: it is left out there, whichever
// grain comes first.
struct CanonicalOverlap {
  std::int64_t a, b;
  ImageShift<2> shift;
  Overlap overlap;
  auto key() const { return std::tie(a, b, shift); }
};

CanonicalOverlap canonical(const Overlap& o, const std::vector<std::int64_t>& id) {
  const std::int64_t i = id[static_cast<std::size_t>(o.grain_i)], j = id[static_cast<std::size_t>(o.grain_j)];
  CanonicalOverlap c{i, j, o.shift, o};
  if (i > j) {
    c.a = j, c.b = i, c.shift = {-o.shift[0], -o.shift[1]};
    c.overlap.normal = -1.0 * o.normal;
  }
  if (o.shift != ImageShift<2>{}) c.overlap.point = {};
  return c;
}

void add_overlaps(Digest& digest, const TrianglePacking& p) {
  std::vector<CanonicalOverlap> overlaps;
  overlaps.reserve(p.overlaps.size());
  for (const Overlap& o : p.overlaps) overlaps.push_back(canonical(o, p.grains.id));
  std::sort(overlaps.begin(), overlaps.end(), [](const auto& x, const auto& y) { return x.key() < y.key(); });
  digest.add(code(overlaps.size()));
  for (const CanonicalOverlap& c : overlaps) {
    digest.add(c.a), digest.add(c.b), add_shift(digest, c.shift);
    digest.add(c.overlap.area), digest.add(c.overlap.normal_force), digest.add(c.overlap.tangential_force);
    digest.add(c.overlap.normal), digest.add(c.overlap.point);
  }
}

// Those of one instant have no order.
void add_events(Digest& digest, std::vector<BeamEvent> events) {
  const auto key = [](const BeamEvent& e) { return std::tie(e.time, e.body_i, e.body_j, e.mode, e.broken); };
  std::sort(events.begin(), events.end(), [&](const BeamEvent& x, const BeamEvent& y) { return key(x) < key(y); });
  digest.add(code(events.size()));
  for (const auto& [time, body_i, body_j, mode, broken] : events) {
    digest.add(time), digest.add(body_i), digest.add(body_j);
    digest.add(code(mode)), digest.add(std::int64_t{broken});
  }
}

}  // namespace

std::string physical_hash(const State<TriangleGrains>& state) {
  Digest digest;
  digest.add(TriangleGrains::name);
  digest.add(state.time);
  add_law(digest, state.law);
  digest.add(std::int64_t{state.packing.cell.has_value()});
  if (state.packing.cell) digest.add(state.packing.cell->length);
  digest.add(state.cell_motion.reference_length);
  digest.add(state.cell_motion.strain_rate);
  add_grains(digest, state.packing);
  add_beams(digest, state.packing);
  add_overlaps(digest, state.packing);
  add_events(digest, state.packing.events);
  add_surroundings(digest, state.scene.gravity, state.surroundings);
  return digest.hex();
}

}  // namespace isostat
