#include "dem/files/formats/text_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <unordered_map>

#include "dem/state/link_ends.hpp"

namespace isostat {
namespace {

constexpr std::size_t kMostFaults = 100;  // listed

void add_fault(std::vector<Fault>& faults, Fault fault) {
  if (faults.size() < kMostFaults)
    faults.push_back(std::move(fault));
  else if (faults.size() == kMostFaults)
    faults.push_back({fault.file, fault.line, "", "", "more faults from here on are not listed"});
}

std::string_view trimmed(std::string_view s) {
  constexpr std::string_view space = " \t\r";
  const std::size_t a = s.find_first_not_of(space);
  return a == std::string_view::npos ? std::string_view{} : s.substr(a, s.find_last_not_of(space) - a + 1);
}

// Cells of one table as numbers, collecting the faults.
class NumberReader {
 public:
  explicit NumberReader(const TextTable& table) : table_(table) {}

  // Column numbers of the given names; a fault for a missing one if it is required.
  std::vector<std::optional<std::size_t>> find(const std::vector<std::string>& names, bool required) {
    std::vector<std::optional<std::size_t>> found;
    for (const std::string& name : names) {
      found.push_back(table_.column(name));
      if (required && !found.back()) fault(table_.first_line - 1, name, "", "column is missing");
    }
    return found;
  }
  double real(std::size_t row, std::optional<std::size_t> col, double absent) {
    return col ? number<double>(row, *col, "must be a finite number") : absent;
  }
  std::int64_t integer(std::size_t row, std::optional<std::size_t> col, std::int64_t absent) {
    return col ? number<std::int64_t>(row, *col, "must be an integer") : absent;
  }
  void fault(int line, std::string key, std::string_view value, std::string rule) {
    add_fault(faults_, {table_.path, line, std::move(key), std::string(value), std::move(rule)});
  }
  void cell_fault(std::size_t row, std::size_t col, std::string rule) {
    fault(line_of(row), table_.columns[col], table_.cell(row, col), std::move(rule));
  }
  int line_of(std::size_t row) const { return table_.first_line + static_cast<int>(row); }
  std::vector<Fault>& faults() { return faults_; }
  void throw_faults() {
    if (!faults_.empty()) throw InputError(std::move(faults_));
  }

 private:
  template <class Number>
  Number number(std::size_t row, std::size_t col, const char* rule) {
    std::string_view text = table_.cell(row, col);
    if (text.size() > 1 && text[0] == '+') text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    bool good = error == std::errc{} && end == text.data() + text.size();
    if constexpr (std::is_floating_point_v<Number>) good = good && std::isfinite(value);
    if (!good) cell_fault(row, col, rule);
    return good ? value : Number{};
  }
  const TextTable& table_;
  std::vector<Fault> faults_;
};

using Columns = std::vector<std::optional<std::size_t>>;

template <int D>
std::vector<std::string> with_axes(const std::string& prefix) {
  std::vector<std::string> names{prefix + "x", prefix + "y"};
  if (D == 3) names.push_back(prefix + "z");
  return names;
}

void set_spin(NumberReader& in, std::size_t row, const Columns& c, double& spin) { spin = in.real(row, c[0], 0); }
void set_spin(NumberReader& in, std::size_t row, const Columns& c, Vec3& spin) {
  for (int k = 0; k < 3; ++k) spin[k] = in.real(row, c[static_cast<std::size_t>(k)], 0);
}

std::optional<LinkKind> parse_kind(std::string_view text) {
  if (const auto kind = link_kind_from_letters(text)) return kind;
  if (text.size() == 1 && text[0] >= '0' && text[0] <= '4') return static_cast<LinkKind>(text[0] - '0');
  return std::nullopt;
}

// Equal densities, mass 1 for the largest grain: what a file without masses is taken to mean.
template <int D>
void set_masses(Bodies<D>& b, bool masses_given) {
  const double largest = b.size() == 0 ? 1 : *std::max_element(b.radius.begin(), b.radius.end());
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (!masses_given) b.mass[k] = std::pow(b.radius[k] / largest, D);
    b.inertia[k] = (D == 2 ? 0.5 : 0.4) * b.mass[k] * b.radius[k] * b.radius[k];
  }
}

}  // namespace

