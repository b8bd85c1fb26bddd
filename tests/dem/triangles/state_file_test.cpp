// State files of grains of triangles: everything comes back, damage is found, and what no run can go on from is
// refused.
#include "dem/files/state_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "dem/files/state_seal.hpp"
#include "dem/input_error.hpp"
#include "dem/triangles/physical_hash.hpp"
#include "dem/triangles/state_check.hpp"
#include "tests/support/random_state.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/triangle_state.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(TriangleStateFile, EverythingComesBack) {
  for (const std::uint64_t seed : {1, 2, 3, 4})
    for (const bool with_cell : {true, false}) {
      const State<TriangleGrains> state = random_triangle_state(seed, with_cell);
      const std::string image = encode_state(state, {"1.2.3", "", "pack scene.toml"});
      const StateFile file = decode_state(image, "memory");
      const auto& back = std::get<State<TriangleGrains>>(file.state);
      EXPECT_EQ(all_numbers(back), all_numbers(state));
      EXPECT_EQ(back.seed, state.seed);
      EXPECT_EQ(back.random_counter, state.random_counter);
      EXPECT_EQ(back.scene.stages.size(), 2u);
      EXPECT_EQ(file.hash, physical_hash(state));
      EXPECT_EQ(file.provenance.command, "pack scene.toml");
      EXPECT_EQ(encode_state(file.state, file.provenance), image);
    }
}

TEST(TriangleStateFile, NothingIsAStateToo) {
  State<TriangleGrains> empty;
  empty.scene.system = SceneSystem::triangles;
  EXPECT_EQ(all_numbers(std::get<State<TriangleGrains>>(decode_state(encode_state(empty), "memory").state)),
            all_numbers(empty));
}

TEST(TriangleStateFile, ReadersOfOneSystemRefuseTheOther) {
  const TemporaryFolder folder;
  write_state(random_triangle_state(5), folder / "triangles.h5");
  write_state(random_state(5, 3, 2), folder / "disks.h5");
  EXPECT_EQ(all_numbers(read_state<TriangleGrains>(folder / "triangles.h5")), all_numbers(random_triangle_state(5)));
  EXPECT_THAT(message_of([&] { read_state<Disks>(folder / "triangles.h5"); }),
              HasSubstr("system = triangles: a state of disks is wanted"));
  EXPECT_THAT(message_of([&] { read_state<TriangleGrains>(folder / "disks.h5"); }),
              HasSubstr("system = disks: a state of triangles is wanted"));
}

TEST(TriangleStateFile, EveryFlippedBitIsBadInput) {
  std::string image = encode_state(random_triangle_state(6));
  const auto flip = [&](std::size_t byte, int bit) { image[byte] = static_cast<char>(image[byte] ^ (1 << bit)); };
  for (std::size_t byte = 0; byte < image.size(); byte += byte < kSealBytes ? 1 : 37) {
    const int bit = static_cast<int>(byte % 8);
    flip(byte, bit);
    EXPECT_THROW(decode_state(image, "flipped"), InputError) << byte;
    flip(byte, bit);
  }
  EXPECT_NO_THROW(decode_state(image, "whole"));
}

struct Faulty {
  const char *field, *rule;  // parts of what is said
  std::function<void(State<TriangleGrains>&)> spoil;
};

