// A packing put back into its state unchanged is the state; moved, its links are those that a run finds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "dem/disks/engine.hpp"
#include "dem/disks/physical_hash.hpp"
#include "dem/files/hand_over.hpp"
#include "dem/input_error.hpp"
#include "dem/solver/solver.hpp"
#include "dem/spheres/engine.hpp"
#include "dem/spheres/physical_hash.hpp"
#include "tests/support/disk_states.hpp"
#include "tests/support/sphere_states.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

template <class System>
State<System> after(State<System> state, std::int64_t steps) {
  Solver<System> solver(state, {});
  solver.run(steps);
  solver.snapshot(state);
  return state;
}

State<Disks> disks() {
  oracle::RandomDisks r;
  r.law = oracle::soft_law(), r.seed = 3;
  return after(oracle::random_state(r), 200);
}
State<Spheres> spheres() { return after(oracle::random_state(oracle::RandomSpheres{.room = 0.6}), 200); }

template <class System>
double squares_of_springs(const State<System>& s) {
  double sum = 0;
  for (const auto& l : s.packing.links)
    if constexpr (System::dimension == 2)
      sum += l.tangential_force * l.tangential_force;
    else
      sum += dot(l.tangential_force, l.tangential_force);
  return sum;
}
template <class System>
std::vector<double> sorted_normal_forces(const State<System>& s) {
  std::vector<double> all;
  for (const auto& l : s.packing.links) all.push_back(l.normal_force);
  std::sort(all.begin(), all.end());
  return all;
}

template <class System>
void expect_back_unchanged(const State<System>& s) {
  ASSERT_GT(s.packing.links.size(), 20u);
  const State<System> given = hand_over<System>(s, s.packing, {true, true, true, true}, "moved");
  EXPECT_EQ(physical_hash(given), physical_hash(s));
  EXPECT_TRUE(given.memory.half_velocity.empty());
  // Found by the law: the same but for the rounding of springs at their limits.
  const State<System> found = hand_over<System>(s, s.packing, {}, "moved");
  EXPECT_EQ(sorted_normal_forces(found), sorted_normal_forces(s));
  ASSERT_GT(squares_of_springs(s), 0);
  EXPECT_NEAR(squares_of_springs(found), squares_of_springs(s), 1e-12 * squares_of_springs(s));
  EXPECT_EQ(found.imposed_stress, s.imposed_stress);
}

TEST(HandOver, UnchangedGrainsGiveTheState) {
  expect_back_unchanged(disks());
  expect_back_unchanged(spheres());
}

// Every grain a whole number of cells away, in another order: the same links, through other images.
template <class System>
void expect_images_followed(const State<System>& s) {
  constexpr int D = System::dimension;
  Packing<D> moved = s.packing;
  Bodies<D>& b = moved.bodies;
  for (std::size_t k = 0; k < b.size(); ++k)
    b.position[k][0] += (static_cast<double>(k % 3) - 1) * moved.cell->length[0];
  const State<System> back = hand_over<System>(s, moved, {}, "moved");
  ASSERT_EQ(back.packing.links.size(), s.packing.links.size());
  const std::vector<double> after_it = sorted_normal_forces(back), before = sorted_normal_forces(s);
  for (std::size_t l = 0; l < before.size(); ++l) EXPECT_NEAR(after_it[l], before[l], 1e-9);
  EXPECT_NEAR(squares_of_springs(back), squares_of_springs(s), 1e-9 * squares_of_springs(s));
}

TEST(HandOver, SpringsFollowGrainsIntoOtherImages) {
  expect_images_followed(disks());
  expect_images_followed(spheres());
}

TEST(HandOver, WhatDoesNotFitIsNamed) {
  const State<Disks> s = disks();
  const auto fault = [&](auto&& change) -> std::string {
    Packing<2> moved = s.packing;
    change(moved);
    try {
      hand_over<Disks>(s, moved, {}, "moved");
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(fault([](Packing<2>& p) {
              for (std::int64_t& id : p.bodies.id) id += 1;
            }),
            "accepted")
      << "all larger by one number";
  EXPECT_THAT(fault([](Packing<2>& p) { p.bodies.id[3] = 4711; }), HasSubstr("a grain of the state is missing"));
  EXPECT_THAT(fault([](Packing<2>& p) { p.bodies.radius[3] *= 1.001; }), HasSubstr("in the state (--from)"));
  EXPECT_THAT(fault([](Packing<2>& p) { p.cell.reset(); }), HasSubstr("moved: cell: the state has one"));
  EXPECT_THAT(fault([](Packing<2>& p) {
                p.bodies.resize(p.bodies.size() + 1);
                p.bodies.id.back() = 4711;
              }),
              HasSubstr("id = 4711: the state has no such grain"));
  State<Spheres> walled = spheres();
  walled.packing.walls.push_back({.point = {{0, 0, -99}}, .normal = {{0, 0, 1}}});
  EXPECT_NO_THROW(hand_over<Spheres>(walled, walled.packing, {}, "moved"));
  EXPECT_THROW(hand_over<Spheres>(walled, walled.packing, {.links = true}, "moved"), InputError);
}

}  // namespace
}  // namespace isostat
