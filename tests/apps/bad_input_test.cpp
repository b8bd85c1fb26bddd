// Bad input to the program: one message that names every fault, exit code 2, nothing written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "dem/files/state_seal.hpp"
#include "tests/apps/program.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;
using BadInput = Program;

TEST_F(BadInput, AllFaultsOfASceneAtOnce) {
  write("scene.toml",
        "[grains]\ncount = 0\nsolid_fraction = 1.9\n[law]\nfrictoin = 0.5\nnormal_stiffness = nan\n[[stage]]\npressure "
        "= -1\n");
  const Outcome o = run("pack " + in_folder("scene.toml") + " -o " + in_folder("state.h5") + " --set law.damping=2");
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.out, "");
  EXPECT_THAT(o.err, HasSubstr("scene.toml:2: grains.count = 0: integer in [1, 1e+09]"));
  EXPECT_THAT(o.err, HasSubstr("scene.toml:3: grains.solid_fraction = 1.9"));
  EXPECT_THAT(o.err, HasSubstr("scene.toml:5: law.frictoin = 0.5: unknown key; did you mean law.friction?"));
  EXPECT_THAT(o.err, HasSubstr("scene.toml:6: law.normal_stiffness = nan"));
  EXPECT_THAT(o.err, HasSubstr("scene.toml:8: stage.0.pressure = -1"));
  EXPECT_THAT(o.err, HasSubstr("--set: law.damping = 2"));
  EXPECT_FALSE(std::filesystem::exists(in_folder("state.h5")));
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
  const std::string scene = " " ISOSTAT_DATA "/scenes/disks-method1.toml --set grains.count=20";
  for (const std::string& path : {in_folder("no/such/folder/state.h5"), std::string("/tmp")}) {
    const Outcome o = run("pack" + scene + " -o " + path);
    EXPECT_EQ(o.code, 2) << path;
    EXPECT_THAT(o.err, HasSubstr(path));
  }
}

// What a format cannot hold is refused, not lost.
TEST_F(BadInput, BeamsWhereTheyHaveNoPlace) {
  const std::string net = "convert " ISOSTAT_DATA "/clusters/beam_bars.net -o ";
  for (const char* name : {"x.h5", "x.csv", "x.dump", "x.xyz"}) {
    const Outcome o = run(net + in_folder(name));
    EXPECT_EQ(o.code, 2) << name;
    EXPECT_THAT(o.err, HasSubstr("beams are kept by .net files only"));
    EXPECT_FALSE(std::filesystem::exists(in_folder(name)));
  }
  ASSERT_EQ(run(net + in_folder("x.vtp")).code, 0);
  ASSERT_EQ(run(net + in_folder("x.net")).code, 0);
  ASSERT_EQ(run("convert " + in_folder("x.net") + " -o " + in_folder("y.net")).code, 0);
  EXPECT_EQ(content(in_folder("x.net")), content(in_folder("y.net")));
}

TEST_F(BadInput, DamagedStates) {
  const std::string whole = in_folder("state.h5");
  ASSERT_EQ(run("convert " ISOSTAT_DATA "/clusters/periodic_square3x3.net -o " + whole).code, 0);
  ASSERT_EQ(run("info " + whole).code, 0);
  const std::string bytes = content(whole);
  const auto refused = [&](const std::string& what, const std::string& damaged, const std::string& reason) {
    write("damaged.h5", damaged);
    for (const std::string command : {"info ", "analyze "}) {
      const Outcome o = run(command + in_folder("damaged.h5"));
      EXPECT_EQ(o.code, 2) << command << what;
      EXPECT_EQ(o.out, "") << command << what;
      EXPECT_THAT(o.err, HasSubstr(reason)) << command << what;
    }
  };
  refused("truncated", bytes.substr(0, bytes.size() / 2), "truncated");
  std::string flipped = bytes;
  flipped[bytes.size() - 100] = static_cast<char>(flipped[bytes.size() - 100] ^ 4);
  refused("flipped", flipped, "damaged");
  std::string later = bytes;
  const std::string present = "format version " + std::to_string(kStateFormatVersion);
  later.replace(later.find(present), present.size(), "format version 9");
  refused("later", later, "this isostat reads format version");
}

// An isolated packing: what needs no cell runs, what needs one says so.
TEST_F(BadInput, WhatNeedsACellIsRefusedWithoutOne) {
  write("pair.net", "grain 1 0 0 .5\ngrain 2 .9995 0 .5\ngrain 3 .5 .8655 .5\n");
  const std::string scene = "[grains]\nfile = \"" + in_folder("pair.net") +
                            "\"\n[law]\nnormal_stiffness = 1e4\n[finish]\nmethod = \"newton\"\n[[stage]]\n";
  write("rest.toml", scene);
  write("press.toml", scene + "pressure = 0.1\n");
  const std::string state = in_folder("state.h5");
  const Outcome pressed = run("pack " + in_folder("press.toml") + " -o " + state);
  EXPECT_EQ(pressed.code, 2);
  EXPECT_THAT(pressed.err, HasSubstr("stage.0.pressure: needs a periodic cell"));
  EXPECT_FALSE(std::filesystem::exists(state));

  ASSERT_EQ(run("pack " + in_folder("rest.toml") + " -o " + state).code, 0);
  for (const char* section : {"counts", "equilibrium", "forces", "rigidity", "clusters", "stiffness", "modes", "bases"})
    EXPECT_EQ(run("analyze " + state + " --only " + section).code, 0) << section;
  for (const char* section : {"stress", "percolation", "moduli", "scattering", "dacf"}) {
    const Outcome o = run("analyze " + state + " --only " + section);
    EXPECT_EQ(o.code, 2) << section;
    EXPECT_THAT(o.err, HasSubstr("needs a periodic cell")) << section;
  }
  EXPECT_EQ(run("analyze " + state + " --cell free").code, 2);
  EXPECT_EQ(run("lab throughput " + in_folder("pair.net") + " --steps 2").code, 0);
  EXPECT_EQ(run("lab throughput " + in_folder("pair.net") + " --steps 2 --cell free").code, 2);
}

}  // namespace
}  // namespace isostat
