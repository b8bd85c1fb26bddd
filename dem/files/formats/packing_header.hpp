// What the columns of a text format have no place for: system, time, cell and its motion, the stresses asked for, the
// law as it acts, masses. As TOML: beside X.grains.csv in X.csv.toml, beside X.dump in X.dump.toml, and in a network on
// comment lines that begin with #isostat.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem/state/state.hpp"

namespace isostat {

template <class System>
std::string header_text(const State<System>& state);

class PackingHeader {
 public:
  // Throws InputError for bad TOML, unknown keys, and values that are no numbers where numbers belong.
  PackingHeader(std::string_view toml, std::string path);

  std::optional<std::vector<double>> cell() const;
  double tilt() const;  // of that cell
  // Gives the state all but the cell. Throws InputError if it is of another system, incomplete or out of range.
  template <class System>
  void complete(State<System>& state) const;

 private:
  [[noreturn]] void refuse(const std::string& key, const std::string& rule) const;
  std::string path_;
  std::map<std::string, std::vector<double>> numbers_;
  std::map<std::string, std::string> texts_;
  std::map<std::string, int> lines_;
};

// As comment lines of a network, and back: none if the network has no such line. Line numbers are those of the network.
std::string commented_header(std::string_view header);
std::optional<PackingHeader> header_in_comments(std::string_view network, const std::string& path);

// "X.grains.csv" or "X.csv" -> "X.csv.toml"; "X.dump" -> "X.dump.toml".
std::string header_path(std::string_view path);

}  // namespace isostat
