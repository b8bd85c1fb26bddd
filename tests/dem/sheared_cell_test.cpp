// A cell that shears, from the scene to the file: stages that drive or load it, their ends and restarts, what is
// refused, and the tilt in every format.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem/disks/certificate.hpp"
#include "dem/disks/engine.hpp"
#include "dem/disks/physical_hash.hpp"
#include "dem/disks/sample.hpp"
#include "dem/disks/series.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/files/formats/dump.hpp"
#include "dem/files/formats/xyz.hpp"
#include "dem/files/network_file.hpp"
#include "dem/files/packing_file.hpp"
#include "dem/files/state_file.hpp"
#include "dem/input_error.hpp"
#include "dem/run/stages.hpp"
#include "dem/scene/file.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/link_ends.hpp"
#include "tests/support/disk_states.hpp"
#include "tests/support/shear_restart.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kScene =
    "seed = 3\n[grains]\ncount = 60\nsolid_fraction = 0.5\n[law]\nnormal_stiffness = 1e3\nattraction_range = 0.01\n"
    "[step]\nfraction = 0.12\n[cell]\ninertia = 1.0\n[finish]\nmethod = \"drag\"\ndrag = 1.0\n";

std::string faults(const std::string& text, const std::vector<std::string>& settings = {}) {
  try {
    parse_scene(text, "scene.toml", settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

State<Disks> packed(const std::string& stages) {
  const Scene scene = parse_scene(kScene + stages, "scene.toml", {});
  State<Disks> s = initial_disks(scene, scene.seed);
  const RunOutcome outcome = run_stages(s, {}, {});
  EXPECT_TRUE(outcome.all_met()) << s.progress.unmet;
  return s;
}

TEST(ShearStages, AnIsotropicPackingIsFreeOfShearStressIfItIsAskedFor) {
  const State<Disks> fixed = packed("[[stage]]\npressure = 0.5\n"),
                     freed = packed("[[stage]]\npressure = 0.5\nstress_12 = 0.0\n");
  EXPECT_GT(std::abs(measured_stress(fixed.packing).xy), 5e-3) << "chance leaves it somewhere";
  EXPECT_EQ(fixed.packing.cell->tilt, 0);
  const StressTensor stress = measured_stress(freed.packing);
  EXPECT_NE(freed.packing.cell->tilt, 0);
  EXPECT_LT(std::abs(stress.xy), 1e-4 * freed.certificate.force_scale);
  EXPECT_NEAR(stress.xx, 0.5, 1e-4);
  EXPECT_NEAR(stress.yy, 0.5, 1e-4);
  EXPECT_TRUE(freed.certificate.equilibrated);
  // The certificate judges it.
  ImposedStress<2> imposed = freed.imposed_stress;
  imposed.shear = 0.1;
  const Certificate other = evaluate_certificate(freed.packing, freed.law, imposed, freed.scene.equilibrium);
  EXPECT_NEAR(other.pressure_error * other.force_scale, 0.1, 2e-4);
  EXPECT_FALSE(other.equilibrated);
}

TEST(ShearStages, SimpleShearGoesToItsStrainUnderItsNormalStress) {
  const std::string packing = "[[stage]]\npressure = 0.5\n";
  State<Disks> s = packed(
      packing + "[[stage]]\nshear_rate = 0.05\nstress_2 = 0.5\nstrain_rate_1 = 0\nuntil = \"strain\"\nstrain = 1.2\n");
  EXPECT_GE(s.cell_motion.shear_strain, 1.2);
  EXPECT_LT(s.cell_motion.shear_strain, 1.2 + 0.05 * 250 * s.time_step) << "at the next look";
  EXPECT_EQ(s.packing.cell->length[0], s.cell_motion.reference_length[0]);
  EXPECT_LE(std::abs(s.packing.cell->tilt), 0.5 * s.packing.cell->length[0]);
  EXPECT_NE(s.packing.cell->length[1], s.cell_motion.reference_length[1]);
  EXPECT_LT(measured_stress(s.packing).xy, -0.01) << "it resists";
  EXPECT_NEAR(-s.cell_motion.shear_strain_rate * s.cell_motion.reference_length[1] / s.packing.cell->length[1], 0.05,
              1e-5);
  const State<Disks> kept = packed(packing + "[[stage]]\nshear_rate = -0.05\nuntil = \"strain\"\nstrain = 0.3\n");
  EXPECT_EQ(kept.packing.cell->length, kept.cell_motion.reference_length);
  EXPECT_LT(kept.packing.cell->tilt, 0);
  EXPECT_GT(measured_stress(kept.packing).xy, 0);
  std::string header;
  for (const SeriesColumn& c : series_columns(kept, false)) header += std::string(c.name) + ",";
  EXPECT_THAT(header, HasSubstr("imposed22,imposed12,tilt,shear_strain,shear_rate,inertial_number,"));
}

// A ramp brings the rate of shear linearly, takes it on from the stage before, and is exact through a state file.
TEST(ShearStages, RampsOfShearAreFunctionsOfTime) {
  const std::string text =
      kScene +
      "[[stage]]\npressure = 0.5\nshear_rate = 0.1\nramp_time = 2.0\nuntil = \"time\"\ntime = 3.0\n"
      "[[stage]]\npressure = 0.5\nshear_rate = 0.04\nramp_time = 1.0\nuntil = \"time\"\ntime = 2.0\n";
  const Scene scene = parse_scene(text, "scene.toml", {});
  State<Disks> straight = initial_disks(scene, scene.seed);
  std::vector<std::string> kept;
  RunHooks<Disks> hooks;
  hooks.checkpoint_seconds = 1e-9;
  hooks.checkpoint = [&](const State<Disks>& s) { kept.push_back(encode_state(s)); };
  ASSERT_TRUE(run_stages(straight, {}, hooks).all_met());
  int in_ramp = 0, taken_over = 0;
  for (const std::string& bytes : kept) {
    const State<Disks> s = std::get<State<Disks>>(decode_state(bytes, "kept").state);
    const std::size_t last = s.scene.stages.size() - 1, stage = static_cast<std::size_t>(s.progress.stage);
    if (stage + 1 < last || stage > last || !s.progress.started || !(s.time > s.progress.start_time + s.time_step))
      continue;
    const double since = s.time - s.progress.start_time - s.time_step;
    const double from = stage == last ? 0.1 : 0, to = stage == last ? 0.04 : 0.1, length = stage == last ? 1 : 2;
    const double rate =
        -s.cell_motion.shear_strain_rate * s.cell_motion.reference_length[1] / s.packing.cell->length[1];
    const double expected = to + (from - to) * std::max(0.0, 1 - since / length);
    EXPECT_NEAR(rate, expected, 2e-3 * expected + 1e-4) << "at " << since << " of stage " << stage;
    in_ramp += since < length;
    taken_over += stage == last && since < length;
  }
  EXPECT_GT(in_ramp, 3);
  EXPECT_GT(taken_over, 0);
  State<Disks> s = std::get<State<Disks>>(decode_state(kept[kept.size() / 2], "kept").state);
  run_stages(s, {}, {});
  EXPECT_EQ(encode_state(s), encode_state(straight));
}

// Through a state file amid the shear, after the cell has turned back once.
TEST(ShearStages, RestartAsIfTheyHadRunStraight) {
  const Scene scene = parse_scene(kScene + kShearedAndReleased, "scene.toml", {});
  expect_restarts_as_straight(initial_disks(scene, scene.seed));
}

// The step in which the tilt is lowered is like any other: nothing jumps, springs included.
TEST(ShearedCell, TurnsBackWithoutAnyoneNoticing) {
  oracle::RandomDisks r;
  r.law = oracle::soft_law(), r.law.friction = 5, r.law.rolling_friction = 1, r.speed = 0.1, r.squeeze = 0.85;
  State<Disks> s = oracle::random_state(r);
  CellControl<2> control;
  control.shear_rate = 2;
  Solver solver(s, control);
  const auto sums = [&] {  // of |N|, |T|, |M|, and the number of links
    solver.snapshot(s);
    std::array<double, 4> sum{};
    for (const Link<2>& l : s.packing.links) {
      sum[0] += std::abs(l.normal_force), sum[1] += std::abs(l.tangential_force), sum[2] += std::abs(l.moment);
      sum[3] += 1;
    }
    return sum;
  };
  int turned = 0;
  std::array<double, 4> before = sums(), usual{};
  for (int k = 0; k < 700; ++k) {
    const double tilt = solver.cell()->tilt;
    solver.step();
    const auto now = sums();
    const bool turns = std::abs(solver.cell()->tilt - tilt) > 0.5 * solver.cell()->length[0];
    for (std::size_t n = 0; n < now.size(); ++n) {
      const double jump = std::abs(now[n] - before[n]);
      if (turns) {
        EXPECT_LE(jump, 1.5 * usual[n] + 1e-12) << n;
      } else {
        usual[n] = std::max(usual[n], jump);
      }
    }
    turned += turns;
    before = now;
  }
  EXPECT_GE(turned, 1);
  EXPECT_GT(before[1], 1) << "there were springs to lose";
  EXPECT_LT(usual[1], 0.5 * before[1]) << "and a loss would show";
}

TEST(ShearKeys, ContradictionsAreNamed) {
  EXPECT_THAT(faults(kScene + "[[stage]]\nstress_12 = 0.1\nshear_rate = 0.1\n"),
              AllOf(HasSubstr("stage.0.shear_rate"), HasSubstr("0.1"),
                    HasSubstr("a direction has an imposed stress or a strain rate, not both")));
  EXPECT_THAT(faults(kScene + "[[stage]]\nshear_rate = 0.1\n"),
              AllOf(HasSubstr("stage.0.until"), HasSubstr("a driven cell never comes to rest")));
  EXPECT_THAT(faults(kScene + "[[stage]]\nstress_12 = 0.1\nuntil = \"failure\"\n"),
              AllOf(HasSubstr("stage.0.until"), HasSubstr("needs a strain rate other than 0")));
  EXPECT_THAT(faults("gravity = 1.0\n" + kScene + "[container]\nshape = \"box\"\n[[stage]]\nstress_12 = 0.0\n"),
              AllOf(HasSubstr("stage.0.stress_12"), HasSubstr("a key of the periodic cell")));
  EXPECT_THAT(faults("system = \"triangles\"\n[[stage]]\nshear_rate = 0.1\nuntil = \"time\"\ntime = 1.0\n"),
              AllOf(HasSubstr("shear_rate"), HasSubstr("a key of disks and spheres, and this scene is of triangles")));
  EXPECT_EQ(faults(kScene + "[[stage]]\nshear_rate = 0.1\nuntil = \"failure\"\n"), "");
  EXPECT_EQ(faults(kScene + "[[stage]]\npressure = 1.0\nshear_rate = 0.0\n"), "");
}

State<Disks> tilted_state() {
  oracle::RandomDisks r;
  r.law = oracle::soft_law();
  State<Disks> s = oracle::random_state(r);
  CellControl<2> control;
  control.shear_rate = 3;
  Solver solver(s, control);
  solver.run(60);
  solver.snapshot(s);
  return s;
}

void expect_same(const Packing<2>& a, const Packing<2>& b) {
  ASSERT_TRUE(b.cell);
  EXPECT_EQ(a.cell->length, b.cell->length);
  EXPECT_EQ(a.cell->tilt, b.cell->tilt);
  EXPECT_EQ(a.bodies.position, b.bodies.position);
}

TEST(TiltInFiles, ComesBackFromEveryFormat) {
  const State<Disks> s = tilted_state();
  ASSERT_GT(s.packing.cell->tilt, 0.5);
  const TemporaryFolder folder;
  write_network(folder / "p.net", s.packing);
  const PackingFile network = read_packing(folder / "p.net");
  expect_same(s.packing, network.state.packing);
  ASSERT_EQ(network.state.packing.links.size(), s.packing.links.size());
  for (std::size_t l = 0; l < s.packing.links.size(); ++l)
    EXPECT_NEAR(network.state.packing.links[l].gap, s.packing.links[l].gap, 1e-14);
  write_files_atomically({{folder / "p.dump", grains_dump(s.packing, 7)}});
  const PackingFile dump = read_packing(folder / "p.dump");
  EXPECT_NEAR(dump.state.packing.cell->length[0], s.packing.cell->length[0], 1e-13);
  EXPECT_EQ(dump.state.packing.cell->tilt, s.packing.cell->tilt);
  write_state(s, folder / "p.h5");
  const State<Disks> back = read_state<Disks>(folder / "p.h5");
  expect_same(s.packing, back.packing);
  EXPECT_EQ(encode_state(back), encode_state(s));
  EXPECT_THAT(extended_xyz(s.packing, 0), HasSubstr("Lattice=\""));
  State<Disks> upright = s;
  upright.packing.cell->tilt = 0, upright.cell_motion.shear_strain_rate = 0;
  EXPECT_NE(physical_hash(upright), physical_hash(s));
}

// A file with any tilt starts a run in the shape nearest to a rectangle.
TEST(TiltInFiles, ARunBeginsWithTheLowestTilt) {
  State<Disks> s = tilted_state();
  const double tilt = s.packing.cell->tilt;
  s.packing.cell->tilt += 3 * s.packing.cell->length[0];
  for (Link<2>& l : s.packing.links) l.shift[0] -= 3 * l.shift[1];
  const TemporaryFolder folder;
  write_network(folder / "p.net", s.packing);
  Scene scene = s.scene;
  scene.grains.file = folder / "p.net";
  const State<Disks> begun = initial_disks(scene, 1);
  EXPECT_NEAR(begun.packing.cell->tilt, tilt, 1e-12);
  EXPECT_LT(std::abs(begun.packing.cell->tilt), 0.5 * begun.packing.cell->length[0]);
  ASSERT_EQ(begun.packing.links.size(), s.packing.links.size());
  for (std::size_t l = 0; l < s.packing.links.size(); ++l) {
    const Link<2>& link = begun.packing.links[l];
    const double distance =
        norm(branch(begun.packing, static_cast<std::size_t>(link.i), static_cast<std::size_t>(link.j), link.shift));
    EXPECT_NEAR(distance - begun.packing.bodies.radius[static_cast<std::size_t>(link.i)] -
                    begun.packing.bodies.radius[static_cast<std::size_t>(link.j)],
                s.packing.links[l].gap, 1e-12);
  }
}

std::string network_faults(const std::string& text) {
  const TemporaryFolder folder;
  write_files_atomically({{folder / "p.net", text}});
  try {
    read_packing(folder / "p.net");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TiltInFiles, BadTiltsAreRefused) {
  EXPECT_THAT(network_faults("tilt 1\ngrain 0 0 0 1\n"), AllOf(HasSubstr(":1"), HasSubstr("needs a cell line")));
  EXPECT_THAT(network_faults("cell 4 4\ntilt x\ngrain 0 0 0 1\n"), AllOf(HasSubstr(":2"), HasSubstr("finite number")));
  EXPECT_THAT(network_faults("cell 4 4\ntilt 1\ntilt 1\ngrain 0 0 0 1\n"), HasSubstr("given before in line 2"));
  EXPECT_THAT(network_faults("cell 4 4\ntilt 1 2\ngrain 0 0 0 1\n"), HasSubstr("tilt T"));
  EXPECT_THAT(network_faults("cell 4 4\ntilt 4000\ngrain 0 0 0 1\n"), HasSubstr("at most 100 L1"));
  EXPECT_THAT(network_faults("cell 4 4\ntilt 1\ntriangle 0 0 0 0 1 0 0 1\n"),
              HasSubstr("only one of disks or spheres tilts"));
  EXPECT_EQ(network_faults("tilt 1\ncell 4 4\ngrain 0 0 0 1\n"), "");
}

}  // namespace
}  // namespace isostat
