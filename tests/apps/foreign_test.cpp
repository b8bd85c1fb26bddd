// Packings that no run has made: what is said of their contacts, forces, units, law and scene, and tables of several.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "tests/apps/program.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string kPhotograph = ISOSTAT_DATA "/foreign/photograph.csv --box 420.248,424.388 ";

class Foreign : public Program {
 protected:
  std::string file(const std::string& name) const { return " " + in_folder(name) + " "; }
  // A ring of three disks around a cell, pressed with N = 200; the second contact with `other`.
  void write_ring(const std::string& stem, double other) const {
    write(stem + ".grains.csv", "id,x,y,r\n1,0,0,20\n2,40,0,20\n3,80,0,20\n");
    write(stem + ".contacts.csv", "i,j,N,T\n1,2,200,0\n2,3," + std::to_string(other) + ",0\n3,1,200,0\n");
  }
};

TEST_F(Foreign, ContactsOfAPhotographAreDoubtedEverywhere) {
  const Outcome o = run("analyze " + kPhotograph + "--only counts,rigidity --json -");
  ASSERT_EQ(o.code, 0) << o.err;
  const Json json = Json::parse(o.out);
  ASSERT_EQ(json["warnings"].size(), 1u);
  EXPECT_THAT(o.err, AllOf(StartsWith("isostat analyze: "), HasSubstr(json["warnings"][0].get<std::string>())));
  EXPECT_THAT(json["rigidity"]["certificate"]["contacts"].get<std::string>(), HasSubstr("by touching"));
  const Outcome text = run("analyze " + kPhotograph + "--only counts");
  EXPECT_THAT(text.out,
              HasSubstr("\nwarning: " ISOSTAT_DATA "/foreign/photograph.csv: contacts were found by touching"));
  write("touching.net", "grain 1 0 0 .5\ngrain 2 1 0 .5\ngrain 3 3 0 .5\n");
  EXPECT_EQ(run("analyze" + file("touching.net") + "--only counts,rigidity").err, "");
}

TEST_F(Foreign, ForcesThatDoNotBalance) {
  write_ring("good", 200);
  write_ring("bad", 100);
  const std::string options = "--box 120,45 --only equilibrium --json -";
  const Outcome good = run("analyze" + file("good.csv") + options), bad = run("analyze" + file("bad.csv") + options);
  EXPECT_EQ(good.err, "");
  EXPECT_EQ(Json::parse(good.out)["equilibrium"].dump(), R"({"max_force":0.0,"max_moment":0.0,"force_scale":200.0})");
  EXPECT_THAT(bad.err, HasSubstr("forces do not balance: 2 of 3 grains"));
  EXPECT_DOUBLE_EQ(Json::parse(bad.out)["equilibrium"]["max_force"], 0.6);
}

TEST_F(Foreign, StiffnessIsAnAssumptionUnlessGiven) {
  write_ring("ring", 200);
  const std::string command = "analyze" + file("ring.csv") + "--box 120,45 --law frictionless --only moduli,stiffness ";
  const Json assumed = Json::parse(run(command + "--json -").out);
  for (const char* section : {"moduli", "stiffness"})
    EXPECT_THAT(assumed[section]["stiffness"]["assumed"].get<std::string>(), HasSubstr("defaults")) << section;
  EXPECT_FALSE(assumed["moduli"].contains("with_geometric_term"));  // in what units would the forces be?
  const Json given = Json::parse(run(command + "--stiffness 1000 --json -").out);
  EXPECT_EQ(given["moduli"]["stiffness"]["normal"], 1000.0);
  EXPECT_EQ(given["moduli"]["stiffness"]["distant"], -10.0);
  EXPECT_THAT(given["moduli"]["stiffness"]["assumed"].get<std::string>(), HasSubstr("--stiffness"));
  EXPECT_TRUE(given["moduli"].contains("with_geometric_term"));
}

