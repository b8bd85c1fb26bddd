#include "dem/files/formats/text_table.hpp"

#include <algorithm>

#include "dem/files/formats/text_lines.hpp"
#include "dem/files/network_lines.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

constexpr char kWhiteSpace = ' ';
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // of UTF-8; Excel writes it

std::string_view unquoted(std::string_view field) {
  field = trimmed(field);
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
  return field;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  if (separator == kWhiteSpace) {
    std::vector<std::string_view> fields = fields_of(line);
    for (std::string_view& f : fields) f = unquoted(f);
    return fields;
  }
  std::vector<std::string_view> fields;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t end = std::min(line.find(separator, from), line.size());
    fields.push_back(unquoted(line.substr(from, end - from)));
    from = end + 1;
  }
  return fields;
}

char separator_of(std::string_view line) {
  for (const char c : {';', ','})
    if (line.find(c) != std::string_view::npos) return c;
  if (line.find('\t') == std::string_view::npos) return kWhiteSpace;
  const auto fields = split(line, '\t');  // tabs may also align columns
  return std::find(fields.begin(), fields.end(), "") == fields.end() ? '\t' : kWhiteSpace;
}

bool is_number(std::string_view field) {
  std::string point(field);
  std::replace(point.begin(), point.end(), ',', '.');
  return network_lines::number<double>(point).has_value();
}
bool are_numbers(const std::vector<std::string_view>& fields) {
  return !fields.empty() && std::all_of(fields.begin(), fields.end(), is_number);
}

// The comments above a table that has no line of names.
class Comments {
 public:
  void add(std::string_view line) {
    const std::string_view text = trimmed(line.substr(1));
    if (text.starts_with("format "))
      format_ = trimmed(text.substr(7));
    else if (!text.empty())
      last_ = text;
  }
  // Names for so many columns, if the comments have them.
  std::vector<std::string> names(std::size_t count) const {
    std::vector<std::string> names;
    if (!format_.empty()) {
      for (const std::string_view name : split(format_, '_')) names.emplace_back(name);
      if (names.back() == "attrs") {  // YADE: the comment names them
        names.pop_back();
        for (const std::string_view name : fields_of(last_)) names.emplace_back(name);
      }
    } else {
      for (const std::string_view name : split(last_, separator_of(last_))) names.emplace_back(name);
    }
    if (names.size() == count) return names;
    names.clear();
    for (std::size_t k = 1; k <= count; ++k) names.push_back(std::to_string(k));
    return names;
  }

 private:
  std::string_view format_, last_;
};

}  // namespace

std::optional<std::size_t> TextTable::column(std::string_view name) const {
  const auto at = std::find(columns.begin(), columns.end(), name);
  return at == columns.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - columns.begin()));
}

TextTable parse_table(std::string given, const std::string& path) {
  TextTable table;
  table.path = path;
  std::string& text = table.owned.emplace_back(std::move(given));
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  std::vector<Fault> faults;
  Comments comments;
  char separator = 0;
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    line = trimmed(line);
    if (line.empty()) continue;
    if (line.front() == '#') {
      if (separator == 0) comments.add(line);
      continue;
    }
    if (separator == 0) {
      separator = separator_of(line);
      if (separator != ',') {
        const std::size_t at = static_cast<std::size_t>(line.data() - text.data());
        std::replace(text.begin() + static_cast<std::ptrdiff_t>(at), text.end(), ',', '.');
      }
      const auto first = split(line, separator);
      if (!are_numbers(first)) {
        table.columns.assign(first.begin(), first.end());
        table.header_line = lines.number();
        continue;
      }
      table.columns = comments.names(first.size());
    }
    const auto fields = split(line, separator);
    if (fields.size() != table.columns.size()) {
      add_fault(faults, {path, lines.number(), "", std::to_string(fields.size()) + " fields",
                         "a row has as many fields as the first line, " + std::to_string(table.columns.size())});
      continue;
    }
    table.cells.insert(table.cells.end(), fields.begin(), fields.end());
    table.lines.push_back(lines.number());
  }
  if (separator == 0) faults.push_back({path, 0, "", "", "is empty; a table begins with a line of column names"});
  if (!faults.empty()) throw InputError(std::move(faults));
  return table;
}

bool begins_like_table(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#') continue;
    const char separator = separator_of(line);
    const auto fields = split(line, separator);
    if (fields.size() < 2) return false;
    const auto is_position = [](std::string_view f) { return f == "x" || f == "X"; };
    return separator != kWhiteSpace || are_numbers(fields) || std::any_of(fields.begin(), fields.end(), is_position);
  }
  return false;
}

}  // namespace isostat
