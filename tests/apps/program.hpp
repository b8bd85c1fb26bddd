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

namespace isostat {

struct Outcome {
  int code;  // -1: killed by a signal
  std::string out, err;
};

class Program : public ::testing::Test {
 protected:
  Program() {
    std::string name = (std::filesystem::temp_directory_path() / "isostat-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~Program() override { std::filesystem::remove_all(folder_); }

  std::string in_folder(const std::string& name) const { return folder_ + "/" + name; }
  static std::string content(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  // Arguments as typed in a shell.
  Outcome run(const std::string& arguments) const {
    const std::string out = in_folder("stdout"), err = in_folder("stderr");
    const int status = std::system((ISOSTAT_PROGRAM " " + arguments + " >" + out + " 2>" + err).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
  }

 private:
  std::string folder_;
};

}  // namespace isostat
