// A packing put back into its state unchanged is the state; moved, its links are those that a run finds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
void expect_back_unchanged(const State<System>& s) {
  ASSERT_GT(s.packing.links.size(), 20u);
  const MovedGrains none, all{true, true, true};
  for (const MovedGrains& brings : {none, all}) {
    const State<System> back = hand_over<System>(s, s.packing, brings, "moved");
    EXPECT_EQ(physical_hash(back), physical_hash(s)) << brings.links;
    EXPECT_TRUE(back.memory.half_velocity.empty());
  }
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
  double springs = 0, before = 0;
  for (const Link<D>& l : back.packing.links) springs += l.normal_force;
  for (const Link<D>& l : s.packing.links) before += l.normal_force;
  EXPECT_NEAR(springs, before, 1e-6 * std::abs(before) + 1e-6);
  const auto moments = [](const State<System>& state) {
    double sum = 0;
    for (const Link<D>& l : state.packing.links)
      if constexpr (D == 2)
        sum += l.tangential_force * l.tangential_force;
      else
        sum += dot(l.tangential_force, l.tangential_force);
    return sum;
  };
  EXPECT_GT(moments(s), 0);
  EXPECT_NEAR(moments(back), moments(s), 1e-6 * moments(s));
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
