// What the program does to files: an output is no input and no other output, nothing that somebody may want is replaced
// unasked, names are bytes, pipes and links are followed, and killed runs leave no litter.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "dem/files/state_file.hpp"
#include "tests/apps/child.hpp"
#include "tests/apps/program.hpp"

namespace isostat {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

const std::string kNet = "grain 1 0 0 .5\ngrain 2 1 0 .5\n";

class Files : public Program {
 protected:
  Files() { write("scene.toml", quick_scene(30)); }
  std::string at(const std::string& name) const { return " " + in_folder(name) + " "; }
  std::string pack(const std::string& output, const std::string& more = "") const {
    return "pack" + at("scene.toml") + "-o" + at(output) + more;
  }
  std::size_t count(const std::string& part) const {
    std::size_t n = 0;
    for (const auto& entry : fs::directory_iterator(in_folder("")))
      n += entry.path().filename().string().find(part) != std::string::npos;
    return n;
  }
};

TEST_F(Files, AnOutputIsNoInputAndNoOtherOutput) {
  ASSERT_EQ(run(pack("s.h5")).code, 0);
  write("a.net", kNet);
  write("t.csv", "t,x\n0,1\n1,2\n");
  ASSERT_EQ(run("convert" + at("a.net") + "-o" + at("b.csv")).code, 0);
  fs::create_symlink(in_folder("s.h5"), in_folder("link.h5"));
  const auto series = [&](const std::string& name) { return "--set output.series='\"" + in_folder(name) + "\"'"; };
  for (const std::string& command :
       {"analyze" + at("s.h5") + "--json" + at("s.h5"), "analyze" + at("s.h5") + "--json" + at("link.h5"),
        "analyze" + at("a.net") + "--json" + at("./a.net"), "convert" + at("a.net") + "-o" + at("a.net"),
        "convert" + at("b.csv") + "-o" + at("b.csv"), "draw" + at("a.net") + "-o" + at("a.net"),
        "plot" + at("t.csv") + "-o" + at("t.csv"), "lab throughput" + at("a.net") + "--steps 1 --json" + at("a.net"),
        pack("n.h5", "--timings" + at("scene.toml")), pack("n.h5", "--timings" + at("n.h5")),
        pack("n.h5", "--timings" + at("n.h5.partial")), pack("n.h5", series("n.h5")),
        pack("n.h5", series("scene.toml")), pack("n.h5", series("t.json") + " --timings" + at("t.json")),
        pack("n.h5", series("n.snapshot0003.h5") + " --set output.snapshot_times=[0.5]"),
        pack("n.h5", series("n.stage0.h5") + " --set output.stages=true"),
        pack("n.h5", "--samples 2 --timings" + at("n.0002.h5")),
        pack("s.h5", "--force --set grains.file='\"" + in_folder("s.h5") + "\"'")}) {
    const std::string state = content(in_folder("s.h5")), scene = content(in_folder("scene.toml")),
                      grains = content(in_folder("b.grains.csv"));
    const Outcome o = run(command);
    EXPECT_EQ(o.code, 2) << command << '\n' << o.err;
    EXPECT_THAT(o.err, ::testing::AnyOf(HasSubstr("an output is no input and no other output"),
                                        HasSubstr("may also be one of"), HasSubstr("must end in"), HasSubstr(".svg")))
        << command;
    EXPECT_EQ(content(in_folder("s.h5")), state) << command;
    EXPECT_EQ(content(in_folder("scene.toml")), scene) << command;
    EXPECT_EQ(content(in_folder("a.net")), kNet) << command;
    EXPECT_EQ(content(in_folder("b.grains.csv")), grains) << command;
    EXPECT_EQ(content(in_folder("t.csv")), "t,x\n0,1\n1,2\n") << command;
    EXPECT_FALSE(exists("n.h5")) << command;
  }
  EXPECT_EQ(run(pack("n.h5", "--timings /dev/null " + series("/dev/null"))).code, 0) << "devices are no files";
}

TEST_F(Files, AFinishedStateIsNotReplacedUnasked) {
  const Outcome first = run(pack("s.h5"));
  ASSERT_EQ(first.code, 0);
  EXPECT_THAT(first.err, HasSubstr(in_folder("s.h5") + ": Phi 0."));
  EXPECT_THAT(first.err, HasSubstr("  z "));
  EXPECT_EQ(first.out, "");
  const std::string state = content(in_folder("s.h5"));
  EXPECT_EQ(run(pack("s.h5")).code, 0) << "the same command pasted again makes the same state";
  EXPECT_EQ(content(in_folder("s.h5")), state);
  for (const std::string more : {"--set grains.count=20", "--seed 9", "--max-time 0.1", "--set law.friction=0.1"}) {
    const Outcome o = run(pack("s.h5", more));
    EXPECT_EQ(o.code, 2) << more;
    EXPECT_THAT(o.err, HasSubstr("--force replaces it")) << more;
    EXPECT_EQ(content(in_folder("s.h5")), state) << more;
  }
  EXPECT_EQ(run(pack("s.h5", "--set grains.count=20 --force")).code, 0);
  EXPECT_NE(content(in_folder("s.h5")), state);
  write("other.h5", "not ours");
  EXPECT_EQ(run(pack("other.h5")).code, 2);
  EXPECT_EQ(content(in_folder("other.h5")), "not ours");
  // An unfinished one may be made anew; an interrupted run may not be dropped.
  ASSERT_EQ(run(pack("u.h5", "--max-time 0.1")).code, 3);
  EXPECT_EQ(run(pack("u.h5", "--max-time 0.2")).code, 3);
  write("u.h5.partial", "hours of work");
  const Outcome dropped = run(pack("u.h5"));
  EXPECT_EQ(dropped.code, 2);
  EXPECT_THAT(dropped.err, HasSubstr("--resume goes on from it, --force begins anew"));
  EXPECT_EQ(content(in_folder("u.h5.partial")), "hours of work");
}

TEST_F(Files, ToResumeAnUnfinishedStateIsNotToFinishIt) {
  const std::string cut = " --max-time 0.1", late =
                                                 " --set stage.1.until='\"equilibrium\"' --set stage.1.time=0.0 "
                                                 "--set stage.1.max_time=0.5";
  for (const std::string& more : {cut, late, std::string(" --set stage.0.velocity=1e6")}) {
    const std::string name = more == cut ? "a.h5" : more == late ? "b.h5" : "c.h5";
    ASSERT_EQ(run(pack(name, more)).code, 3) << more;
    const std::string state = content(in_folder(name));
    for (int again = 0; again < 2; ++again) {
      const Outcome o = run(pack(name, (more == cut ? "" : more) + " --resume"));
      EXPECT_EQ(o.code, 3) << more << o.err;
      EXPECT_THAT(o.err, HasSubstr("unfinished, with nothing to resume from")) << more;
      EXPECT_THAT(o.err, HasSubstr("unfinished  t ")) << more;
      EXPECT_EQ(content(in_folder(name)), state) << more;
    }
  }
}

TEST_F(Files, KilledRunsLeaveNoLitter) {
  Child child(ISOSTAT_PROGRAM " " + pack("s.h5", "--set stage.1.time=500 2>/dev/null"), in_folder(""));
  write("s.h5.partial.tmp.1.7", "of a process that lives");  // init
  write("s.h5.tmp.999999999.0", "of one that does not");
  write("s.snapshot0001.h5.tmp.999999999.3", "of another file");
  (void)child.end_by(SIGKILL);
  ASSERT_EQ(run(pack("s.h5")).code, 0);
  EXPECT_FALSE(exists("s.h5.tmp.999999999.0"));
  EXPECT_TRUE(exists("s.h5.partial.tmp.1.7"));
  EXPECT_TRUE(exists("s.snapshot0001.h5.tmp.999999999.3")) << "not a file of this run";
}

TEST_F(Files, AClosedTerminalAndAFullQuotaAreNoDisasters) {
  const std::string series = " --set output.series='\"" + in_folder("x.csv") + "\"'";
  {
    Child child(ISOSTAT_PROGRAM " " + pack("s.h5", "--set stage.1.time=500" + series + " 2>/dev/null"), in_folder(""));
    ASSERT_TRUE(child.wait_for([&] { return content(in_folder("x.csv")).size() > 600; }));
    const int status = child.end_by(SIGHUP);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130);
    EXPECT_TRUE(exists("s.h5.partial"));
  }
  const auto shell = [&](const std::string& text) {
    const int status = std::system(("bash -c '" + text + "' 2>" + in_folder("e")).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  EXPECT_EQ(shell("ulimit -f 8; " ISOSTAT_PROGRAM " " + pack("q.h5")), 2);
  EXPECT_THAT(content(in_folder("e")), HasSubstr("q.h5: cannot be written: File too large"));
  EXPECT_EQ(count("q.h5"), 0u);
  write("study.toml", "scene = \"scene.toml\"\nseeds = 1\n");
  EXPECT_EQ(shell(ISOSTAT_PROGRAM " study" + at("study.toml") + "-o" + at("out") + "<&- >&- 2>&-"), 0);
  EXPECT_TRUE(exists("out/study.csv"));
}

TEST_F(Files, NamesAreBytes) {
  const std::string name = in_folder("caf\xe9.net");
  std::ofstream(name) << kNet;
  const Outcome o = run("analyze " + name + " --only counts --json -");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(json::parse(o.out)["inputs"][0].get<std::string>(), HasSubstr("caf\xef\xbf\xbd.net"));
  write("bytes.csv", "t,a\xe9\n0,1\n1,2\n");
  for (const char* figure : {"p.svg", "p.png", "p.pdf"})
    EXPECT_EQ(run("plot" + at("bytes.csv") + "--what series -o" + at(figure)).code, 0) << figure;
  EXPECT_THAT(content(in_folder("p.svg")), HasSubstr("a\xef\xbf\xbd"));
  const std::string longest(200, 'n');
  for (const std::size_t more : {34u, 39u, 44u, 60u}) {
    const std::string output = longest + std::string(more, 'n') + ".h5";
    const Outcome packed = run(pack(output));
    const bool fits = output.size() + std::string(".partial").size() <= 255;
    EXPECT_EQ(packed.code, fits ? 0 : 2) << output.size() << packed.err;
    EXPECT_EQ(packed.err.find("File name too long") != std::string::npos, !fits) << packed.err;
    std::error_code too_long;
    EXPECT_EQ(fs::exists(in_folder(output), too_long), fits);
  }
}

TEST_F(Files, PipesAndLinks) {
  const auto shell = [&](const std::string& text) {
    write("c.sh", text);
    const int status =
        std::system(("timeout 20 bash " + in_folder("c.sh") + " >" + in_folder("o") + " 2>" + in_folder("e")).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  write("a.net", kNet);
  ASSERT_EQ(run(pack("s.h5")).code, 0);
  ASSERT_EQ(::mkfifo(in_folder("fifo").c_str(), 0600), 0);
  EXPECT_EQ(
      shell("(cat" + at("a.net") + ">" + at("fifo") + ") & " ISOSTAT_PROGRAM " analyze" + at("fifo") + "--only counts"),
      0);
  EXPECT_THAT(content(in_folder("o")), HasSubstr("grains                        2"));
  EXPECT_EQ(shell(ISOSTAT_PROGRAM " analyze <(cat" + at("a.net") + ") <(cat" + at("s.h5") + ") --only counts"), 0)
      << content(in_folder("e"));
  EXPECT_EQ(shell("cat" + at("scene.toml") + "| " ISOSTAT_PROGRAM " pack /dev/stdin --max-time .1 -o" + at("p.h5")), 3);
  fs::create_symlink("there.svg", in_folder("dangling.svg"));
  EXPECT_EQ(run("draw" + at("a.net") + "-o" + at("dangling.svg")).code, 0);
  EXPECT_TRUE(fs::is_symlink(in_folder("dangling.svg")) && exists("there.svg"));
  fs::create_symlink("loop.svg", in_folder("loop.svg"));
  const Outcome loop = run("draw" + at("a.net") + "-o" + at("loop.svg"));
  EXPECT_EQ(loop.code, 2);
  EXPECT_THAT(loop.err, HasSubstr("Too many levels of symbolic links"));
}

}  // namespace
}  // namespace isostat