TEST(TriangleStateFile, EveryFaultIsNamedAndNeverWritten) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  using S = State<TriangleGrains>;
  const std::vector<Faulty> faults{
      {"particles/triangles", "different lengths", [](S& s) { s.packing.angle.pop_back(); }},
      {"particles/triangles", "different lengths", [](S& s) { s.packing.corner.pop_back(); }},
      {"particles/triangles/position", "element 3 is not a finite number",
       [](S& s) { s.packing.bodies.position[3][1] = nan; }},
      {"particles/triangles/angle", "element 2 is not a finite number", [](S& s) { s.packing.angle[2] = nan; }},
      {"particles/triangles/corner", "element 9 is not a finite number", [](S& s) { s.packing.corner[9][2][0] = nan; }},
      {"particles/triangles/corner", "triangle 4 is flat",
       [](S& s) { std::swap(s.packing.corner[4][0], s.packing.corner[4][1]); }},
      {"particles/triangles/id", "-7 occurs twice", [](S& s) { s.packing.bodies.id[1] = -7; }},
      {"particles/triangles/box/edges", "not positive", [](S& s) { s.packing.cell->length[0] = 0; }},
      {"grains/id", "occurs twice", [](S& s) { s.packing.grains.id[1] = s.packing.grains.id[0]; }},
      {"grains", "different lengths", [](S& s) { s.packing.grains.part.pop_back(); }},
      {"grains/radius", "element 1 is not positive", [](S& s) { s.packing.grains.radius[1] = 0; }},
      {"grains/part", "part of nothing", [](S& s) { s.packing.grains.part[1] = static_cast<GrainPart>(3); }},
      {"grains/begin", "one element more", [](S& s) { s.packing.grains.begin.pop_back(); }},
      {"grains/begin", "does not begin", [](S& s) { s.packing.grains.begin[0] = 1; }},
      {"grains/begin", "grain 1 has no triangle", [](S& s) { s.packing.grains.begin[2] = s.packing.grains.begin[1]; }},
      {"grains/begin", "does not end", [](S& s) { ++s.packing.grains.begin.back(); }},
      {"links/kind", "link 2 is no beam", [](S& s) { s.packing.links[2].kind = LinkKind::closed; }},
      {"links/i", "link 0 does not join", [](S& s) { s.packing.links[0].j = 10; }},
      {"links/i", "link 0 does not join", [](S& s) { std::swap(s.packing.links[0].i, s.packing.links[0].j); }},
      {"links/i", "link 0 joins two grains", [](S& s) { s.packing.links[0].j = 4; }},
      {"links/beam", "another link's", [](S& s) { s.packing.links[1].beam = s.packing.links[0].beam; }},
      {"links/beam", "not there", [](S& s) { s.packing.links[1].beam = 8; }},
      {"links", "not a finite number", [](S& s) { s.packing.links[7].moment = nan; }},
      {"beams", "one link for each beam", [](S& s) { s.packing.links.pop_back(); }},
      {"beams", "beam 6 has a number", [](S& s) { s.packing.beams[6].rest_angle_i = nan; }},
      {"beams", "beam 6 has no length", [](S& s) { s.packing.beams[6].rest_length = 0; }},
      {"overlaps/i", "overlap 1 does not name", [](S& s) { s.packing.overlaps[1].grain_i = 2; }},
      {"overlaps/i", "overlap 1 does not name", [](S& s) { s.packing.overlaps[1].grain_j = 4; }},
      {"overlaps/area", "no positive", [](S& s) { s.packing.overlaps[0].area = 0; }},
      {"overlaps", "not finite", [](S& s) { s.packing.overlaps[0].point[1] = nan; }},
      {"overlaps/shift", "crosses a cell", [](S& s) { s.packing.cell.reset(); }},
      {"events/time", "event 1 is earlier", [](S& s) { s.packing.events[1].time = 0.1; }},
      {"events/time", "not finite", [](S& s) { s.packing.events[1].time = nan; }},
      {"events/mode", "unknown mode", [](S& s) { s.packing.events[0].mode = static_cast<BeamMode>(3); }},
      {"solver", "one element a triangle nor none", [](S& s) { s.memory.derivatives.pop_back(); }},
      {"solver", "one element a triangle nor none", [](S& s) { s.memory.candidate_angle.pop_back(); }},
      {"solver", "triangle of a wall", [](S& s) { s.memory.wall_angle.pop_back(); }},
      {"solver", "one element a grain", [](S& s) { s.memory.lists.inner_position.pop_back(); }},
      {"solver/derivatives", "not a finite number", [](S& s) { s.memory.derivatives[3][1][0] = nan; }},
      {"solver/wall_position", "not a finite number", [](S& s) { s.memory.wall_position[1][0] = nan; }},
      {"solver/pairs", "does not join", [](S& s) { s.memory.pairs[0].j = 4; }},
      {"law", "negative", [](S& s) { s.law.damping = -1; }},
      {"law", "a limit of the beams", [](S& s) { s.law.limit_shear = nan; }},
      {"law", "not known", [](S& s) { s.law.failure = static_cast<BeamFailure>(3); }},
      {"surroundings", "not finite", [](S& s) { s.surroundings.start_angle = nan; }},
      {"surroundings", "negative", [](S& s) { s.surroundings.grains_left = -1; }},
      {"progress", "stage is not one", [](S& s) { s.progress.stage = 3; }},
  };
  const State<TriangleGrains> state = random_triangle_state(8);
  EXPECT_EQ(state_fault(state).has_value(), false);
  for (const Faulty& faulty : faults) {
    State<TriangleGrains> spoilt = state;
    faulty.spoil(spoilt);
    const auto fault = state_fault(spoilt);
    ASSERT_TRUE(fault.has_value()) << faulty.field << ": " << faulty.rule;
    EXPECT_EQ(fault->field, faulty.field);
    EXPECT_THAT(fault->rule, HasSubstr(faulty.rule));
    EXPECT_THROW(encode_state(spoilt), std::invalid_argument);
  }
}

}  // namespace
}  // namespace isostat
