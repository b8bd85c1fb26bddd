// The hash of a state of triangles sees its physics, every number of it, and nothing else.
#include "dem/triangles/physical_hash.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "dem/triangles/state_check.hpp"
#include "tests/support/triangle_state.hpp"

namespace isostat {
namespace {

using S = State<TriangleGrains>;

// The grains in another order of storage, with everything that names them; links, overlaps and events as they come.
S reordered(const S& s, const std::vector<std::size_t>& order) {
  S to = s;
  const TrianglePacking& p = s.packing;
  TrianglePacking& q = to.packing;
  q.bodies = {}, q.corner.clear(), q.angle.clear(), q.grains = {}, q.grains.begin = {0};
  std::vector<std::int32_t> grain_at(order.size()), triangle_at(p.bodies.size());
  for (const std::size_t g : order) {
    grain_at[g] = static_cast<std::int32_t>(q.grains.size());
    for (auto k = static_cast<std::size_t>(p.grains.begin[g]); k < static_cast<std::size_t>(p.grains.begin[g + 1]);
         ++k) {
      triangle_at[k] = static_cast<std::int32_t>(q.bodies.size());
      q.bodies.id.push_back(p.bodies.id[k]), q.bodies.position.push_back(p.bodies.position[k]);
      q.bodies.velocity.push_back(p.bodies.velocity[k]), q.bodies.spin.push_back(p.bodies.spin[k]);
      q.bodies.radius.push_back(p.bodies.radius[k]), q.bodies.mass.push_back(p.bodies.mass[k]);
      q.bodies.inertia.push_back(p.bodies.inertia[k]);
      q.corner.push_back(p.corner[k]), q.angle.push_back(p.angle[k]);
    }
    q.grains.id.push_back(p.grains.id[g]), q.grains.part.push_back(p.grains.part[g]);
    q.grains.radius.push_back(p.grains.radius[g]);
    q.grains.begin.push_back(static_cast<std::int32_t>(q.bodies.size()));
  }
  for (Link<2>& l : q.links)
    l.i = triangle_at[static_cast<std::size_t>(l.i)], l.j = triangle_at[static_cast<std::size_t>(l.j)];
  for (Overlap& o : q.overlaps) {
    o.grain_i = grain_at[static_cast<std::size_t>(o.grain_i)];
    o.grain_j = grain_at[static_cast<std::size_t>(o.grain_j)];
    if (o.grain_i < o.grain_j) continue;
    // n and t turn round: the force on the other grain is -(N n + T t) = N n' + T t'
    std::swap(o.grain_i, o.grain_j);
    o.normal = -1.0 * o.normal;
    if (q.cell) o.point -= q.cell->offset(o.shift);
    o.shift = {-o.shift[0], -o.shift[1]};
  }
  std::reverse(q.links.begin(), q.links.end()), std::reverse(q.overlaps.begin(), q.overlaps.end());
  to.memory = {};
  return to;
}

TEST(TrianglePhysicalHash, DoesNotSeeTheOrderOfStorage) {
  for (const bool with_cell : {true, false}) {
    const S state = random_triangle_state(11, with_cell);
    std::vector<std::size_t> order{0, 1, 2, 3};
    do {
      S other = reordered(state, order);
      ASSERT_FALSE(state_fault(other).has_value());
      EXPECT_EQ(physical_hash(other), physical_hash(state));
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(TrianglePhysicalHash, DoesNotSeeWhatIsNoPhysics) {
  const S state = random_triangle_state(12);
  S other = state;
  other.memory = {}, other.progress = {}, other.ledger = {}, other.certificate = {};
  other.scene.stages.clear();
  other.seed += 1, other.step += 1;
  EXPECT_EQ(physical_hash(other), physical_hash(state));
  other.packing.events[1].time = other.packing.events[0].time;
  S swapped = other;
  std::swap(swapped.packing.events[0], swapped.packing.events[1]);
  EXPECT_EQ(physical_hash(other), physical_hash(swapped));
}

TEST(TrianglePhysicalHash, SeesEveryPhysicalNumber) {
  const S state = random_triangle_state(13);
  const auto next = [](double& x) { x = std::nextafter(x, 10.0); };
  const std::vector<std::function<void(S&)>> changes{
      [](S&) {},
      [&](S& s) { next(s.time); },
      [&](S& s) { s.law.contact = ContactLaw::overlap_energy; },
      [&](S& s) { next(s.law.modulus); },
      [&](S& s) { next(s.law.overlap_length); },
      [&](S& s) { next(s.law.friction); },
      [&](S& s) { next(s.law.tangential_stiffness); },
      [&](S& s) { next(s.law.damping); },
      [&](S& s) { s.law.failure = BeamFailure::none; },
      [&](S& s) { next(s.law.limit_tension); },
      [&](S& s) { s.law.limit_shear = 1; },
      [&](S& s) { s.law.limit_bending = 1; },
      [&](S& s) { next(s.law.limit_stretch); },
      [&](S& s) { next(s.law.limit_angle); },
      [&](S& s) { next(s.packing.cell->length[1]); },
      [&](S& s) { s.packing.cell.reset(); },
      [&](S& s) { next(s.cell_motion.reference_length[1]); },
      [&](S& s) { next(s.cell_motion.strain_rate[0]); },
      [&](S& s) { s.packing.grains.id[1] += 1000; },
      [&](S& s) { s.packing.grains.part[1] = GrainPart::free; },
      [&](S& s) { s.packing.bodies.id[3] += 1000; },
      [&](S& s) { next(s.packing.bodies.position[5][1]); },
      [&](S& s) { next(s.packing.angle[5]); },
      [&](S& s) { next(s.packing.bodies.velocity[0][0]); },
      [&](S& s) { next(s.packing.bodies.spin[1]); },
      [&](S& s) { next(s.packing.bodies.mass[2]); },
      [&](S& s) { next(s.packing.bodies.inertia[2]); },
      [&](S& s) { next(s.packing.corner[7][2][1]); },
      [&](S& s) { --s.packing.grains.begin[1]; },  // a triangle goes over to the next grain
      [&](S& s) { s.packing.links.pop_back(); },
      [&](S& s) { s.packing.links[3].shift[0] += 1; },
      [&](S& s) { std::swap(s.packing.links[3].beam, s.packing.links[4].beam); },
      [&](S& s) { next(s.packing.links[4].gap); },
      [&](S& s) { next(s.packing.links[4].normal_force); },
      [&](S& s) { next(s.packing.links[4].tangential_force); },
      [&](S& s) { s.packing.links[4].moment = -s.packing.links[4].moment; },
      [&](S& s) { next(s.packing.beams[0].rest_length); },
      [&](S& s) { next(s.packing.beams[1].rest_angle_i); },
      [&](S& s) { next(s.packing.beams[1].rest_angle_j); },
      [&](S& s) { s.packing.beams[2].stiffness *= 2; },
      [&](S& s) { s.packing.beams[3].bending *= 2; },
      [&](S& s) { s.packing.overlaps.pop_back(); },
      [&](S& s) { s.packing.overlaps[2].shift[0] += 1; },
      [&](S& s) { next(s.packing.overlaps[1].area); },
      [&](S& s) { next(s.packing.overlaps[1].normal_force); },
      [&](S& s) { next(s.packing.overlaps[1].tangential_force); },
      [&](S& s) { s.packing.overlaps[1].normal = -1.0 * s.packing.overlaps[1].normal; },
      [&](S& s) { next(s.packing.overlaps[1].point[0]); },
      [&](S& s) { s.packing.events.pop_back(); },
      [&](S& s) { next(s.packing.events[1].time); },
      [&](S& s) { s.packing.events[1].body_j += 1; },
      [&](S& s) { s.packing.events[1].mode = BeamMode::tension; },
      [&](S& s) { s.packing.events[1].broken = false; },
      [&](S& s) { s.scene.gravity = 981; },
      [&](S& s) { s.surroundings = {}; },
      [&](S& s) { next(s.surroundings.start_offset[1]); },
      [&](S& s) { next(s.surroundings.start_angle); },
      [&](S& s) { s.surroundings.open = false; },
      [&](S& s) { ++s.surroundings.grains_left; },
      [&](S& s) { next(s.surroundings.mass_left); },
      [&](S& s) { next(s.surroundings.last_left); },
  };
  std::set<std::string> hashes;
  for (std::size_t k = 0; k < changes.size(); ++k) {
    S changed = state;
    changes[k](changed);
    EXPECT_TRUE(hashes.insert(physical_hash(changed)).second) << "change " << k;
  }
  S zero = state, negative = state;
  zero.packing.bodies.spin[0] = 0.0, negative.packing.bodies.spin[0] = -0.0;
  EXPECT_EQ(physical_hash(zero), physical_hash(negative));
}

}  // namespace
}  // namespace isostat
