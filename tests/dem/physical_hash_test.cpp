// The hash of a state sees its physics, every number of it, and nothing else.
#include "dem/disks/physical_hash.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

#include "tests/support/random_state.hpp"

namespace isostat {
namespace {

// The same packing in another order of storage, every other link seen from its other end.
State<Disks> shuffled(const State<Disks>& state, std::uint64_t seed) {
  State<Disks> s = state;
  const std::size_t n = state.packing.bodies.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 engine(seed);
  std::shuffle(order.begin(), order.end(), engine);
  std::vector<std::int32_t> place(n);
  const Bodies<2>& from = state.packing.bodies;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t o = order[k];
    Bodies<2>& to = s.packing.bodies;
    place[o] = static_cast<std::int32_t>(k);
    to.id[k] = from.id[o], to.position[k] = from.position[o], to.velocity[k] = from.velocity[o];
    to.spin[k] = from.spin[o], to.radius[k] = from.radius[o], to.mass[k] = from.mass[o],
    to.inertia[k] = from.inertia[o];
  }
  for (std::size_t k = 0; k < s.packing.links.size(); ++k) {
    Link<2>& l = s.packing.links[k];
    l.i = place[static_cast<std::size_t>(l.i)], l.j = place[static_cast<std::size_t>(l.j)];
    if (k % 2) {  // n and t turn round: force on the other body -(N n + T t) = N n' + T t', moment on it -M
      std::swap(l.i, l.j);
      l.shift = {-l.shift[0], -l.shift[1]};
      l.moment = -l.moment;
    }
  }
  std::shuffle(s.packing.links.begin(), s.packing.links.end(), engine);
  return s;
}

RC_GTEST_PROP(PhysicalHash, DoesNotSeeTheOrderOfStorage, (std::uint64_t seed)) {
  const State<Disks> state = random_state(seed, *rc::gen::inRange(1, 12), *rc::gen::inRange(0, 20));
  State<Disks> other = shuffled(state, seed + 1);
  RC_ASSERT(physical_hash(other) == physical_hash(state));
  other.memory = {};
  other.scene = Scene();
  other.progress = {};
  other.seed += 1, other.step += 1;
  RC_ASSERT(physical_hash(other) == physical_hash(state));
}

TEST(PhysicalHash, SeesEveryPhysicalNumber) {
  const State<Disks> state = random_state(20, 6, 9);
  const std::string hash = physical_hash(state);
  const auto next = [](double& x) { x = std::nextafter(x, 10.0); };
  const std::vector<std::function<void(State<Disks>&)>> changes{
      [&](State<Disks>& s) { next(s.time); },
      [&](State<Disks>& s) { next(s.law.rolling_friction); },
      [&](State<Disks>& s) { next(s.packing.cell->length[1]); },
      [&](State<Disks>& s) { s.packing.cell.reset(); },
      [&](State<Disks>& s) { next(s.cell_motion.strain_rate[0]); },
      [&](State<Disks>& s) { next(s.cell_motion.reference_length[1]); },
      [&](State<Disks>& s) { s.packing.bodies.id[3] += 1000; },
      [&](State<Disks>& s) { next(s.packing.bodies.position[5][1]); },
      [&](State<Disks>& s) { next(s.packing.bodies.velocity[0][0]); },
      [&](State<Disks>& s) { next(s.packing.bodies.spin[1]); },
      [&](State<Disks>& s) { next(s.packing.bodies.radius[2]); },
      [&](State<Disks>& s) { next(s.packing.bodies.mass[2]); },
      [&](State<Disks>& s) { next(s.packing.bodies.inertia[2]); },
      [&](State<Disks>& s) { s.packing.links.pop_back(); },
      [&](State<Disks>& s) { s.packing.links[3].shift[0] += 1; },
      [&](State<Disks>& s) {
        s.packing.links[3].kind = s.packing.links[3].kind == LinkKind::closed ? LinkKind::distant : LinkKind::closed;
      },
      [&](State<Disks>& s) { next(s.packing.links[4].gap); },
      [&](State<Disks>& s) { next(s.packing.links[4].normal_force); },
      [&](State<Disks>& s) { next(s.packing.links[4].tangential_force); },
      [&](State<Disks>& s) { s.packing.links[4].moment = -s.packing.links[4].moment; },
      [&](State<Disks>& s) { s.scene.gravity = 1; },
      [&](State<Disks>& s) { ++s.surroundings.grains_left; },
      [&](State<Disks>& s) { next(s.surroundings.start_angle); },
  };
  for (std::size_t k = 0; k < changes.size(); ++k) {
    State<Disks> changed = state;
    changes[k](changed);
    EXPECT_NE(physical_hash(changed), hash) << "change " << k;
  }
  State<Disks> zero = state, negative = state;
  zero.packing.bodies.spin[0] = 0.0, negative.packing.bodies.spin[0] = -0.0;
  EXPECT_EQ(physical_hash(zero), physical_hash(negative));
}

}  // namespace
}  // namespace isostat
