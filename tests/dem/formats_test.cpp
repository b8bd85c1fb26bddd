// Round trips through every readable format, faults of foreign files, and the structure of the ParaView file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "dem/files/atomic_file.hpp"
#include "dem/files/formats/csv.hpp"
#include "dem/files/formats/dump.hpp"
#include "dem/files/formats/vtp.hpp"
#include "dem/files/formats/xyz.hpp"
#include "dem/files/network_file.hpp"
#include "dem/files/packing_file.hpp"
#include "dem/files/state_file.hpp"
#include "dem/input_error.hpp"
#include "tests/oracle/network_oracle.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/vtk_array.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;

template <int D>
Packing<D> with_kinds(Packing<D> p) {
  for (std::size_t l = 0; l < p.links.size(); ++l) p.links[l].kind = static_cast<LinkKind>(l % 5);
  return p;
}

Packing<3> spheres() {
  Packing<3> p;
  p.cell = PeriodicCell<3>{{{3.1, 4.2, 5.3}}};
  p.bodies.resize(3);
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = static_cast<double>(k) + 1.0 / 3;
    p.bodies.id[k] = static_cast<std::int64_t>(k) - 1;
    p.bodies.position[k] = {{x, -x, 2 * x}};
    p.bodies.velocity[k] = {{x / 7, x / 11, -x}};
    p.bodies.spin[k] = {{x / 13, 1, -x}};
    p.bodies.radius[k] = 0.4 + x / 10;
    p.bodies.mass[k] = x, p.bodies.inertia[k] = 0.4 * x * p.bodies.radius[k] * p.bodies.radius[k];
  }
  Link<3> l;
  l.i = 0, l.j = 2, l.shift = {1, -1, 0}, l.gap = -0.1 / 3, l.normal_force = 1.0 / 3;
  l.tangential_force = {{0.1, -0.2, 0.7}}, l.moment = {{1e-3, 2e-17, 0}};
  p.links = {l};
  return p;
}

template <int D>
void expect_same_links(const std::vector<Link<D>>& a, const std::vector<Link<D>>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t l = 0; l < a.size(); ++l) {
    EXPECT_EQ(a[l].i, b[l].i);
    EXPECT_EQ(a[l].j, b[l].j);
    EXPECT_EQ(a[l].shift, b[l].shift);
    EXPECT_EQ(a[l].kind, b[l].kind);
    EXPECT_EQ(a[l].gap, b[l].gap);
    EXPECT_EQ(a[l].normal_force, b[l].normal_force);
    EXPECT_EQ(a[l].tangential_force, b[l].tangential_force);
    EXPECT_EQ(a[l].moment, b[l].moment);
  }
}

template <int D>
void expect_same_motion(const Bodies<D>& a, const Bodies<D>& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.spin, b.spin);
}

// Every double survives: 17 digits are enough.
TEST(Csv, RoundTripIsBitForBit) {
  TemporaryFolder dir;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Packing<2> p = with_kinds(oracle::random_packing(seed, 20, 40, true));
    write_files_atomically({{dir / "p.grains.csv", grains_csv(p)}, {dir / "p.contacts.csv", contacts_csv(p)}});
    PackingReading reading;
    reading.box = {p.cell->length[0], p.cell->length[1]};
    for (const char* name : {"p.csv", "p.grains.csv"}) {
      const PackingFile file = read_packing(dir / name, reading);
      EXPECT_EQ(file.format, PackingFormat::csv);
      EXPECT_TRUE(file.links_given);
      EXPECT_EQ(file.state.packing.cell->length, p.cell->length);
      expect_same_motion(file.state.packing.bodies, p.bodies);
      expect_same_links(file.state.packing.links, p.links);
    }
  }
}

TEST(Csv, RoundTripInSpace) {
  TemporaryFolder dir;
  const Packing<3> p = spheres();
  write_files_atomically({{dir / "p.grains.csv", grains_csv(p)}, {dir / "p.contacts.csv", contacts_csv(p)}});
  PackingReading reading;
  reading.box = {3.1, 4.2, 5.3};
  const PackingFile file = read_packing(dir / "p.csv", reading);
  ASSERT_TRUE(file.packing_3d);
  expect_same_motion(file.packing_3d->bodies, p.bodies);
  expect_same_links(file.packing_3d->links, p.links);
}