std::optional<std::size_t> TextTable::column(std::string_view name) const {
  const auto at = std::find(columns.begin(), columns.end(), name);
  return at == columns.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - columns.begin()));
}

TextTable parse_csv(std::string_view text, const std::string& path) {
  TextTable table{path, 2, {}, {}};
  std::vector<Fault> faults;
  int line = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view row = trimmed(text.substr(at, end - at));
    at = end + 1;
    ++line;
    std::size_t fields = 0;
    for (std::size_t from = 0; from <= row.size();) {
      const std::size_t comma = std::min(row.find(',', from), row.size());
      const std::string_view field = trimmed(row.substr(from, comma - from));
      if (line == 1)
        table.columns.emplace_back(field);
      else
        table.cells.push_back(field);
      ++fields;
      from = comma + 1;
    }
    if (line > 1 && fields != table.columns.size()) {
      add_fault(faults, {path, line, "", std::to_string(fields) + " fields",
                         "a row has as many fields as the header, " + std::to_string(table.columns.size())});
      table.cells.resize(table.cells.size() - fields);
    }
  }
  if (line == 0) faults.push_back({path, 0, "", "", "is empty; a CSV file starts with its header line"});
  if (!faults.empty()) throw InputError(std::move(faults));
  return table;
}

std::vector<double> real_column(const TextTable& table, std::string_view name, std::vector<Fault>& faults) {
  NumberReader in(table);
  const auto at = table.column(name);
  std::vector<double> values;
  for (std::size_t row = 0; at && row < table.rows(); ++row) values.push_back(in.real(row, at, 0));
  for (Fault& fault : in.faults()) add_fault(faults, std::move(fault));
  return values;
}

int grain_dimension(const TextTable& grains) {
  const auto z = grains.column("z");
  if (!z) return 2;
  for (std::size_t row = 0; row < grains.rows(); ++row) {
    double value = 1;
    const std::string_view text = grains.cell(row, *z);
    std::from_chars(text.data(), text.data() + text.size(), value);
    if (value != 0) return 3;
  }
  return 2;
}

template <int D>
Bodies<D> read_grains(const TextTable& grains) {
  NumberReader in(grains);
  const Columns id = in.find({"id"}, true), r = in.find({"r"}, true), x = in.find(with_axes<D>(""), true);
  const Columns v = in.find(with_axes<D>("v"), false), m = in.find({"m"}, false);
  const Columns w = D == 2 ? in.find({"omega"}, false) : in.find(with_axes<3>("w"), false);
  Columns rho = in.find({"density"}, false);
  if (m[0]) rho[0].reset();  // it says the same in other words
  in.throw_faults();
  if (grains.rows() == 0) in.fault(grains.first_line, "", "", "the table has no grain");

  Bodies<D> b;
  b.resize(grains.rows());
  std::unordered_map<std::int64_t, std::size_t> row_of_id;
  for (std::size_t row = 0; row < grains.rows(); ++row) {
    b.id[row] = in.integer(row, id[0], 0);
    const auto [first, is_new] = row_of_id.emplace(b.id[row], row);
    if (!is_new)
      in.cell_fault(row, *id[0], "ids are distinct; used before in line " + std::to_string(in.line_of(first->second)));
    b.radius[row] = in.real(row, r[0], 0);
    if (!(b.radius[row] > 0)) in.cell_fault(row, *r[0], "must be positive");
    for (int k = 0; k < D; ++k) {
      b.position[row][k] = in.real(row, x[static_cast<std::size_t>(k)], 0);
      b.velocity[row][k] = in.real(row, v[static_cast<std::size_t>(k)], 0);
    }
    set_spin(in, row, w, b.spin[row]);
    b.mass[row] = in.real(row, m[0], 0);
    if (m[0] && !(b.mass[row] > 0)) in.cell_fault(row, *m[0], "must be positive");
    const double density = in.real(row, rho[0], 1);
    if (!(density > 0)) in.cell_fault(row, *rho[0], "must be positive");
    if (rho[0]) b.mass[row] = density * std::pow(2 * b.radius[row], D);
  }
  in.throw_faults();
  set_masses(b, m[0] || rho[0]);
  return b;
}

