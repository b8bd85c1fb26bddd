// What the readers of tables and dumps have in common: lines with their numbers, fields, and a list of faults with an
// end.
#pragma once
#include <algorithm>
#include <string_view>
#include <vector>

#include "dem/input_error.hpp"

namespace isostat {

inline std::string_view trimmed(std::string_view s) {
  constexpr std::string_view space = " \t\r";
  const std::size_t a = s.find_first_not_of(space);
  return a == std::string_view::npos ? std::string_view{} : s.substr(a, s.find_last_not_of(space) - a + 1);
}

// Between white space.
inline std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> f;
  constexpr std::string_view space = " \t\r";
  for (std::size_t at = line.find_first_not_of(space); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(space, at), line.size());
    f.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(space, end);
  }
  return f;
}

class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}
  bool next(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = text_.substr(at_, end - at_);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    at_ = end + 1;
    ++number_;
    return true;
  }
  int number() const { return number_; }  // of the line that was given last

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int number_ = 0;
};

inline void add_fault(std::vector<Fault>& faults, Fault fault) {
  constexpr std::size_t most = 100;  // listed
  if (faults.size() < most)
    faults.push_back(std::move(fault));
  else if (faults.size() == most)
    faults.push_back({fault.file, fault.line, "", "", "more faults from here on are not listed"});
}

}  // namespace isostat