TEST_F(Foreign, TableHasARowForEach) {
  write_ring("a", 200);
  write_ring("b,c", 300);
  const std::string inputs = "analyze" + file("a.csv") + "'" + in_folder("b,c.csv") + "' --box 120,45 ";
  const Outcome o = run(inputs + "--only counts,stress --table" + file("t.csv"));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out, "");
  const std::string text = content(in_folder("t.csv"));
  EXPECT_THAT(text, AllOf(StartsWith("file,counts.grains,counts.contacts,"), HasSubstr(",stress.tensor.0.0,"),
                          HasSubstr("\n" + in_folder("a.csv") + ",3,3,"),
                          HasSubstr("\n\"" + in_folder("b,c.csv") + "\",3,3,"), Not(HasSubstr("counts.x"))));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  ASSERT_EQ(run("plot" + file("t.csv") + "--x counts.z --y stress.pressure -o" + file("t.svg")).code, 0);
  const Outcome refused = run(inputs + "--only moduli,rdf --table" + file("u.csv"));
  EXPECT_EQ(refused.code, 2);
  EXPECT_FALSE(exists("u.csv"));
}

TEST_F(Foreign, AMeanOverDifferentPressuresIsSaidToBeOne) {
  write("run.toml", quick_scene(30));
  const std::string pack = "pack" + file("run.toml") + "--max-time 2.5 ";
  run(pack + "-o" + file("a.h5"));
  run(pack + "--seed 4 -o" + file("b.h5"));
  run(pack + "--set stage.1.pressure=0.2 -o" + file("c.h5"));
  run(pack + "--set law.friction=0.3 -o" + file("d.h5"));
  const auto ensemble = [&](const std::string& inputs) { return run("analyze" + inputs + " --only counts --json -"); };
  EXPECT_EQ(ensemble(file("a.h5") + file("b.h5")).err, "");
  const Outcome pressures = ensemble(file("a.h5") + file("b.h5") + file("c.h5"));
  EXPECT_THAT(pressures.err, HasSubstr("the mean is over states of different imposed stresses: " + in_folder("c.h5")));
  EXPECT_EQ(Json::parse(pressures.out)["warnings"].size(), 1u);
  EXPECT_THAT(ensemble(file("a.h5") + file("d.h5")).err, HasSubstr("different laws"));
  EXPECT_EQ(run("analyze" + file("a.h5") + file("c.h5") + "--only counts --table" + file("t.csv")).err, "");
}

TEST_F(Foreign, InfoInventsNoSceneAndNoLaw) {
  write_ring("ring", 200);
  write("space.net", "grain 1 0 0 0 .5\ngrain 2 1 0 0 .5\n");
  ASSERT_EQ(run("convert" + file("ring.csv") + "--box 120,45 -o" + file("ring.h5")).code, 0);
  ASSERT_EQ(run("convert" + file("space.net") + "-o" + file("space.h5")).code, 0);
  for (const char* name : {"ring.h5", "space.h5"}) {
    const Json json = Json::parse(run("info" + file(name)).out);
    EXPECT_EQ(json["scene"], Json::object()) << name;
    EXPECT_EQ(json["law"], Json::object()) << name;
    EXPECT_TRUE(json["seed"].is_null()) << name;
    for (const auto& [key, value] : json["scales"].items()) EXPECT_TRUE(value.is_null()) << name << key;
    EXPECT_TRUE(json["hash"].is_string()) << name;
  }
  EXPECT_EQ(Json::parse(run("info" + file("ring.h5")).out)["cell"].dump(), "[120.0,45.0]");
}

// Widths of the lines of links in a picture of forces [pt].
std::vector<double> widths(const std::string& svg) {
  const std::string links = svg.substr(svg.find("id=\"links\""), svg.find("id=\"cell\"") - svg.find("id=\"links\""));
  const std::regex width("stroke-width=\"([0-9.]+)\"");
  std::vector<double> all;
  for (std::sregex_iterator at(links.begin(), links.end(), width), end; at != end; ++at)
    all.push_back(std::stod((*at)[1]));
  return all;
}