TEST(Csv, ColumnsOfTheContract) {
  const Packing<2> p = oracle::random_packing(1, 2, 1, true);
  EXPECT_THAT(grains_csv(p), ::testing::StartsWith("id,x,y,r,vx,vy,omega\n"));
  EXPECT_THAT(contacts_csv(p), ::testing::StartsWith("i,j,s1,s2,kind,h,N,T,M\n"));
  EXPECT_THAT(grains_csv(spheres()), ::testing::StartsWith("id,x,y,z,r,vx,vy,vz,wx,wy,wz\n"));
  EXPECT_THAT(contacts_csv(spheres()), ::testing::StartsWith("i,j,s1,s2,s3,kind,h,N,Tx,Ty,Tz,Mx,My,Mz\n"));
}

TEST(Csv, ForeignGrainsAloneFindTheirContacts) {
  TemporaryFolder dir;
  write_files_atomically({{dir / "g.csv", "r, id, y, x, colour\n0.5,7,0,0.25,red\n0.5,9,0,3.25,blue\n"}});
  EXPECT_TRUE(read_packing(dir / "g.csv").state.packing.links.empty());
  PackingReading reading;
  reading.box = {4, 4};  // periodic: they touch across the edge
  const PackingFile file = read_packing(dir / "g.csv", reading);
  EXPECT_FALSE(file.links_given);
  ASSERT_EQ(file.state.packing.links.size(), 1u);
  EXPECT_EQ(file.state.packing.links[0].shift, (ImageShift<2>{-1, 0}));
  EXPECT_EQ(file.state.packing.bodies.mass, (std::vector<double>{1, 1}));
}

TEST(Csv, ContactsWithoutShiftsMeanTheNearestImage) {
  TemporaryFolder dir;
  write_files_atomically(
      {{dir / "g.grains.csv", "id,x,y,r\n1,0.25,0,0.5\n2,3.25,0,0.5\n"}, {dir / "g.contacts.csv", "i,j\n1,2\n"}});
  PackingReading reading;
  reading.box = {4, 4};
  const Link<2> l = read_packing(dir / "g.csv", reading).state.packing.links.at(0);
  EXPECT_EQ(l.shift, (ImageShift<2>{-1, 0}));
  EXPECT_DOUBLE_EQ(l.gap, 0);
}

