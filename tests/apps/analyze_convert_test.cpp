// analyze and convert from outside: exit codes, what stdout carries, files that appear or do not.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/apps/program.hpp"

namespace isostat {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

const std::string kClusters = ISOSTAT_DATA "/clusters/";

class AnalyzeConvert : public Program {
 protected:
  // 3 x 3 square lattice, spacing 1, with forces 2 along x and 3 along y, as CSV.
  void write_loaded_lattice(const std::string& stem, double force_x = 2) const {
    std::string grains = "id,x,y,r\n", contacts = "i,j,N,T\n";
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) {
        const std::string id = std::to_string(10 * x + y);
        grains += id + "," + std::to_string(x) + "," + std::to_string(y) + ",.5\n";
        contacts += id + "," + std::to_string(10 * ((x + 1) % 3) + y) + "," + std::to_string(force_x) + ",0\n";
        contacts += id + "," + std::to_string(10 * x + (y + 1) % 3) + ",3,0\n";
      }
    write(stem + ".grains.csv", grains);
    write(stem + ".contacts.csv", contacts);
  }
  std::string file(const std::string& name) const { return " " + in_folder(name) + " "; }
};

TEST_F(AnalyzeConvert, JsonOnStdoutIsOneValueAndNothingElse) {
  const Outcome o = run("analyze " + kClusters + "k23.net --only counts --json -");
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "");
  const Json json = Json::parse(o.out);
  EXPECT_EQ(json["counts"]["contacts"], 6);
  EXPECT_TRUE(json["counts"]["solid_fraction"].is_null());
  EXPECT_EQ(json["inputs"], Json::array({kClusters + "k23.net"}));
  EXPECT_FALSE(json.contains("forces"));
}

TEST_F(AnalyzeConvert, TableWithoutJson) {
  const Outcome o = run("analyze " + kClusters + "k23.net --only counts");
  EXPECT_EQ(o.code, 0);
  EXPECT_THAT(o.out, HasSubstr("\n  z                             2.4\n"));
}

TEST_F(AnalyzeConvert, SectionThatDoesNotApplyIsRefusedAndNothingWritten) {
  const Outcome o =
      run("analyze " + kClusters + "k23.net --only counts,stress --json" + file("r.json") + "--csv" + file("csv"));
  EXPECT_EQ(o.code, 2);
  EXPECT_THAT(o.err, HasSubstr("k23.net: --only = stress: needs a periodic cell"));
  EXPECT_FALSE(std::filesystem::exists(in_folder("r.json")));
  EXPECT_FALSE(std::filesystem::exists(in_folder("csv")));
}

TEST_F(AnalyzeConvert, PackingsWithoutAContactAreAnalysed) {
  write("gas.toml", quick_scene(30));
  ASSERT_EQ(run("pack" + file("gas.toml") + "-o" + file("gas.h5") +
                "--set law.attraction=0 --set stage.0.velocity=0 --max-time 0.01")
                .code,
            3);
  write("one.net", "grain 0 0 0 .5\n");
  write("cell.net", "cell 3 3\ngrain 0 0 0 .5\n");
  write("far.net", "cell 9 9\ngrain 1 1 1 .5\ngrain 2 4 4 .5\n");
  write("self.net", "cell 1 1\ngrain 1 0 0 .5\ncontact 1 1 s 1 0\n");
  for (const auto& [name, grains] :
       {std::pair{"gas.h5", 30}, {"one.net", 1}, {"cell.net", 1}, {"far.net", 2}, {"self.net", 1}}) {
    const Outcome all = run("analyze" + file(name) + "--json" + file("all.json") + "--csv" + file("csv"));
    EXPECT_EQ(all.code, 0) << name << '\n' << all.err;
    EXPECT_TRUE(Json::parse(content(in_folder("all.json"))).contains("stiffness")) << name;
    const Outcome o = run("analyze" + file(name) + "--only stiffness,modes,bases,rigidity --json -");
    ASSERT_EQ(o.code, 0) << name << '\n' << o.err;
    const Json json = Json::parse(o.out);
    EXPECT_EQ(json["stiffness"]["inertia"], Json::array({0, 3 * grains, 0})) << name;
    EXPECT_EQ(json["modes"]["omega"], Json::array()) << name;
    EXPECT_EQ(json["rigidity"]["K"], 3 * grains) << name;
    EXPECT_EQ(run("analyze" + file(name) + "--only moduli").code, name == std::string("one.net") ? 2 : 0) << name;
  }
}

