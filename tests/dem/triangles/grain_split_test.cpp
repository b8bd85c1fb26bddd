// Grains that come apart and grains that go: every array follows its triangles.
#include "dem/triangles/grain_split.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "dem/triangles/state_check.hpp"
#include "geometry/base/index.hpp"
#include "tests/support/triangle_state.hpp"

namespace isostat {
namespace {

// random_triangle_state(): grains square, triangle (wall), square, triangle (lid); every number its own.
struct Triangle3 {
  Vec2 position, force, half;
  double angle, spin;
  std::array<Vec2, 3> corner;
  friend bool operator==(const Triangle3&, const Triangle3&) = default;
};
Triangle3 of_id(const State<TriangleGrains>& s, std::int64_t id) {
  const auto& ids = s.packing.bodies.id;
  const auto k = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
  return {s.packing.bodies.position[k], s.memory.force[k],        s.memory.half_velocity[k],
          s.packing.angle[k],           s.packing.bodies.spin[k], s.packing.corner[k]};
}
std::pair<std::int64_t, std::int64_t> ids_of(const State<TriangleGrains>& s, const Link<2>& l) {
  return {s.packing.bodies.id[idx(l.i)], s.packing.bodies.id[idx(l.j)]};
}

void expect_sound(const State<TriangleGrains>& s) {
  const auto packing = packing_fault(s.packing), memory = memory_fault(s.memory, s.packing);
  EXPECT_FALSE(packing) << packing.value_or(StateFault{}).field << " " << packing.value_or(StateFault{}).rule;
  EXPECT_FALSE(memory) << memory.value_or(StateFault{}).field << " " << memory.value_or(StateFault{}).rule;
}

TEST(GrainSplit, PartsAreInTheOrderOfTheirFirstTriangles) {
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    State<TriangleGrains> s = random_triangle_state(seed);
    const State<TriangleGrains> before = s;
    // Of the first square, beams in a ring: without two of them it is two halves, or one triangle and the rest.
    std::vector<std::size_t> ring;
    for (std::size_t l = 0; l < s.packing.links.size(); ++l)
      if (s.packing.links[l].i < 4) ring.push_back(l);
    ASSERT_EQ(ring.size(), 4u);
    for (const std::size_t l : {ring[seed % 4], ring[(seed + 1 + seed / 4 % 2) % 4]})
      s.packing.beams[idx(s.packing.links[l].beam)].stiffness = 0;
    drop_broken_beams(s);
    ASSERT_EQ(s.packing.grains.size(), before.packing.grains.size() + 1);
    const std::int64_t most = *std::max_element(before.packing.grains.id.begin(), before.packing.grains.id.end());
    EXPECT_EQ(s.packing.grains.id[0], before.packing.grains.id[0]);
    EXPECT_EQ(s.packing.grains.id[1], most + 1);
    EXPECT_EQ(s.packing.bodies.id[0], before.packing.bodies.id[0]);
    EXPECT_EQ(s.packing.grains.begin[2], 4);
    EXPECT_EQ(s.packing.links.size(), before.packing.links.size() - 2);
    EXPECT_EQ(s.packing.beams.size(), before.packing.beams.size() - 2);
    for (const std::int64_t id : before.packing.bodies.id) EXPECT_EQ(of_id(s, id), of_id(before, id));
    for (const Link<2>& l : s.packing.links) {  // each with the beam that it had
      const auto was = std::find_if(before.packing.links.begin(), before.packing.links.end(),
                                    [&](const Link<2>& o) { return ids_of(before, o) == ids_of(s, l); });
      ASSERT_NE(was, before.packing.links.end());
      EXPECT_EQ(s.packing.beams[idx(l.beam)], before.packing.beams[idx(was->beam)]);
    }
    // Springs 0-2 and 1-2: the first goes with the grain that came apart.
    ASSERT_EQ(s.memory.pairs.size(), 1u);
    EXPECT_EQ(s.packing.grains.id[idx(s.memory.pairs[0].i)], before.packing.grains.id[1]);
    EXPECT_EQ(s.packing.grains.id[idx(s.memory.pairs[0].j)], before.packing.grains.id[2]);
    EXPECT_TRUE(s.memory.lists.inner_position.empty());
    for (std::size_t g = 0; g < 2; ++g) {  // for the engine to measure
      EXPECT_EQ(s.packing.grains.radius[g], 0);
      s.packing.grains.radius[g] = 1;
    }
    expect_sound(s);
  }
}

TEST(GrainSplit, WithoutBreaksNothingChanges) {
  State<TriangleGrains> s = random_triangle_state(4);
  const State<TriangleGrains> before = s;
  drop_broken_beams(s);
  EXPECT_EQ(s.packing.bodies.id, before.packing.bodies.id);
  EXPECT_EQ(s.packing.grains.id, before.packing.grains.id);
  EXPECT_EQ(s.packing.links.size(), before.packing.links.size());
  EXPECT_EQ(s.memory.pairs.size(), before.memory.pairs.size());
}

TEST(GrainSplit, GrainsGoWithAllThatIsTheirs) {
  const State<TriangleGrains> before = random_triangle_state(9);
  for (std::size_t gone = 0; gone < 4; ++gone) {
    State<TriangleGrains> s = before;
    std::vector<bool> which(4, false);
    which[gone] = true;
    remove_grains(s, which);
    ASSERT_EQ(s.packing.grains.size(), 3u);
    EXPECT_EQ(std::count(s.packing.grains.id.begin(), s.packing.grains.id.end(), before.packing.grains.id[gone]), 0);
    EXPECT_EQ(s.packing.bodies.size(), before.packing.bodies.size() - (gone % 2 == 0 ? 4 : 1));
    for (const std::int64_t id : s.packing.bodies.id) EXPECT_EQ(of_id(s, id), of_id(before, id));
    EXPECT_EQ(s.packing.links.size(), gone % 2 == 0 ? 4u : 8u);
    // Overlaps 0-2, 1-2, 0-3; springs 0-2, 1-2.
    EXPECT_EQ(s.packing.overlaps.size(), gone == 0 || gone == 2 ? 1u : 2u);
    EXPECT_EQ(s.memory.pairs.size(), gone == 2 ? 0u : gone == 3 ? 2u : 1u);
    EXPECT_EQ(s.memory.wall_position.size(), gone % 2 == 0 ? 2u : 1u);
    if (gone == 1) {
      EXPECT_EQ(s.memory.wall_position[0], before.memory.wall_position[1]);
    }
    expect_sound(s);
  }
}

}  // namespace
}  // namespace isostat