template <int D>
std::vector<Link<D>> read_links(const TextTable& links, const Packing<D>& grains) {
  NumberReader in(links);
  const Columns ends = in.find({"i", "j"}, true);
  Columns s = in.find({"s1", "s2"}, false);
  if (D == 3) s.push_back(links.column("s3"));
  const Columns kind = in.find({"kind"}, false), h = in.find({"h"}, false), n = in.find({"N"}, false);
  const Columns t = D == 2 ? in.find({"T"}, false) : in.find(with_axes<3>("T"), false);
  const Columns m = D == 2 ? in.find({"M"}, false) : in.find(with_axes<3>("M"), false);
  in.throw_faults();

  std::unordered_map<std::int64_t, std::int32_t> index;
  for (std::size_t k = 0; k < grains.bodies.size(); ++k)
    index.emplace(grains.bodies.id[k], static_cast<std::int32_t>(k));
  std::vector<Link<D>> out;
  out.reserve(links.rows());
  for (std::size_t row = 0; row < links.rows(); ++row) {
    Link<D> l;
    bool known = true;
    for (std::size_t e : {0u, 1u}) {
      const auto body = index.find(in.integer(row, ends[e], 0));
      known = known && body != index.end();
      if (body == index.end())
        in.cell_fault(row, *ends[e], "is the id of no grain");
      else
        (e == 0 ? l.i : l.j) = body->second;
    }
    if (!known) continue;
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    if (grains.cell && !s[0])
      l.shift = grains.cell->nearest_image(grains.bodies.position[j] - grains.bodies.position[i]);
    for (std::size_t k = 0; k < D && s[0]; ++k) {
      const std::int64_t shift = in.integer(row, s[k], 0);
      if (std::abs(static_cast<double>(shift)) > 1e8) in.cell_fault(row, *s[k], "must be an integer of at most 1e8");
      l.shift[k] = static_cast<int>(std::clamp<std::int64_t>(shift, -100000000, 100000000));
      if (!grains.cell && l.shift[k] != 0) in.cell_fault(row, *s[k], "an image shift needs a periodic cell (--box)");
    }
    const double distance = norm(branch(grains, i, j, l.shift));
    if (!(distance > 0)) in.cell_fault(row, *ends[1], "is at the same place as grain i: the link has no normal");
    if (kind[0]) {
      const auto parsed = parse_kind(links.cell(row, *kind[0]));
      if (!parsed) in.cell_fault(row, *kind[0], "must be c, s, r, sr or d");
      l.kind = parsed.value_or(LinkKind::closed);
    }
    l.gap = in.real(row, h[0], distance - grains.bodies.radius[i] - grains.bodies.radius[j]);
    l.normal_force = in.real(row, n[0], 0);
    set_spin(in, row, t, l.tangential_force);
    set_spin(in, row, m, l.moment);
    out.push_back(l);
  }
  in.throw_faults();
  return out;
}

template Bodies<2> read_grains(const TextTable&);
template Bodies<3> read_grains(const TextTable&);
template std::vector<Link<2>> read_links(const TextTable&, const Packing<2>&);
template std::vector<Link<3>> read_links(const TextTable&, const Packing<3>&);

}  // namespace isostat
