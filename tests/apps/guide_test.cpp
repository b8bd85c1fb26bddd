// The commands of docs/guide.md, run in the order of the page after the README's first command, so that the page cannot
// rot: in a folder that looks like the root of the repository. What stands there for the program hands on to it and
// makes packings and studies small; ISOSTAT_GUIDE_GRAINS=1400 runs them in a size of one's own (12 CPU s at 1400).
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "dem/files/atomic_file.hpp"
#include "tests/apps/program.hpp"
#include "tests/support/skip.hpp"

namespace isostat {
namespace {

namespace fs = std::filesystem;

std::string page(const std::string& name) { return read_whole_file(fs::path(ISOSTAT_DATA).parent_path() / name); }

std::vector<std::string> shell_blocks(const std::string& text) {
  const std::string open = "\n```sh\n", close = "\n```\n";
  std::vector<std::string> blocks;
  for (std::size_t at = 0; (at = text.find(open, at)) != std::string::npos;) {
    const std::size_t begin = at + open.size(), end = text.find(close, begin);
    blocks.push_back(text.substr(begin, end - begin) + "\n");
    at = end;
  }
  return blocks;
}

// The README's first command without installing and building.
std::string first_command() {
  const std::string block = shell_blocks(page("README.md")).at(0);
  return block.substr(std::min(block.find("mkdir -p out"), block.size()));
}

class Guide : public Program {
 protected:
  void SetUp() override {
    if (std::system("python3 -c '' 2>/dev/null") != 0) ISOSTAT_SKIP("no python3");
    const std::string program = in_folder("build/release/bin/isostat");
    fs::create_directory_symlink(fs::path(ISOSTAT_DATA), in_folder("data"));
    fs::create_directories(fs::path(program).parent_path());
    write("build/release/bin/isostat", R"(#!/bin/bash
grains=${ISOSTAT_GUIDE_GRAINS:-100}
case $1 in
  pack) set -- "$@" --set grains.count=$grains ;;
  study) sed -i "s/^grains.count = .*/grains.count = $grains/" "$2" ;;
esac
exec )" ISOSTAT_PROGRAM " \"$@\"\n");
    fs::permissions(program, fs::perms::owner_exec, fs::perm_options::add);
  }
  // In the root that SetUp() made; a block ends at its first failing command.
  Outcome shell(const std::string& block) const {
    write("block.sh", "cd " + in_folder("") + "\n" + block);
    const std::string out = in_folder("stdout"), err = in_folder("stderr");
    const int status =
        std::system(("bash -eu -o pipefail " + in_folder("block.sh") + " >" + out + " 2>" + err).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
  }
};

TEST_F(Guide, EveryBlockRunsAndPrintsTheKeysThatThePageExplains) {
  const std::string text = page("docs/guide.md");
  std::vector<std::string> blocks = shell_blocks(text);
  ASSERT_GE(blocks.size(), 10u);
  blocks.insert(blocks.begin(), first_command());
  ASSERT_TRUE(blocks[0].starts_with("mkdir")) << "the README's first command makes out/ and fills it";
  std::string printed;
  for (const std::string& block : blocks) {
    const Outcome o = shell(block);
    ASSERT_EQ(o.code, 0) << block << o.err;
    printed += o.out;
  }
  // Lines such as `    solid_fraction                0.690177`.
  const std::regex line("\n    ([A-Za-z_][A-Za-z_0-9.]*)  +[^ ]");
  std::size_t keys = 0;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), line); at != std::sregex_iterator(); ++at, ++keys)
    EXPECT_NE(printed.find("\n  " + (*at)[1].str() + "  "), std::string::npos) << (*at)[1] << ": printed by no command";
  EXPECT_GE(keys, 30u);
}

}  // namespace
}  // namespace isostat