std::string faults_of(const std::string& path, const PackingReading& reading = {}) {
  try {
    read_packing(path, reading);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Csv, ListsEveryFaultWithItsLine) {
  TemporaryFolder dir;
  write_files_atomically({{dir / "g.csv", "id,x,y,r\n1,0,0,-1\n1,nan,0,0.5\nq,0,0,0.5\n"}});
  const std::string text = faults_of(dir / "g.csv");
  EXPECT_THAT(text, HasSubstr("g.csv:2: r = -1: must be positive"));
  EXPECT_THAT(text, HasSubstr("g.csv:3: id = 1: ids are distinct; used before in line 2"));
  EXPECT_THAT(text, HasSubstr("g.csv:3: x = nan: must be a finite number"));
  EXPECT_THAT(text, HasSubstr("g.csv:4: id = q: must be an integer"));
  write_files_atomically({{dir / "g.csv", "id,x,y\n1,2\n"}});
  EXPECT_THAT(faults_of(dir / "g.csv"), HasSubstr("g.csv:2: 2 fields"));
  write_files_atomically({{dir / "g.csv", "id,x\n1,2\n"}});
  EXPECT_THAT(faults_of(dir / "g.csv"),
              ::testing::AllOf(HasSubstr("r: column is missing"), HasSubstr("y: column is missing")));
  write_files_atomically(
      {{dir / "g.csv", "id,x,y,r\n1,0,0,1\n"}, {dir / "g.contacts.csv", "i,j,s1,s2,kind\n1,3,0,0,c\n1,1,1,0,q\n"}});
  EXPECT_THAT(faults_of(dir / "g.csv"),
              ::testing::AllOf(HasSubstr("contacts.csv:2: j = 3: is the id of no grain"),
                               HasSubstr("contacts.csv:3: s1 = 1"), HasSubstr("contacts.csv:3: kind = q")));
}

TEST(Dump, RoundTripIsBitForBit) {
  TemporaryFolder dir;
  for (const bool periodic : {true, false}) {
    const Packing<2> p = with_kinds(oracle::random_packing(4, 15, 30, periodic));
    write_files_atomically({{dir / "p.dump", grains_dump(p, 12)}, {dir / "p.contacts.dump", links_dump(p, 12)}});
    const PackingFile file = read_packing(dir / "p.dump");
    EXPECT_EQ(file.format, PackingFormat::dump);
    EXPECT_EQ(file.state.packing.cell.has_value(), periodic);
    if (periodic) {
      EXPECT_EQ(file.state.packing.cell->length, p.cell->length);
    }
    expect_same_motion(file.state.packing.bodies, p.bodies);
    EXPECT_EQ(file.state.packing.bodies.mass, p.bodies.mass);
    EXPECT_EQ(file.state.packing.bodies.inertia, p.bodies.inertia);
    expect_same_links(file.state.packing.links, p.links);
  }
  write_files_atomically(
      {{dir / "s.dump", grains_dump(spheres(), 0)}, {dir / "s.contacts.dump", links_dump(spheres(), 0)}});
  const PackingFile file = read_packing(dir / "s.dump");
  ASSERT_TRUE(file.packing_3d);
  expect_same_motion(file.packing_3d->bodies, spheres().bodies);
  expect_same_links(file.packing_3d->links, spheres().links);
}

constexpr const char* kForeignDump =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y "
    "radius\n5 0 0 1\n"
    "ITEM: TIMESTEP\n10\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n-2 2\n0 8\n-0.5 0.5\n"
    "ITEM: ATOMS id xs ys diameter c_stress\n5 0.5 0.25 1 9\n6 0.75 0.25 0.5 9\n";

TEST(Dump, ReadsTheLastFrameInScaledCoordinates) {
  TemporaryFolder dir;
  write_files_atomically({{dir / "l.dump", kForeignDump}});
  const Packing<2> p = read_packing(dir / "l.dump").state.packing;
  EXPECT_EQ(p.cell->length, (Vec2{{4, 8}}));
  EXPECT_EQ(p.bodies.id, (std::vector<std::int64_t>{5, 6}));
  EXPECT_EQ(p.bodies.position[1], (Vec2{{1, 2}}));
  EXPECT_EQ(p.bodies.radius, (std::vector<double>{0.5, 0.25}));
}

TEST(Dump, RefusesTruncatedTiltedAndForeignText) {
  TemporaryFolder dir;
  const std::string whole = kForeignDump;
  write_files_atomically({{dir / "l.dump", whole.substr(0, whole.find("6 0.75"))}});
  EXPECT_THAT(faults_of(dir / "l.dump"), HasSubstr("1 rows are missing"));
  write_files_atomically({{dir / "l.dump", "ITEM: BOX BOUNDS xy xz yz pp pp pp\n0 4 1\n0 4 1\n0 1 0\n"}});
  EXPECT_THAT(faults_of(dir / "l.dump"), HasSubstr("only xy may tilt a cell"));
  write_files_atomically({{dir / "l.dump", "ITEM: BOX BOUNDS xy pp pp pp\n"}});
  EXPECT_THAT(faults_of(dir / "l.dump"), HasSubstr("'pp pp pp' or 'xy xz yz pp pp pp'"));
  write_files_atomically({{dir / "l.dump", "ITEM: BOX BOUNDS xy xz yz pp pp pp\n0 3 4\n0 4 0\n0 1 0\n"}});
  EXPECT_THAT(faults_of(dir / "l.dump"), HasSubstr("the bounds of x are those of the tilted cell"));
  write_files_atomically(
      {{dir / "l.dump",
        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp ff pp\n0 1\n0 1\n0 1\nITEM: "
        "ATOMS id x y radius\n5 0 0 1\n"}});
  EXPECT_THAT(faults_of(dir / "l.dump"), HasSubstr("periodic along all axes"));
}

// Whatever is cut off or garbled, the answer is a packing or an InputError.
TEST(PackingFile, DamagedTextIsReadOrRefused) {
  TemporaryFolder dir;
  const Packing<2> p = with_kinds(oracle::random_packing(4, 3, 4, true));
  const std::vector<std::pair<std::string, std::string>> files{{"p.grains.csv", grains_csv(p)},
                                                               {"p.contacts.csv", contacts_csv(p)},
                                                               {"p.dump", grains_dump(p, 0)},
                                                               {"p.contacts.dump", links_dump(p, 0)},
                                                               {"p.net", network_text(p)}};
  for (const auto& [name, content] : files) write_files_atomically({{dir / name, content}});
  int refused = 0;
  for (const auto& [name, content] : files) {
    const std::string read = name.ends_with(".csv") ? "p.csv" : name.ends_with(".dump") ? "p.dump" : name;
    for (std::size_t at = 0; at < content.size(); at += 7)
      for (const bool cut : {true, false}) {
        std::string damaged = content.substr(0, at);
        if (!cut) damaged += "9e99" + content.substr(at + 1);
        write_files_atomically({{dir / name, damaged}});
        try {
          read_packing(dir / read);
        } catch (const InputError& error) {
          ++refused;
          EXPECT_FALSE(error.faults().empty());
        }
      }
    write_files_atomically({{dir / name, content}});
  }
  EXPECT_GT(refused, 50);
}

TEST(PackingFile, CellOfOtherUnitsIsRefused) {
  TemporaryFolder dir;
  write_files_atomically({{dir / "g.csv", "id,x,y,r\n1,0,0,1\n"}, {dir / "g.net", "cell 1e-4 1\ngrain 1 0 0 1\n"}});
  PackingReading reading;
  reading.box = {1, 0.09};
  EXPECT_THAT(faults_of(dir / "g.csv", reading), HasSubstr("below 0.1 of the largest radius"));
  reading.box = {1, 0.11};
  EXPECT_EQ(faults_of(dir / "g.csv", reading), "accepted");
  EXPECT_THAT(faults_of(dir / "g.net"),
              HasSubstr("g.net:1: cell.L1 = 0.0001: an edge is below 0.1 of the largest radius"));
  write_files_atomically({{dir / "g.csv", "id,x,y,r\n1,1e9,0,1\n"}});
  EXPECT_THAT(faults_of(dir / "g.csv", reading), HasSubstr("1e8 cells away"));
}

// What can be read can be kept as a state: squares of the lengths are numbers, and the cell has a size.
TEST(PackingFile, LengthsBeyondTheNumbersAreRefused) {
  TemporaryFolder dir;
  const auto faults = [&](const std::string& name, const std::string& text) {
    write_files_atomically({{dir / name, text}});
    return faults_of(dir / name);
  };
  EXPECT_THAT(faults("g.csv", "id,x,y,r\n1,0,0,1e-200\n2,1,0,1e-201\n"),
              HasSubstr("radius = 1e-200: of the largest grain"));
  EXPECT_THAT(faults("g.csv", "id,x,y,z,r\n1,0,0,1,1e-200\n"), HasSubstr("radius = 1e-200: of the largest grain"));
  EXPECT_THAT(faults("g.csv", "id,x,y,r\n1,0,0,1e300\n2,1,0,1e-300\n"), HasSubstr("check the units"));
  EXPECT_THAT(faults("g.net", "cell 1e-150 1e-150\ngrain 1 0 0 1e-200\n"),
              HasSubstr("radius = 1e-200: of the largest grain"));
  const auto box = [](const std::string& edge) {
    return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n" + edge + "\n0 9\n0 9\n" +
           "ITEM: ATOMS id x y radius\n5 1 1 1\n";
  };
  EXPECT_EQ(faults("l.dump", box("0 9")), "accepted");
  EXPECT_THAT(faults("l.dump", box("0 inf")), HasSubstr("finite"));
  EXPECT_THAT(faults("l.dump", box("-1e308 1e308")), HasSubstr("finite"));
}

TEST(PackingFile, IsKnownByItsContent) {
  TemporaryFolder dir;
  write_files_atomically({{dir / "state.csv", std::string("\x89HDF\r\n\x1a\n", 8)},
                          {dir / "net.csv", "# a network\n\ngrain 1 0 0 1\n"},
                          {dir / "dump.net", "ITEM: TIMESTEP\n"},
                          {dir / "grains.txt", "id,x,y,r\n1,0,0,1\n"},
                          {dir / "prose.txt", "Once upon a time\n"},
                          {dir / "empty", ""}});
  EXPECT_EQ(sniff_packing_format(dir / "state.csv"), PackingFormat::state);
  EXPECT_EQ(sniff_packing_format(dir / "net.csv"), PackingFormat::network);
  EXPECT_EQ(sniff_packing_format(dir / "dump.net"), PackingFormat::dump);
  EXPECT_EQ(sniff_packing_format(dir / "grains.txt"), PackingFormat::csv);
  write_files_atomically({{dir / "bytes", std::string("1,2\n\0\1", 6)}, {dir / "prose.h5", "Once upon a time"}});
  EXPECT_THROW(sniff_packing_format(dir / "bytes"), InputError);
  EXPECT_THAT(faults_of(dir / "prose.h5"), HasSubstr("prose.h5"));
  EXPECT_THROW(sniff_packing_format(dir / "prose.txt"), InputError);
  EXPECT_THROW(sniff_packing_format(dir / "empty"), InputError);
  EXPECT_THROW(sniff_packing_format(dir / "missing"), InputError);
}

TEST(PackingFile, StateRoundTrip) {
  TemporaryFolder dir;
  const Packing<2> p = with_kinds(oracle::random_packing(6, 15, 30, true));
  write_state(foreign_state(p), dir / "p.h5");
  const PackingFile file = read_packing(dir / "p.h5");
  EXPECT_EQ(file.format, PackingFormat::state);
  EXPECT_EQ(file.state.law.normal_stiffness, 0);
  EXPECT_EQ(file.state.packing.cell->length, p.cell->length);
  expect_same_motion(file.state.packing.bodies, p.bodies);
  expect_same_links(file.state.packing.links, p.links);
  PackingReading reading;
  reading.box = {4, 4};
  EXPECT_THAT(faults_of(dir / "p.h5", reading), HasSubstr("has its own cell"));
}

TEST(PackingFile, BoxGoesOnlyToWhatHasNone) {
  TemporaryFolder dir;
  write_files_atomically({{dir / "c.net", "cell 4 4\ngrain 1 0 0 1\n"},
                          {dir / "i.net", "grain 1 0.5 0 1\ngrain 2 3.5 0 1\ncontact 1 2 c\n"}});
  PackingReading reading;
  reading.box = {4, 4};
  EXPECT_THAT(faults_of(dir / "c.net", reading), HasSubstr("has its own cell"));
  const Packing<2> p = read_packing(dir / "i.net", reading).state.packing;
  EXPECT_EQ(p.links.at(0).shift, (ImageShift<2>{-1, 0}));
  EXPECT_DOUBLE_EQ(p.links.at(0).gap, -1);
  reading.box = {4, 4, 4};
  EXPECT_THAT(faults_of(dir / "i.net", reading), HasSubstr("needs 2 edges"));
}

TEST(TextOutput, AllFilesOrNone) {
  TemporaryFolder dir;
  EXPECT_THROW(write_files_atomically({{dir / "a", "1"}, {dir / "no/such/b", "2"}}), InputError);
  EXPECT_EQ(dir.entries(), 0u);
  write_files_atomically({{dir / "a", "1"}, {dir / "b", "2"}});
  EXPECT_EQ(dir.entries(), 2u);
}

TEST(Xyz, HasLatticeAndOneRowAGrain) {
  const Packing<2> p = oracle::random_packing(2, 3, 0, true);
  std::istringstream in(extended_xyz(p, 1.5));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "3");
  std::getline(in, line);
  EXPECT_THAT(line, HasSubstr("pbc=\"T T F\" Time=1.5 Properties=species:S:1:pos:R:3:id:I:1:radius:R:1:velo:R:3:"));
  double l1 = 0, l2 = 0, zero = 0;
  ASSERT_EQ(std::sscanf(line.c_str(), "Lattice=\"%lf %lf %lf %lf %lf", &l1, &zero, &zero, &zero, &l2), 5);
  EXPECT_EQ(l1, p.cell->length[0]);
  EXPECT_EQ(l2, p.cell->length[1]);
  for (std::size_t k = 0; k < 3; ++k) {
    std::string species;
    long long id = 0;
    double x = 0, y = 0, z = 1, r = 0;
    ASSERT_TRUE(in >> species >> x >> y >> z >> id >> r);
    EXPECT_EQ(id, p.bodies.id[k]);
    EXPECT_EQ((Vec2{{x, y}}), p.bodies.position[k]);
    EXPECT_EQ(z, 0);
    EXPECT_EQ(r, p.bodies.radius[k]);
    std::getline(in, line);
  }
}

