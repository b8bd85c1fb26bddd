// Tables of grains and contacts as other programs write them: separators, names, units, forces as vectors, LAMMPS.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem/files/atomic_file.hpp"
#include "dem/files/formats/csv.hpp"
#include "dem/files/formats/real_text.hpp"
#include "dem/files/packing_file.hpp"
#include "dem/input_error.hpp"
#include "dem/state/link_ends.hpp"
#include "tests/oracle/network_oracle.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ForeignTables : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    write_files_atomically({{folder_ / name, text}});
    return folder_ / name;
  }
  Bodies<2> grains(const std::string& text) const {
    return read_packing(write("g.txt", text), reading_).state.packing.bodies;
  }
  std::string faults(const std::string& text) const { return faults_of(write("g.txt", text)); }
  std::string faults_of(const std::string& path) const {
    try {
      read_packing(path, reading_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  TemporaryFolder folder_;
  PackingReading reading_;
};

const std::vector<Vec2> kPlaces{{{0.5, 1}}, {{2, 3.25}}};
const std::vector<double> kRadii{0.25, 0.5};

// The same two grains, however they are written.
TEST_F(ForeignTables, SeparatorsNamesAndHeadersOfOtherPrograms) {
  for (const char* text : {
           "x,y,r\n.5,1,.25\n2,3.25,.5\n",                           // no ids
           "ID;X;Y;Radius\n1;.5;1;.25\n2;2;3.25;.5\n",               // capitals, semicolons
           "ID;X;Y;D\n1;0,5;1;0,5\n2;2;3,25;1\n",                    // decimal commas, diameters
           "id\tx\ty\tdiameter\n1\t.5\t1\t.5\n2\t2\t3.25\t1\n",      // tabs
           "  x   y    r\n .5  1   .25\n  2  3.25 .5\n\n",           // aligned with blanks
           "x\t\ty\tr\n.5\t\t1\t.25\n2\t\t3.25\t.5\n",               // aligned with tabs
           "# made by a script\n# x y r\n0.5 1 0.25\n2 3.25 0.5\n",  // numpy.savetxt(header=...)
           "#format x_y_z_r\n0.5\t1\t0\t0.25\n2\t3.25\t0\t0.5\n",    // YADE, export.text
           "#format id_x_y_z_r_matId\n1\t0.5\t1\t0\t0.25\t0\n2\t2\t3.25\t0\t0.5\t0\n",
           "#format x_y_z_r_attrs\n# mass\n.5 1 0 .25 7\n2 3.25 0 .5 8\n",
           "\xef\xbb\xbf\"\",\"x\",\"y\",\"r\"\r\n\"1\",.5,1,.25\r\n\"2\",2,3.25,.5\r\n",  // R, Excel
           "Label, X [px], Y [px], Radius (px)\n1, .5, 1, .25\n2, 2, 3.25, .5\n",
       }) {
    const Bodies<2> b = grains(text);
    EXPECT_EQ(b.id, (std::vector<std::int64_t>{1, 2})) << text;
    EXPECT_EQ(b.position, kPlaces) << text;
    EXPECT_EQ(b.radius, kRadii) << text;
  }
  EXPECT_EQ(grains("#format x_y_z_r_attrs\n# mass\n.5 1 0 .25 7\n2 3.25 0 .5 8\n").mass, (std::vector<double>{7, 8}));
  EXPECT_TRUE(read_packing(write("s.txt", "#format x_y_z_r\n0\t0\t1\t1\n")).packing_3d);
}

TEST_F(ForeignTables, ColumnsAreNamedByTheUser) {
  reading_.columns = parse_column_names("x=col,y=row,d=size");
  const Bodies<2> b = grains("row,col,r,Size\n1,.5,99,.5\n3.25,2,99,1\n");
  EXPECT_EQ(b.position, kPlaces);
  EXPECT_EQ(b.radius, kRadii);
  EXPECT_THAT(faults("row,COL,x\n1,2,3\n"),
              HasSubstr("--columns = d=size: the table has no such column; it has row, COL, x"));
  reading_.columns = parse_column_names("x=2,y=3,r=4,id=1");
  EXPECT_EQ(grains("7 .5 1 .25\n8 2 3.25 .5\n").id, (std::vector<std::int64_t>{7, 8}));
  reading_.columns = parse_column_names("x=a,y=b,r=c");
  EXPECT_EQ(grains("a b c\n.5 1 .25\n2 3.25 .5\n").position, kPlaces) << "split at blanks";
  reading_.columns = parse_column_names("x=a,y=b,r=c,fx=f");
  EXPECT_THAT(faults("a b c\n.5 1 .25\n"), HasSubstr("--columns = fx=f: is a column of contacts, and there are none"));
  for (const auto& [option, rule] :
       std::initializer_list<std::pair<const char*, const char*>>{{"x", "is OURS=THEIRS"},
                                                                  {"x=", "is OURS=THEIRS"},
                                                                  {"=x", "is OURS=THEIRS"},
                                                                  {"", "is OURS=THEIRS"},
                                                                  {"x=a,", "is OURS=THEIRS"},
                                                                  {"q=a", "q is none of the columns"},
                                                                  {"x=a,x=b", "x is named twice"}})
    try {
      parse_column_names(option);
      ADD_FAILURE() << option;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(rule)) << option;
    }
}

TEST_F(ForeignTables, WhatIsNotUnderstoodIsToldWhatATableNeeds) {
  EXPECT_THAT(faults("a;b;c\n1;2;3\n"),
              AllOf(HasSubstr("g.txt:1: x: column is missing: a table of grains needs x, y and r (or d, the diameter); "
                              "this one has a, b, c, of which convert --columns x=... says which is meant"),
                    HasSubstr("g.txt:1: r: column is missing")));
  EXPECT_THAT(faults("1 2 3\n"), HasSubstr("this one has 1, 2, 3"));
  EXPECT_THAT(faults("Once upon a time\n"), HasSubstr("such a table begins with the names of its columns, x, y and r"));
  EXPECT_THAT(faults("x,y,r\n\n# a remark\n1,2,3\n1,2\n1,2,q\n"), HasSubstr("g.txt:5: 2 fields"));
  EXPECT_THAT(faults("x,y,r\n\n# a remark\n1,2,3\n1,2,q\n"), HasSubstr("g.txt:5: r = q: must be a finite number"));
  reading_.contacts = write("c.txt", "particle1,particle2,Fn\n1,2,3\n");
  EXPECT_THAT(faults("x,y,r\n0,0,1\n2,0,1\n"), HasSubstr("c.txt:1: Fn: is a force that is not understood"));
  reading_.columns = parse_column_names("N=Fn");
  EXPECT_EQ(read_packing(write("g.txt", "x,y,r\n0,0,1\n2,0,1\n"), reading_).state.packing.links.at(0).normal_force, 3);
  reading_.columns.clear();
  reading_.contacts = write("c.txt", "from,to,fn\n1,2,3\n");
  EXPECT_THAT(faults("x,y,r\n0,0,1\n2,0,1\n"),
              HasSubstr("c.txt:1: i: column is missing: a table of contacts needs i and j"));
  for (const auto& [table, rule] : std::initializer_list<std::pair<const char*, const char*>>{
           {"i,j,fx\n1,2,3\n", "a force is given whole: fx, fy"},
           {"i,j,fx,fy,N\n1,2,3,4,5\n", "as N and T, or as fx and fy, not both"},
           {"i,j,s1\n1,2,0\n", "image shifts have a number for each axis"}}) {
    reading_.contacts = write("c.txt", table);
    EXPECT_THAT(faults("x,y,r\n0,0,1\n2,0,1\n"), HasSubstr(rule));
  }
}

TEST_F(ForeignTables, LengthsAndForcesInUnitsOfTheUser) {
  const std::string grains = "x,y,r,vx,vy,omega\n0,0,10,20,0,3\n58,0,20,0,0,0\n";
  const std::string path = write("g.grains.csv", grains);
  write("g.contacts.csv", "i,j,h,N,T,M\n1,2,-2,6,3,80\n");
  reading_.length = 40, reading_.force = 2, reading_.box = {60, 120};
  const Packing<2> p = read_packing(path, reading_).state.packing;
  EXPECT_EQ(p.cell->length, (Vec2{{1.5, 3}}));
  EXPECT_EQ(p.bodies.radius, (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(p.bodies.position[1], (Vec2{{1.45, 0}}));
  EXPECT_EQ(p.bodies.velocity[0], (Vec2{{0.5, 0}}));
  EXPECT_EQ(p.bodies.spin[0], 3);
  EXPECT_EQ(p.bodies.mass, (std::vector<double>{0.25, 1}));
  EXPECT_EQ(p.bodies.inertia[1], 0.125);
  const Link<2> l = p.links.at(0);
  EXPECT_EQ(l.shift, (ImageShift<2>{-1, 0}));
  EXPECT_EQ((std::vector<double>{l.gap, l.normal_force, l.tangential_force, l.moment}),
            (std::vector<double>{-0.05, 3, 1.5, 1}));
}

// Random N and T as the vectors that act on j come back as N and T.
TEST_F(ForeignTables, VectorForcesAreSplitAlongTheBranchOfTheImage) {
  const Packing<2> p = oracle::random_packing(3, 12, 20, true);
  std::string links = "i,j,s1,s2,fx,fy,M\n";
  for (const Link<2>& l : p.links) {
    const Vec2 r = branch(p, static_cast<std::size_t>(l.i), static_cast<std::size_t>(l.j), l.shift);
    const Vec2 n = r / norm(r), f = l.normal_force * n + l.tangential_force * Vec2{{-n[1], n[0]}};
    links += std::to_string(p.bodies.id[static_cast<std::size_t>(l.i)]) + "," +
             std::to_string(p.bodies.id[static_cast<std::size_t>(l.j)]);
    for (const int s : l.shift) links += "," + std::to_string(s);
    for (const double x : {f[0], f[1], l.moment}) links += ",", append_real(links, x);
    links += "\n";
  }
  const std::string path = write("p.grains.csv", grains_csv(p));
  write("p.contacts.csv", links);
  reading_.box = {p.cell->length[0], p.cell->length[1]};
  const Packing<2> q = read_packing(path, reading_).state.packing;
  ASSERT_EQ(q.links.size(), p.links.size());
  for (std::size_t l = 0; l < p.links.size(); ++l) {
    EXPECT_NEAR(q.links[l].normal_force, p.links[l].normal_force, 1e-12);
    EXPECT_NEAR(q.links[l].tangential_force, p.links[l].tangential_force, 1e-12);
    EXPECT_EQ(q.links[l].moment, p.links[l].moment);
  }
}

TEST_F(ForeignTables, VectorForcesInSpaceAndTheirTangentialPartApart) {
  const std::string path = write("g.csv", "id,x,y,z,r\n1,0,0,0,1\n2,0,3.9,0.001,1\n");
  reading_.box = {9, 5.8, 9};
  reading_.contacts = write("c.csv", "id1,id2,fx,fy,fz,Tx,Ty,Tz\n1,2,0,-5,0,.5,0,2\n");
  const Packing<3> p = *read_packing(path, reading_).packing_3d;
  const Link<3> l = p.links.at(0);
  EXPECT_EQ(l.shift, (ImageShift<3>{0, -1, 0}));
  EXPECT_NEAR(l.normal_force, 5, 2e-3) << "pushes j, which is below i through the boundary";
  EXPECT_NEAR(l.tangential_force[0], 0.5, 1e-15);
  EXPECT_NEAR(l.tangential_force[2], 2, 5e-3);
  const Vec3 r = branch(p, 0, 1, l.shift), total = l.normal_force * (1 / norm(r)) * r + l.tangential_force;
  EXPECT_NEAR(norm(total - Vec3{{0.5, -5, 2}}), 0, 1e-12);
  EXPECT_NEAR(dot(l.tangential_force, r), 0, 1e-12);
}

std::string lammps(const std::string& box, const std::string& items, const std::string& rows, int count,
                   const std::string& step = "100") {
  return "ITEM: UNITS\nlj\nITEM: TIME\n0.5\nITEM: TIMESTEP\n" + step + "\nITEM: NUMBER OF " +
         (items.starts_with("ATOMS") ? "ATOMS" : "ENTRIES") + "\n" + std::to_string(count) + "\nITEM: BOX BOUNDS " +
         box + "\nITEM: " + items + " \n" + rows;
}

TEST_F(ForeignTables, DumpLocalGivesTheContactsOfADump) {
  const std::string box = "pp pp pp\n0 4\n0 8\n-.5 .5";
  const std::string dump = write("l.dump", lammps(box, "ATOMS id type x y radius", "9 1 3.9 1 .5 \n4 1 .8 1 .5 \n", 2));
  reading_.contacts = write("l.local", lammps(box, "ENTRIES index c_1[1] c_1[2] c_2[1] c_2[2]", "1 9 4 7 -2 \n", 1));
  reading_.columns = parse_column_names("i=c_1[1],j=c_1[2],fx=c_2[1],fy=c_2[2]");
  const PackingFile file = read_packing(dump, reading_);
  EXPECT_TRUE(file.links_given);
  const Link<2> l = file.state.packing.links.at(0);
  EXPECT_EQ(l.shift, (ImageShift<2>{1, 0}));
  EXPECT_DOUBLE_EQ(l.normal_force, 7);
  EXPECT_DOUBLE_EQ(l.tangential_force, -2);
  EXPECT_NEAR(l.gap, -0.1, 1e-12);
  reading_.contacts = write("late.local", lammps(box, "ENTRIES c_1[1] c_1[2] c_2[1] c_2[2]", "9 4 7 -2\n", 1, "200"));
  EXPECT_THAT(faults_of(dump),
              HasSubstr("late.local: TIMESTEP = 200: is the last frame of the contacts; that of the grains is 100"));
}

// data/foreign: what LAMMPS wrote of disks at rest, normal and tangential parts of the forces apart.
TEST_F(ForeignTables, ForcesOfLammpsBalance) {
  const std::string lammps = ISOSTAT_DATA "/foreign/disks";
  const auto imbalance = [&](const char* columns) {
    reading_.columns = parse_column_names(columns);
    reading_.contacts = lammps + ".local";
    const Packing<2> p = read_packing(lammps + ".dump", reading_).state.packing;
    EXPECT_EQ(p.bodies.size(), 60u);
    EXPECT_GT(p.links.size(), 100u);
    std::vector<Vec2> net(p.bodies.size());
    double worst = 0, mean = 0;
    for (const Link<2>& l : p.links) {
      const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
      const Vec2 r = branch(p, i, j, l.shift), n = r / norm(r);
      const Vec2 f = l.normal_force * n + l.tangential_force * Vec2{{-n[1], n[0]}};
      net[i] -= f, net[j] += f;
      mean += l.normal_force / static_cast<double>(p.links.size());
      EXPECT_LT(l.gap, 0);
    }
    for (const Vec2& f : net) worst = std::max(worst, norm(f));
    EXPECT_GT(std::abs(mean), 10);
    return worst / mean;
  };
  EXPECT_NEAR(imbalance("i=c_id[2],j=c_id[1],fx=c_f[1],fy=c_f[2],Tx=c_f[4],Ty=c_f[5]"), 0, 1e-12);
  EXPECT_LT(imbalance("i=c_id[1],j=c_id[2],fx=c_f[1],fy=c_f[2],Tx=c_f[4],Ty=c_f[5]"), 0)
      << "LAMMPS gives the force on its first";
  EXPECT_GT(imbalance("i=c_id[2],j=c_id[1],fx=c_f[1],fy=c_f[2]"), 0.1) << "without the tangential part";
}

TEST_F(ForeignTables, BoundsOfALammpsBox) {
  const auto read = [&](const std::string& box) { return faults(lammps(box, "ATOMS id x y radius", "1 1 1 .5\n", 1)); };
  EXPECT_EQ(read("pp pp pp\n0 4\n0 8\n0 1"), "accepted");
  EXPECT_EQ(read("xy xz yz pp pp pp\n0 4 0\n0 8 0.0e+00\n0 1 0"), "accepted");
  EXPECT_EQ(read("xy xz yz pp pp pp\n0 4 .5\n0 8 0\n0 1 0"), "accepted");
  EXPECT_THAT(read("xy xz yz pp pp pp\n0 4 0\n0 8 .5\n0 1 0"), HasSubstr("only xy may tilt a cell"));
  EXPECT_THAT(read("xy xz yz pp pp pp\n0 4\n0 8\n0 1"), HasSubstr("must be two numbers and a tilt"));
  EXPECT_THAT(read("abc origin pp pp pp\n4 0 0 0\n0 8 0 0\n0 0 1 0"), HasSubstr("general edges"));
  EXPECT_THAT(read("pp pp pp\n0 4 1\n0 8\n0 1"), HasSubstr("must be two numbers"));
}

}  // namespace
}  // namespace isostat
