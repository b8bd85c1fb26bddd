// A state written as text and read back is the state: to the last bit of what its hash covers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "dem/disks/physical_hash.hpp"
#include "dem/disks/sample.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/files/formats/csv.hpp"
#include "dem/files/formats/dump.hpp"
#include "dem/files/formats/packing_header.hpp"
#include "dem/files/network_file.hpp"
#include "dem/files/packing_file.hpp"
#include "dem/input_error.hpp"
#include "dem/spheres/physical_hash.hpp"
#include "tests/support/random_state.hpp"
#include "tests/support/sphere_states.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

template <class System>
void write_texts(const State<System>& s, const TemporaryFolder& dir) {
  const auto& p = s.packing;
  write_files_atomically({{dir / "p.grains.csv", grains_csv(p)},
                          {dir / "p.contacts.csv", contacts_csv(p)},
                          {dir / "p.csv.toml", header_text(s)},
                          {dir / "p.dump", grains_dump(p, s.step)},
                          {dir / "p.contacts.dump", links_dump(p, s.step)},
                          {dir / "p.dump.toml", header_text(s)},
                          {dir / "p.net", commented_header(header_text(s)) + network_text(p)}});
}

TEST(PackingHeader, DisksComeBackToTheSameHash) {
  TemporaryFolder dir;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    State<Disks> s = random_state(seed, 20, 30);
    std::set<std::pair<std::int32_t, std::int32_t>> joined;  // a network has a pair once
    std::erase_if(s.packing.links, [&](const Link<2>& l) { return !joined.insert(std::minmax(l.i, l.j)).second; });
    if (s.packing.cell) s.packing.cell->length = s.packing.cell->length + Vec2{{3, 4}};
    s.packing.part.clear(), s.packing.feet.clear(), s.scene.gravity = 0, s.surroundings = {};
    if (seed % 2 == 0) set_disk_inertia(s.packing.bodies);  // as runs have them, else each its own
    ASSERT_EQ(header_text(s).find("\nmass = ") == std::string::npos, seed % 2 == 0);
    write_texts(s, dir);
    for (const char* name : {"p.csv", "p.grains.csv", "p.dump"}) {
      const State<Disks> back = read_packing(dir / name).state;
      EXPECT_EQ(physical_hash(back), physical_hash(s)) << name << seed;
      EXPECT_EQ(back.imposed_stress, s.imposed_stress);
      EXPECT_EQ(back.step, s.step);
    }
    // A network has no velocities and no forces.
    State<Disks> bare = s;
    for (Vec2& v : bare.packing.bodies.velocity) v = {};
    for (double& w : bare.packing.bodies.spin) w = 0;
    State<Disks> net = read_packing(dir / "p.net").state;
    ASSERT_EQ(net.packing.links.size(), s.packing.links.size());
    for (std::size_t l = 0; l < s.packing.links.size(); ++l) {
      EXPECT_EQ(net.packing.links[l].kind, s.packing.links[l].kind);
      net.packing.links[l] = bare.packing.links[l];
    }
    EXPECT_EQ(physical_hash(net), physical_hash(bare));
  }
}

TEST(PackingHeader, SpheresComeBackToTheSameHash) {
  TemporaryFolder dir;
  for (const SphereLaw& law : oracle::sphere_laws()) {
    State<Spheres> s = oracle::random_state({.count = 20, .law = law, .seed = 5});
    s.time = 3.25, s.imposed_stress[1] = 0.5;
    Link<3> l;
    l.i = 3, l.j = 7, l.kind = LinkKind::sliding, l.gap = -1e-3, l.normal_force = 0.1, l.tangential_force = {{1, 2, 3}};
    s.packing.links = {l};
    write_texts(s, dir);
    for (const char* name : {"p.csv", "p.dump"}) {
      const PackingFile file = read_packing(dir / name);
      ASSERT_TRUE(file.spheres);
      EXPECT_EQ(physical_hash(*file.spheres), physical_hash(s)) << name << oracle::words(law);
      EXPECT_EQ(file.packing_3d->bodies.mass, s.packing.bodies.mass);
    }
    EXPECT_EQ(read_packing(dir / "p.net").spheres->law, law);
  }
}

TEST(PackingHeader, FaultsNameFileLineAndKey) {
  TemporaryFolder dir;
  const auto faults = [&](const std::string& header) -> std::string {
    write_files_atomically({{dir / "g.csv", "x,y,r\n1,1,.5\n"}, {dir / "g.csv.toml", header}});
    try {
      read_packing(dir / "g.csv");
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(faults("system = \"disks\"\ncell = [4, 4]\n"), "accepted");
  EXPECT_EQ(read_packing(dir / "g.csv").state.packing.cell->length, (Vec2{{4, 4}}));
  PackingReading reading;
  reading.box = {5, 5};
  EXPECT_EQ(read_packing(dir / "g.csv", reading).state.packing.cell->length, (Vec2{{5, 5}})) << "--box has the word";
  reading.length = 2;
  EXPECT_THROW(read_packing(dir / "g.csv", reading), InputError);
  EXPECT_THAT(faults("system = \"spheres\"\n"), HasSubstr("g.csv.toml:1: system: must be \"disks\""));
  EXPECT_THAT(faults("system = \"disks\"\nthyme = 1\n"), HasSubstr("g.csv.toml:2: thyme: unknown key"));
  EXPECT_THAT(faults("system = \"disks\"\ncell = [4]\n"), HasSubstr("needs 2 edges"));
  EXPECT_THAT(faults("system = \"disks\"\ncell = [4, true]\n"),
              HasSubstr("g.csv.toml:2: cell: must be a list of numbers"));
  EXPECT_THAT(faults("system = \"disks\"\ncell = [4, -4]\n"), HasSubstr("positive"));
  EXPECT_THAT(faults("system = \"disks\"\ntime = inf\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(faults("system = \"disks\"\n[law]\nfriction = 1\n"), HasSubstr("law.normal_stiffness: is missing"));
  EXPECT_THAT(faults("system = \"disks\"\nmass = [1, 2]\n"), HasSubstr("mass: must be 1 numbers"));
  EXPECT_THAT(faults("system = \"disks\n"), HasSubstr("g.csv.toml:1: not valid TOML"));
  write_files_atomically({{dir / "g.net", "grain 1 0 0 1\n#isostat system = \"disks\"\n#isostat thyme = 1\n"}});
  try {
    read_packing(dir / "g.net");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("g.net:3: thyme: unknown key"));
  }
}

}  // namespace
}  // namespace isostat
