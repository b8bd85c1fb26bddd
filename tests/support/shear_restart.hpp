// Stages that shear the cell until it has turned back at least once, from state files kept amid the run.
#pragma once
#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "dem/files/state_file.hpp"
#include "dem/run/stages.hpp"

namespace isostat {

inline const std::string kShearedAndReleased =
    "[[stage]]\npressure = 0.5\nshear_rate = 0.1\nuntil = \"strain\"\nstrain = 1.5\n"
    "[[stage]]\npressure = 0.5\nstress_12 = 0.0\nuntil = \"time\"\ntime = 0.5\n";

// straight: the state before the first stage.
template <class System>
void expect_restarts_as_straight(State<System> straight) {
  std::vector<std::string> kept;
  RunHooks<System> hooks;
  hooks.checkpoint_seconds = 1e-9;
  hooks.checkpoint = [&](const State<System>& s) {
    if (kept.size() < 400) kept.push_back(encode_state(s));
  };
  ASSERT_TRUE(run_stages(straight, {}, hooks).all_met());
  ASSERT_GT(kept.size(), 10u);
  bool turned = false;
  for (const std::size_t cut : {kept.size() / 3, kept.size() / 2, kept.size() - 1}) {
    State<System> s = std::get<State<System>>(decode_state(kept[cut], "kept").state);
    turned = turned || s.cell_motion.shear_strain * s.packing.cell->length[1] > s.packing.cell->tilt + 1;
    run_stages(s, {}, {});
    EXPECT_EQ(physical_hash(s), physical_hash(straight)) << "cut " << cut;
    EXPECT_EQ(encode_state(s), encode_state(straight));
  }
  EXPECT_TRUE(turned);
}

}  // namespace isostat
