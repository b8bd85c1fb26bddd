// Runs the built program in a folder of the test's own.
#pragma once
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include "tests/support/temporary_folder.hpp"

namespace isostat {

// A soft, quick scene: an agitated gas in a fixed cell, then a compression.
inline std::string quick_scene(int grains) {
  return "seed = 3\n[grains]\ncount = " + std::to_string(grains) + R"(
solid_fraction = 0.5
[law]
normal_stiffness = 1e4
attraction_range = 0.01
[step]
fraction = 0.1
[[stage]]
velocity = 5
until = "time"
time = 2
[[stage]]
pressure = 0.1
max_strain_rate = 0.1
until = "time"
time = 3
)";
}

struct Outcome {
  int code;  // -1: killed by a signal
  std::string out, err;
};

class Program : public ::testing::Test {
 protected:
  std::string in_folder(const std::string& name) const { return folder_ / name; }
  static std::string content(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(in_folder(name), std::ios::binary) << text;
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(in_folder(name)); }
  // Arguments as typed in a shell.
  Outcome run(const std::string& arguments) const {
    const std::string out = in_folder("stdout"), err = in_folder("stderr");
    const int status = std::system((ISOSTAT_PROGRAM " " + arguments + " >" + out + " 2>" + err).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace isostat