TEST_F(AnalyzeConvert, VoidsThatAreClosedButForRoundingAreScattered) {
  write("closing.net", "cell 2 1\ngrain 1 1e-9 0 .5\ngrain 2 1 1e-9 .5\ngrain 3 .5 .5 .5\ngrain 4 1.5 .5 .5\n");
  EXPECT_EQ(run("analyze" + file("closing.net") + "--only scattering,dacf,pores --json -").code, 0);
}

TEST_F(AnalyzeConvert, BadUsageNamesOptionAndValue) {
  const std::string net = kClusters + "k23.net ";
  for (const auto& [arguments, message] : std::initializer_list<std::pair<std::string, std::string>>{
           {"", "INPUT"},
           {net + "--only count", "--only = count"},
           {net + "--law wet", "--law = wet"},
           {net + "--gap-tolerance -1", "--gap-tolerance = -1: must not be negative"},
           {net + "--k-max 0", "--k-max = 0: must be positive"},
           {net + "--only scattering --k-window 2,1", "--k-window = 2,1: is two numbers LOW,HIGH with 0 <= LOW < HIGH"},
           {net + "--only scattering --k-window 1", "--k-window = 1: is two numbers"},
           {net + "--only scattering --k-window 1,x", "--k-window = 1,x: is two numbers"},
           {net + "--only pores --k-window 1,2", "--k-window: belongs to the section scattering: name it in --only"},
           {net + "--window-scan", "--window-scan: belongs to the section scattering or dacf: name it in --only"},
           {net + "--only scattering --fit-constant none",
            "--fit-constant = none: must be one of free, nonnegative, zero"},
           {net + "--only pores --pore-window 0,2", "--pore-window = 0,2: must begin above 0"},
           {net + "--only pores --pore-size -1", "--pore-size = -1: must be positive"},
           {net + "--only stressed --threshold 0", "--threshold = 0: must be positive"},
           {net + "--only stressed --force shear", "--force = shear: must be one of total, normal"},
           {net + "--only stressed", "--only = stressed: needs forces"},
           {kClusters + "periodic_free_cluster.net --only scattering --k-window 1,900", "--k-window = 900"},
           {kClusters + "periodic_free_cluster.net --only dacf --r-window 1,900", "--r-window = 900"},
           {net + "--cell free", "--cell = free: needs a periodic cell"},
           {in_folder("missing.h5"), "missing.h5"},
           {net + "--box 1", "--box = 1: must be two (3D: three) positive edges, as in 10,20"},
           {net + "--box 1,-2", "--box = 1,-2: must be two"},
           {net + "--box 9,9,9", "--box"},
           {kClusters + "periodic_free_cluster.net --box 9,9", "the file has its own cell; leave --box out"},
           {net + "--modes 5", "--modes: belongs to the section modes: name it in --only"},
           {net + "--only modes --modes 0", "--modes = 0: must be a number from 1 to 1000, or all"},
           {net + "--only modes --modes some", "--modes = some: must be a number from 1 to 1000, or all"},
           {net + "--only counts --density-of-states 10",
            "--density-of-states: belongs to the section modes: name it in --only"},
           {net + "--only modes --density-of-states 0", "--density-of-states = 0: must be"},
           {net + "--only modes --density-of-states ten", "--density-of-states = ten: must be"},
           {net + "--only modes --moments 100", "--moments = 100: belongs to --density-of-states"},
           {net + "--only modes --density-of-states 10 --moments 2", "--moments = 2: must be"},
           {net + "--only modes --density-of-states 10 --random-vectors 0", "--random-vectors = 0: must be"},
           {net + "--only modes --density-of-states 10 --prestress",
            "is of the symmetric modes: leave out --prestress"},
           {net + "--only modes --prestress --modes all", "--modes = all: is of the symmetric modes"},
           {net + "--only forces --bins 0", "--bins = 0: must be positive"},
           {net + "--bins 1", "--bins: belongs to the section forces"},
           {net + "--stiffness 0", "--stiffness = 0: is K_N or K_N,K_T or K_N,K_T,K_R, positive numbers"},
           {net + "--table " + in_folder("t.csv") + " --json -", "--table"},
           {net + "--table " + in_folder("no/such/t.csv"), "t.csv: cannot be written"},
           {net + "--json " + in_folder("no/such/place.json"), "place.json: cannot be written"}}) {
    const Outcome o = run("analyze " + arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_EQ(o.out, "") << arguments;
    EXPECT_THAT(o.err, HasSubstr(message)) << arguments;
  }
}

TEST_F(AnalyzeConvert, FaultsOfAllInputsAreListedTogether) {
  write("a.net", "grain 1 0 0 -1\n");
  write("b.net", "grain 1 0 0\n");
  const Outcome o = run("analyze" + file("a.net") + file("b.net"));
  EXPECT_EQ(o.code, 2);
  EXPECT_THAT(o.err, ::testing::AllOf(HasSubstr("a.net:1"), HasSubstr("b.net:1")));
}

TEST_F(AnalyzeConvert, ForeignPackingBecomesAStateAndBack) {
  write_loaded_lattice("p");
  ASSERT_EQ(run("convert" + file("p.csv") + "--box 3,3 -o" + file("p.h5")).code, 0);
  const Json json = Json::parse(run("analyze" + file("p.h5") + "--json -").out);
  EXPECT_DOUBLE_EQ(json["stress"]["tensor"][0][0], 2);  // 2 a contact and row of height 1
  EXPECT_DOUBLE_EQ(json["stress"]["tensor"][1][1], 3);
  EXPECT_DOUBLE_EQ(json["percolation"]["F_perc"], 3);
  EXPECT_EQ(json["percolation"]["direction"], "y");
  EXPECT_DOUBLE_EQ(json["counts"]["z"], 4);
  EXPECT_EQ(json["equilibrium"].size(), 3u);  // no law
  EXPECT_DOUBLE_EQ(json["equilibrium"]["force_scale"], 2.5);
  EXPECT_FALSE(json.contains("warnings"));
  ASSERT_EQ(run("convert" + file("p.h5") + "-o" + file("q.csv")).code, 0);
  ASSERT_EQ(run("convert" + file("q.csv") + "--box 3,3 -o" + file("q.dump")).code, 0);
  ASSERT_EQ(run("convert" + file("q.dump") + "-o" + file("r.csv")).code, 0);
  EXPECT_EQ(content(in_folder("q.grains.csv")), content(in_folder("r.grains.csv")));
  EXPECT_EQ(content(in_folder("q.contacts.csv")), content(in_folder("r.contacts.csv")));
  for (const char* name : {"v.vtp", "v.xyz", "v.net"}) {
    EXPECT_EQ(run("convert" + file("p.h5") + "-o" + file(name)).code, 0);
    EXPECT_GT(std::filesystem::file_size(in_folder(name)), 100u);
  }
}

TEST_F(AnalyzeConvert, SeveralInputsMakeAnEnsemble) {
  write_loaded_lattice("a", 2);
  write_loaded_lattice("b", 4);
  for (const char* s : {"a", "b"})
    ASSERT_EQ(run("convert" + file(std::string(s) + ".csv") + "--box 3,3 -o" + file(std::string(s) + ".h5")).code, 0);
  const Outcome o =
      run("analyze" + file("a.h5") + file("b.h5") + "--only stress,forces --json -" + " --csv" + file("csv"));
  const Json sigma = Json::parse(o.out)["stress"]["tensor"][0][0];
  EXPECT_DOUBLE_EQ(sigma["mean"], 3);
  EXPECT_DOUBLE_EQ(sigma["sd"], std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(sigma["se"], 1);
  EXPECT_THAT(content(in_folder("csv/stress.csv")), HasSubstr("key,mean,sd,se\ntensor.0.0,3,1.4142135623730951,1\n"));
  EXPECT_THAT(content(in_folder("csv/forces.links.2.csv")),
              HasSubstr("i,j,distant,h,N,T,M,F,angle\n0,10,0,0,4,0,0,4,0\n"));
  EXPECT_TRUE(std::filesystem::exists(in_folder("csv/forces.angle.csv")));
}

TEST_F(AnalyzeConvert, ConvertRefusesWithoutTouchingItsOutput) {
  write("keep.csv", "old");
  write_loaded_lattice("p");
  for (const auto& [arguments, message] : std::initializer_list<std::pair<std::string, std::string>>{
           {file("p.csv") + "-o" + file("keep.doc"), "must end in .h5"},
           {file("p.csv"), "-o"},
           {file("p.csv") + "--box 3 -o" + file("keep.csv"), "--box = 3"},
           {file("p.csv") + "--box 3,-3 -o" + file("keep.csv"), "--box = 3,-3"},
           {file("p.csv") + "--box 3,3,3 -o" + file("keep.h5"), "needs 2 edges"},
           {file("none.csv") + "-o" + file("keep.csv"), "none.csv: cannot be read"},
           {kClusters + "pair.net -o" + file("no/such/x.vtp"), "x.vtp: cannot be written"}}) {
    const Outcome o = run("convert " + arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_THAT(o.err, HasSubstr(message)) << arguments;
  }
  EXPECT_EQ(content(in_folder("keep.csv")), "old");
  EXPECT_FALSE(std::filesystem::exists(in_folder("keep.h5")));
}

}  // namespace
}  // namespace isostat
