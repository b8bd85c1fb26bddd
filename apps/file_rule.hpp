// One rule for all commands: a file that is written is none that is read, and no other that is written.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "dem/input_error.hpp"

namespace isostat {

class FileRule {
 public:
  // `role` names the option, operand or key that the path comes from. Nothing is said of "-", of empty paths, devices
  // and pipes.
  void reads(const std::string& role, const std::string& path);
  void writes(const std::string& role, const std::string& path);
  // Files that are written beside FOLDER/STEM.h5 under numbers not known yet: snapshots.
  void writes_numbered(const std::string& role, const std::string& state, const std::string& label);
  void require() const;  // throws InputError listing every clash

 private:
  struct Use {
    std::string role;
    bool written;
  };
  struct Numbered {
    std::string role, folder, start;
  };
  void add(const std::string& role, const std::string& path, bool written);
  std::string place(const std::string& path);  // the same for all paths to one file

  std::map<std::string, std::string> folders_;  // as given, and as they are
  std::map<std::string, Use> uses_;             // by place
  std::vector<Numbered> numbered_;
  std::vector<Fault> faults_;
};

}  // namespace isostat
