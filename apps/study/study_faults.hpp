// The faults of a study file and of the scenes that it makes, collected and told together.
#pragma once
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "dem/input_error.hpp"

namespace isostat {

class StudyFaults {
 public:
  explicit StudyFaults(std::string path) : path_(std::move(path)) {}

  // A fault of the study file itself; the same one is told once.
  void add(int line, const std::string& key, const std::string& value, const std::string& rule);
  // Of a scene; the same one in many parameter sets is told once, with the first that has it.
  void add_of_scene(Fault fault, const std::string& set);

  const std::string& path() const { return path_; }
  bool none() const { return faults_.empty(); }
  // Throws all as one InputError, those of the study file first, by line; does nothing if there is none.
  void raise();

 private:
  bool is_new(const Fault& fault);

  std::string path_;
  std::vector<Fault> faults_;
  std::set<std::tuple<std::string, int, std::string, std::string, std::string>> told_;
};

}  // namespace isostat
