// convert from outside: a state through text and back, to another engine and back, films.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "dem/files/state_file.hpp"
#include "tests/apps/program.hpp"
#include "tests/support/skip.hpp"
#include "tests/support/triangle_states.hpp"

namespace isostat {
namespace {

using Json = nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Convert : public Program {
 protected:
  std::string file(const std::string& name) const { return " " + in_folder(name) + " "; }
  // Disks on their way into compression, at three instants, and at the end.
  void SetUp() override {
    write("s.toml", quick_scene(60));
    ASSERT_EQ(run("pack" + file("s.toml") + "-o" + file("s.h5") + "--set output.snapshot_times=[1.5,3.0,4.5]").code, 0);
    ASSERT_TRUE(exists("s.snapshot0003.h5"));
    ASSERT_FALSE(exists("s.snapshot0004.h5"));
  }
  void convert(const std::string& arguments, int code = 0) const {
    const Outcome o = run("convert" + arguments);
    ASSERT_EQ(o.code, code) << arguments << o.err;
  }
  std::string hash(const std::string& name) const { return read_state_file(in_folder(name)).hash; }
  Json report(const std::string& name, const std::string& sections) const {
    const Outcome o = run("analyze" + file(name) + "--only " + sections + " --json -");
    EXPECT_EQ(o.code, 0) << o.err;
    Json json = o.code == 0 ? Json::parse(o.out) : Json();
    json.erase("inputs");
    for (const char* of_the_run : {"inertial_number", "stress_error"})  // the certificate is not kept by texts
      if (json.contains("equilibrium")) json["equilibrium"].erase(of_the_run);
    return json;
  }
};

TEST_F(Convert, TextKeepsWhatAStateIs) {
  const std::string sections = "counts,equilibrium,stress,rigidity,clusters,stiffness,moduli";
  const Json before = report("s.h5", sections);
  ASSERT_EQ(before["rigidity"]["law"], "rolling");
  for (const char* text : {"t.csv", "t.dump"}) {
    convert(file("s.h5") + "-o" + file(text));
    convert(file(text) + "-o" + file("t.h5"));
    EXPECT_EQ(hash("t.h5"), hash("s.h5")) << text;
    EXPECT_EQ(report("t.h5", sections), before) << text;
    EXPECT_EQ(report(text, sections), before) << text;
  }
  convert(file("s.h5") + "-o" + file("t.net"));
  EXPECT_EQ(report("t.net", "counts,rigidity,clusters"), report("s.h5", "counts,rigidity,clusters"));
  EXPECT_EQ(content(in_folder("t.grains.csv")).substr(0, 21), "id,x,y,r,vx,vy,omega\n");
}

// A cell that leans: through each text, and into another state.
TEST_F(Convert, TextKeepsTheTilt) {
  write("shear.toml", quick_scene(60) + "[[stage]]\nshear_rate = 0.05\nuntil = \"strain\"\nstrain = 0.3\n");
  ASSERT_EQ(run("pack" + file("shear.toml") + "-o" + file("leans.h5")).code, 0);
  const double tilt = read_state<Disks>(in_folder("leans.h5")).packing.cell->tilt;
  ASSERT_GT(tilt, 1);
  const std::string sections = "counts,equilibrium,stress,rigidity,moduli,pores";
  const Json before = report("leans.h5", sections);
  for (const char* text : {"l.csv", "l.dump"}) {
    convert(file("leans.h5") + "-o" + file(text));
    convert(file(text) + "-o" + file("l.h5"));
    EXPECT_EQ(hash("l.h5"), hash("leans.h5")) << text;
    EXPECT_EQ(report(text, sections), before) << text;
    convert(file(text) + "--from" + file("leans.h5") + "-o" + file("back.h5"));
    EXPECT_EQ(hash("back.h5"), hash("leans.h5")) << text;
  }
  convert(file("leans.h5") + "-o" + file("l.net"));
  EXPECT_EQ(report("l.net", "counts,rigidity,pores"), report("leans.h5", "counts,rigidity,pores"));
  convert(file("l.csv") + "--length 2 -o" + file("half.h5"), 2);  // it has its law, and so its units
}

TEST_F(Convert, ThereAndBackAgain) {
  for (const std::string text : {"t.dump", "t.csv"}) {
    convert(file("s.snapshot0003.h5") + "-o" + file(text));
    convert(file(text) + "--from" + file("s.snapshot0003.h5") + "-o" + file("back.h5"));
    EXPECT_EQ(hash("back.h5"), hash("s.snapshot0003.h5")) << text;
    // Without the contacts they are found by the law, with the springs that the state has.
    std::filesystem::remove(in_folder("t.contacts" + text.substr(1)));
    convert(file(text) + "--from" + file("s.snapshot0003.h5") + "-o" + file("found.h5"));
    EXPECT_EQ(report("found.h5", "counts"), report("s.snapshot0003.h5", "counts")) << text;
    EXPECT_NEAR(report("found.h5", "stress")["stress"]["tensor"][0][1].get<double>(),
                report("s.snapshot0003.h5", "stress")["stress"]["tensor"][0][1].get<double>(), 1e-12);
  }
  // LAMMPS takes no grain 0.
  convert(file("s.snapshot0003.h5") + "--first-id 1 -o" + file("one.dump"));
  convert(file("one.dump") + "-o" + file("one.h5"));
  const auto ids = read_state<Disks>(in_folder("one.h5")).packing.bodies.id;
  EXPECT_EQ(*std::min_element(ids.begin(), ids.end()), 1);
  convert(file("one.dump") + "--from" + file("s.snapshot0003.h5") + "-o" + file("back.h5"));
  EXPECT_EQ(hash("back.h5"), hash("s.snapshot0003.h5"));
  // The run goes on from it.
  convert(file("t.csv") + "--from" + file("s.snapshot0003.h5") + "-o" + file("on.h5.partial"));
  ASSERT_EQ(
      run("pack" + file("s.toml") + "-o" + file("on.h5") + "--resume --set output.snapshot_times=[1.5,3.0,4.5]").code,
      0);
  const auto on = read_state<Disks>(in_folder("on.h5")), straight = read_state<Disks>(in_folder("s.h5"));
  EXPECT_NEAR(on.time, straight.time, 1e-9);
  EXPECT_EQ(on.scene, straight.scene);
}

TEST_F(Convert, AnotherEngineMovesGrainsOfAState) {
  // Wrapped into the cell, in another order, numbered from 1, without radii and spins: everything else is the state's.
  const auto s = read_state<Disks>(in_folder("s.snapshot0003.h5"));
  const Bodies<2>& b = s.packing.bodies;
  std::string table = "id vx y x vy\n";
  for (std::size_t k = b.size(); k-- > 0;) {
    const Vec2 r = s.packing.cell->wrap(b.position[k] + Vec2{{1e-6, 0}});
    char row[200];
    std::snprintf(row, sizeof row, "%lld %.17g %.17g %.17g %.17g\n", static_cast<long long>(b.id[k] + 1),
                  -b.velocity[k][0], r[1], r[0], b.velocity[k][1]);
    table += row;
  }
  write("moved.txt", table);
  convert(file("moved.txt") + "--from" + file("s.snapshot0003.h5") + "-o" + file("moved.h5"));
  const auto m = read_state<Disks>(in_folder("moved.h5"));
  EXPECT_EQ(m.packing.cell->length, s.packing.cell->length);
  EXPECT_EQ(m.time, s.time);
  EXPECT_EQ(m.packing.links.size(), s.packing.links.size()) << "the shift of all by 1e-6 changes no contact";
  std::map<std::int64_t, std::size_t> place;
  for (std::size_t k = 0; k < m.packing.bodies.size(); ++k) place[m.packing.bodies.id[k]] = k;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const std::size_t q = place.at(b.id[k]);
    EXPECT_EQ(m.packing.bodies.velocity[q], (Vec2{{-b.velocity[k][0], b.velocity[k][1]}}));
    EXPECT_EQ(m.packing.bodies.spin[q], b.spin[k]);
    EXPECT_EQ(m.packing.bodies.radius[q], b.radius[k]);
  }
  // Springs stay on their pairs through the wrapping.
  const auto springs = [](const State<Disks>& state) {
    std::multiset<long long> all;
    for (const Link<2>& l : state.packing.links)
      if (is_contact(l.kind)) all.insert(std::llround(1e6 * std::abs(l.tangential_force)));
    return all;
  };
  EXPECT_EQ(springs(m), springs(s));
  EXPECT_GT(*springs(s).rbegin(), 0);
}

TEST_F(Convert, FilmsAreReadByTheirFormats) {
  if (std::system("python3 -c '' 2>/dev/null") != 0) ISOSTAT_SKIP("no python3");
  const std::string inputs = file("s.snapshot0001.h5") + file("s.snapshot0002.h5") + file("s.h5");
  std::vector<State<Disks>> frames;
  for (const char* name : {"s.snapshot0001.h5", "s.snapshot0002.h5", "s.h5"})
    frames.push_back(read_state<Disks>(in_folder(name)));
  for (const std::string film : {"f.xyz", "f.dump", "f.pvd"}) {
    convert(inputs + "-o" + file(film));
    const std::string out = in_folder("frames.txt");
    const std::string script = std::filesystem::path(ISOSTAT_DATA).parent_path() / "tests/apps/read_film.py";
    ASSERT_EQ(std::system(("python3 " + script + file(film) + ">" + out).c_str()), 0) << film;
    std::istringstream lines(content(out));
    std::string line;
    std::size_t count = 0;
    for (; std::getline(lines, line); ++count) {
      ASSERT_LT(count, frames.size());
      const State<Disks>& s = frames[count];
      std::istringstream numbers(line);
      double time = 0, id = 0, x = 0, y = 0, r = 0;
      numbers >> time;
      EXPECT_EQ(time, film == "f.dump" ? static_cast<double>(s.step) : s.time) << film;
      for (std::size_t k = 0; k < s.packing.bodies.size(); ++k) {
        ASSERT_TRUE(numbers >> id >> x >> y >> r) << film;
        const Vec2 place = s.packing.bodies.position[k];
        EXPECT_EQ(id, static_cast<double>(s.packing.bodies.id[k]));
        EXPECT_EQ((Vec2{{x, y}}), film == "f.pvd" ? s.packing.cell->wrap(place) : place) << film;
        EXPECT_EQ(r, s.packing.bodies.radius[k]);
      }
      EXPECT_FALSE(numbers >> id);
    }
    EXPECT_EQ(count, 3u) << film;
  }
  convert(file("f.dump") + "-o" + file("last.h5"));
  EXPECT_EQ(hash("last.h5"), hash("s.h5")) << "the last frame of a dump is read";
  // Frames that do not follow each other in time are numbered.
  convert(file("s.h5") + file("s.snapshot0001.h5") + "-o" + file("back.pvd"));
  EXPECT_THAT(content(in_folder("back.pvd")),
              AllOf(HasSubstr("timestep=\"0\" group=\"\" part=\"0\" file=\"back.0001.vtp\""),
                    HasSubstr("timestep=\"1\" group=\"\" part=\"0\" file=\"back.0002.vtp\"")));
  write_state(small_bed(), in_folder("bed.h5"));
  convert(file("bed.h5") + file("bed.h5") + "-o" + file("bed.pvd"));
  EXPECT_TRUE(exists("bed.0002.vtp"));
}

TEST_F(Convert, BadUsageSaysWhatIsWrong) {
  write_state(small_bed(), in_folder("bed.h5"));
  write("g.csv", "x,y,r\n0,0,.5\n");
  write("keep.h5", "old");
  convert(file("s.h5") + "-o" + file("t.dump"));
  std::string fewer = content(in_folder("t.dump"));
  fewer.replace(fewer.find("\n60\n"), 4, "\n59\n");
  fewer.erase(fewer.rfind('\n', fewer.size() - 2) + 1);
  write("fewer.dump", fewer);
  write("wide.csv", "id,x,y,r\n0,0,0,9\n");
  const std::string to = " -o" + file("keep.h5");
  for (const auto& [arguments, message] : std::initializer_list<std::pair<std::string, std::string>>{
           {file("s.h5") + file("s.h5") + to, "-o = " + in_folder("keep.h5") + ": of several inputs must end in"},
           {file("s.h5") + file("bed.h5") + "-o" + file("f.pvd"), "is of another system than"},
           {file("bed.h5") + file("bed.h5") + "-o" + file("f.xyz"), "triangles are drawn in .vtp and .pvd only"},
           {file("g.csv") + "--columns x=1" + to, "--columns = x=1: the table has no such column; it has x, y, r"},
           {file("g.csv") + "--columns fx=a" + to, "is a column of contacts, and there are none"},
           {file("g.csv") + "--columns x" + to, "--columns = x: is OURS=THEIRS"},
           {file("g.csv") + "--contacts" + file("none") + to, "none: cannot be read"},
           {file("g.csv") + "--length 0" + to, "--length = 0: must be positive"},
           {file("s.h5") + "--length 2" + to, "--length: the file has its units"},
           {file("s.h5") + "--columns x=y" + to, "--columns: belongs to tables of text and dumps"},
           {file("s.h5") + "--contacts" + file("g.csv") + to, "belongs to tables of text and dumps"},
           {file("t.dump") + "--length 2" + to, "--length: the file says its units with its law"},
           {file("g.csv") + "--from" + file("s.h5") + "-o" + file("x.csv"), "with --from must end in .h5"},
           {file("g.csv") + "--from" + file("bed.h5") + to, "must be a state of disks or spheres"},
           {file("g.csv") + "--from" + file("g.csv") + to, "g.csv: "},
           {file("s.snapshot0001.h5") + "--from" + file("s.h5") + to, "takes grains from a table of text"},
           {file("g.csv") + "--from" + file("s.h5") + "--gap-tolerance 1" + to, "found by the law of the state"},
           {file("fewer.dump") + "--from" + file("s.h5") + to, "a grain of the state is missing here"},
           {file("g.csv") + "--from" + file("s.h5") + to, "id: column is missing: grains go into a state by their ids"},
           {file("s.h5") + "--first-id x" + to, "--first-id = x"},
           {file("wide.csv") + "--from" + file("s.h5") + to, "(--from)"}}) {
    const Outcome o = run("convert" + arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_THAT(o.err, HasSubstr(message)) << arguments;
  }
  EXPECT_EQ(content(in_folder("keep.h5")), "old");
  EXPECT_FALSE(exists("f.pvd"));
}

}  // namespace
}  // namespace isostat