TEST(Vtp, LinesHaveTheLengthAndDirectionOfTheirBranches) {
  const Packing<2> p = with_kinds(oracle::random_packing(8, 12, 40, true));
  const std::string vtp = vtk_polydata(p, 2.5);
  const auto place = oracle::vtk_array<double>(vtp, "Points");
  const auto line = oracle::vtk_array<std::int64_t>(vtp, "connectivity", "<Lines>");
  const auto ends = oracle::vtk_array<std::int64_t>(vtp, "offsets", "<Lines>");
  const auto vertex = oracle::vtk_array<std::int64_t>(vtp, "connectivity", "<Verts>");
  const auto force = oracle::vtk_array<double>(vtp, "N"), radius = oracle::vtk_array<double>(vtp, "radius");
  const auto kind = oracle::vtk_array<std::int8_t>(vtp, "kind");
  EXPECT_EQ(oracle::vtk_array<double>(vtp, "TimeValue", "<FieldData>"), (std::vector<double>{2.5}));
  ASSERT_EQ(vertex.size(), 12u);
  ASSERT_EQ(line.size(), 80u);
  ASSERT_EQ(force.size(), 52u);
  EXPECT_EQ(ends.back(), 80);
  EXPECT_EQ(place.size(), 3 * radius.size());
  EXPECT_THAT(vtp, HasSubstr("NumberOfPoints=\"" + std::to_string(radius.size()) +
                             "\" NumberOfVerts=\"12\" NumberOfLines=\"40\""));
  for (std::size_t l = 0; l < 40; ++l) {
    const auto a = static_cast<std::size_t>(line[2 * l]), b = static_cast<std::size_t>(line[2 * l + 1]);
    const Vec2 branch = p.bodies.position[static_cast<std::size_t>(p.links[l].j)] + p.cell->offset(p.links[l].shift) -
                        p.bodies.position[static_cast<std::size_t>(p.links[l].i)];
    for (std::size_t k : {0u, 1u}) EXPECT_NEAR(place[3 * b + k] - place[3 * a + k], branch[static_cast<int>(k)], 1e-12);
    EXPECT_EQ(radius[b], p.bodies.radius[static_cast<std::size_t>(p.links[l].j)]);
    EXPECT_EQ(force[12 + l], p.links[l].normal_force);
    EXPECT_EQ(kind[12 + l], static_cast<int>(p.links[l].kind));
  }
  for (std::size_t k = 0; k < 12; ++k)
    EXPECT_TRUE(place[3 * k] >= 0 && place[3 * k] < p.cell->length[0] && kind[k] == -1);
}

}  // namespace
}  // namespace isostat
