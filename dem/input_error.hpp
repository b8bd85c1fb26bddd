// Bad input: an exception that lists every fault found. Caught in apps/main.cpp: one message, exit code 2.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace isostat {

struct Fault {
  std::string file;   // or "command line", "--set"
  int line = 0;       // 1-based; 0: not about a line
  std::string key;    // full dotted key, option, or column
  std::string value;  // as given
  std::string rule;   // what is allowed, and what to change
};

class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Fault> faults);
  InputError(std::string file, int line, std::string key, std::string value, std::string rule)
      : InputError(std::vector<Fault>{{std::move(file), line, std::move(key), std::move(value), std::move(rule)}}) {}
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

}  // namespace isostat
