// isostat lab overlap: area and type of the overlap of pairs of triangles, exact.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/commands.hpp"
#include "apps/json_output.hpp"
#include "apps/lab/experiments.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"
#include "geometry/triangle_overlap.hpp"

namespace isostat {
namespace {

constexpr std::size_t kColumns = 12, kMostFaults = 20;
constexpr std::string_view kBlank = " \t\r";

// A decimal number or a C99 hexadecimal one (0x1.8p-3); infinities and NaN are numbers here, and refused later.
std::optional<double> number(std::string_view text) {
  bool negative = false;
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) negative = text[0] == '-', text.remove_prefix(1);
  auto format = std::chars_format::general;
  if (text.starts_with("0x") || text.starts_with("0X")) format = std::chars_format::hex, text.remove_prefix(2);
  if (text.empty() || text[0] == '-') return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, format);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return negative ? -value : value;
}

// The fields of a line between commas, blanks around them and a comment removed; none of an empty line.
std::vector<std::string_view> fields_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<std::string_view> fields;
  if (line.find_first_not_of(kBlank) == std::string_view::npos) return fields;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(',', at), line.size());
    std::string_view field = line.substr(at, end - at);
    field.remove_prefix(std::min(field.find_first_not_of(kBlank), field.size()));
    field = field.substr(0, field.find_last_not_of(kBlank) + 1);
    fields.push_back(field);
    at = end + 1;
  }
  return fields;
}

struct Pair {
  Triangle a, b;
};

class PairReader {
 public:
  explicit PairReader(const std::string& path) : path_(path) {}

  std::vector<Pair> read() {
    const std::string text = read_whole_file(path_);
    int line = 0;
    for (std::size_t at = 0; at < text.size() && faults_.size() < kMostFaults; ++line) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      take(line + 1, fields_of(std::string_view(text).substr(at, end - at)));
      at = end + 1;
    }
    if (faults_.size() >= kMostFaults) faults_.push_back({path_, 0, "", "", "more faults are not listed"});
    if (!faults_.empty()) throw InputError(std::move(faults_));
    return std::move(pairs_);
  }

 private:
  void take(int line, const std::vector<std::string_view>& fields) {
    if (fields.empty()) return;
    const bool first = !seen_;
    seen_ = true;
    std::array<double, kColumns> value{};
    if (first && is_header(fields)) return;
    if (fields.size() != kColumns) {
      faults_.push_back({path_, line, "columns", std::to_string(fields.size()),
                         "12 numbers between commas: x0,y0,x1,y1,x2,y2 of triangle A, then of B"});
      return;
    }
    bool good = true;
    for (std::size_t k = 0; k < kColumns; ++k) {
      const auto v = number(fields[k]);
      if (v && std::isfinite(*v)) {
        value[k] = *v;
      } else if (faults_.size() < kMostFaults) {
        faults_.push_back({path_, line, "column " + std::to_string(k + 1), std::string(fields[k]),
                           "a finite number, decimal or C99 hexadecimal (0x1.8p-3)"});
        good = false;
      }
    }
    if (!good) return;
    Pair p;
    for (std::size_t k = 0; k < 3; ++k) {
      p.a.corner[k] = {value[2 * k], value[2 * k + 1]};
      p.b.corner[k] = {value[2 * k + 6], value[2 * k + 7]};
    }
    pairs_.push_back(p);
  }

  // Names of columns: twelve fields of which none is a number, nor starts as one.
  static bool is_header(const std::vector<std::string_view>& fields) {
    for (const std::string_view f : fields)
      if (f.empty() || std::string_view("0123456789+-.").find(f[0]) != std::string_view::npos || number(f))
        return false;
    return fields.size() == kColumns;
  }

  std::string path_;
  bool seen_ = false;  // a line that is not empty
  std::vector<Pair> pairs_;
  std::vector<Fault> faults_;
};

}  // namespace

int lab_overlap(int argc, char** argv) {
  const Arguments args(argc, argv, {kJsonOption},
                       {"PAIRS.csv",
                        "Area and type of the overlap of pairs of triangles, exact. A line: x0,y0,x1,y1,x2,y2 of one "
                        "triangle, then of the other, in either orientation; decimal or C99 hexadecimal. Types: i to v "
                        "of Poeschel and Buchholtz (1995), touch, separate, degenerate."});
  args.require_inputs(1, 1, "one table of pairs");
  nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
  for (const Pair& p : PairReader(args.inputs()[0]).read()) {
    const TriangleOverlap o = triangle_overlap(p.a, p.b);
    pairs.push_back({{"area", o.area}, {"type", name(o.type)}});
  }
  write_json(args, {{"pairs", pairs}});
  return exit_done;
}

}  // namespace isostat
