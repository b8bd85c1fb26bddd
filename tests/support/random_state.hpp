// States with every member set to something, no physics in them, and their comparison member by member.
#pragma once
#include <cstdint>

#include "dem/disks/disks.hpp"

namespace isostat {

State<Disks> random_state(std::uint64_t seed, int grains, int links);

// GoogleTest failures that name the members that differ.
void expect_equal(const State<Disks>& a, const State<Disks>& b);

}  // namespace isostat