// A mean force is .11 of the largest diameter wide, whatever its unit; --scale makes another force so wide.
TEST_F(Foreign, ForcesAreDrawnToTheirOwnScale) {
  write_ring("ring", 200);
  const std::string draw = "draw" + file("ring.csv") + "--box 120,45 -o";
  ASSERT_EQ(run(draw + file("a.svg")).code, 0);
  ASSERT_EQ(run(draw + file("b.svg") + "--scale 400").code, 0);
  const std::string a = content(in_folder("a.svg"));
  const std::regex disk("<circle[^>]* r=\"([0-9.]+)\"");
  std::smatch match;
  ASSERT_TRUE(std::regex_search(a, match, disk)) << a;
  const auto wide = widths(a), narrow = widths(content(in_folder("b.svg")));
  ASSERT_FALSE(wide.empty());
  ASSERT_EQ(wide.size(), narrow.size());
  EXPECT_NEAR(wide[0], 0.11 * 2 * std::stod(match[1]), 0.02);
  EXPECT_NEAR(narrow[0], wide[0] / 2, 0.02);
  for (const char* bad : {"--scale 0", "--scale -1", "--scale x", "--what grains --scale 1", "--stiffness 3"}) {
    const Outcome o = run(draw + file("c.svg") + bad);
    EXPECT_EQ(o.code, 2) << bad;
    EXPECT_FALSE(exists("c.svg")) << bad;
  }
}

TEST_F(Foreign, PicturesTakeBoxAndTolerance) {
  ASSERT_EQ(run("draw " + kPhotograph + "--gap-tolerance 1 -o" + file("touching.svg")).code, 0);
  ASSERT_EQ(run("draw " + kPhotograph + "-o" + file("apart.svg")).code, 0);
  const auto links = [&](const std::string& name) {
    const std::string svg = content(in_folder(name));
    return svg.size();
  };
  EXPECT_GT(links("touching.svg"), links("apart.svg") + 2000);  // twice the contacts
  EXPECT_THAT(content(in_folder("touching.svg")), HasSubstr("id=\"cell\""));
  EXPECT_EQ(run("draw " ISOSTAT_DATA "/foreign/photograph.csv --box 9 -o" + file("x.svg")).code, 2);
}

TEST_F(Foreign, MatricesAreFilesOfTheirOwn) {
  const std::string net = "analyze " ISOSTAT_DATA "/clusters/triangle.net ";
  ASSERT_EQ(run(net + "--only modes --modes all --matrices" + file("m") + "--json" + file("r.json")).code, 0);
  for (const char* name : {"G.mtx", "K.mtx", "M.mtx", "modes.mtx", "rows.csv", "columns.csv"})
    EXPECT_TRUE(exists(std::string("m/") + name)) << name;
  EXPECT_THAT(content(in_folder("m/modes.mtx")), StartsWith("%%MatrixMarket matrix array real general\n9 6\n"));
  EXPECT_EQ(Json::parse(content(in_folder("r.json")))["modes"]["participation"].size(), 6u);
  ASSERT_EQ(run(net + ISOSTAT_DATA "/clusters/pair.net --only counts --matrices" + file("two")).code, 0);
  EXPECT_TRUE(exists("two/G.mtx"));
  EXPECT_FALSE(exists("two/modes.mtx"));
  EXPECT_TRUE(exists("two/2/G.mtx"));
}

TEST_F(Foreign, AllModesOfTooManyGrainsAreRefused) {
  std::string text;
  for (int k = 0; k < 3334; ++k) text += "grain " + std::to_string(k) + " " + std::to_string(k) + " 0 .5\n";
  write("chain.net", text);
  const Outcome o = run("analyze" + file("chain.net") + "--only modes --modes all");
  EXPECT_EQ(o.code, 2);
  EXPECT_THAT(o.err, HasSubstr("--modes = all: is for at most 10000 degrees of freedom, and here are 10002"));
}

}  // namespace
}  // namespace isostat
