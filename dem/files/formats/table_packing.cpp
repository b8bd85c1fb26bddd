#include "dem/files/formats/table_packing.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <unordered_map>

#include "dem/files/formats/text_lines.hpp"
#include "dem/state/link_ends.hpp"

namespace isostat {
namespace {

using Columns = std::vector<std::optional<std::size_t>>;

bool all_there(const Columns& columns) {
  return std::all_of(columns.begin(), columns.end(), [](const auto& c) { return c.has_value(); });
}
bool any_there(const Columns& columns) {
  return std::any_of(columns.begin(), columns.end(), [](const auto& c) { return c.has_value(); });
}

// Cells of one table as numbers, collecting the faults.
class NumberReader {
 public:
  NumberReader(const TextTable& table, TableKind kind, const ColumnNames& named)
      : table_(table), kind_(kind), named_(named) {}

  Columns find(const std::vector<std::string>& names) const {
    Columns found;
    for (const std::string& name : names) found.push_back(find_column(table_, kind_, name, named_));
    return found;
  }
  Columns find_required(const std::vector<std::string>& names) {
    Columns found = find(names);
    for (std::size_t k = 0; k < names.size(); ++k)
      if (!found[k]) missing(names[k]);
    return found;
  }
  void missing(const std::string& name) {
    const std::string needs = kind_ == TableKind::grains ? "a table of grains needs x, y and r (or d, the diameter)"
                                                         : "a table of contacts needs i and j, ids of grains";
    fault(table_.header_line, name, "",
          "column is missing: " + needs + "; this one has " + list_of_columns(table_) +
              ", of which convert --columns " + name + "=... says which is meant");
  }
  double real(std::size_t row, std::optional<std::size_t> col, double absent) {
    return col ? number<double>(row, *col, "must be a finite number") : absent;
  }
  std::int64_t integer(std::size_t row, std::optional<std::size_t> col, std::int64_t absent) {
    return col ? number<std::int64_t>(row, *col, "must be an integer") : absent;
  }
  template <int D>
  Vec<D> vector(std::size_t row, const Columns& columns) {
    Vec<D> v;
    for (int k = 0; k < D; ++k) v[k] = real(row, columns[static_cast<std::size_t>(k)], 0);
    return v;
  }
  void fault(int line, std::string key, std::string_view value, std::string rule) {
    add_fault(faults_, {table_.path, line, std::move(key), std::string(value), std::move(rule)});
  }
  void cell_fault(std::size_t row, std::size_t col, std::string rule) {
    fault(table_.lines[row], table_.columns[col], table_.cell(row, col), std::move(rule));
  }
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
  TableKind kind_;
  const ColumnNames& named_;
  std::vector<Fault> faults_;
};

std::vector<std::string> with_axes(int dimension, const std::string& prefix) {
  std::vector<std::string> names{prefix + "x", prefix + "y"};
  if (dimension == 3) names.push_back(prefix + "z");
  return names;
}

void set_spin(NumberReader& in, std::size_t row, const Columns& c, double& spin) { spin = in.real(row, c[0], 0); }
void set_spin(NumberReader& in, std::size_t row, const Columns& c, Vec3& spin) { spin = in.vector<3>(row, c); }

std::optional<LinkKind> parse_kind(std::string_view text) {
  if (const auto kind = link_kind_from_letters(text)) return kind;
  if (text.size() == 1 && text[0] >= '0' && text[0] <= '4') return static_cast<LinkKind>(text[0] - '0');
  return std::nullopt;
}

// The force on j along n and across it; t = z x n.
void split_force(const Vec2& force, const Vec2& n, Link<2>& link) {
  link.normal_force = dot(force, n);
  link.tangential_force = n[0] * force[1] - n[1] * force[0];
}
void split_force(const Vec3& force, const Vec3& n, Link<3>& link) {
  link.normal_force = dot(force, n);
  link.tangential_force = force - link.normal_force * n;
}

}  // namespace

std::vector<double> real_column(const TextTable& table, std::string_view name, std::vector<Fault>& faults) {
  const ColumnNames none;
  NumberReader in(table, TableKind::grains, none);
  const auto at = table.column(name);
  std::vector<double> values;
  for (std::size_t row = 0; at && row < table.rows(); ++row) values.push_back(in.real(row, at, 0));
  for (Fault& fault : in.faults()) add_fault(faults, std::move(fault));
  return values;
}

int grain_dimension(const TextTable& grains, const ColumnNames& named) {
  const auto z = find_column(grains, TableKind::grains, "z", named);
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
Bodies<D> read_grains(const TextTable& grains, const ColumnNames& named, std::optional<double> radius,
                      GrainColumns* columns) {
  NumberReader in(grains, TableKind::grains, named);
  const Columns x = in.find_required(with_axes(D, ""));
  Columns size = in.find({"r", "d"});
  const bool no_size = !any_there(size);
  if (no_size && !radius) in.missing("r");
  if (all_there(size)) size[named.contains("d") && !named.contains("r") ? 0 : 1].reset();
  const Columns id = in.find({"id"}), v = in.find(with_axes(D, "v")), m = in.find({"m"});
  const Columns w = D == 2 ? in.find({"omega"}) : in.find(with_axes(3, "w"));
  Columns rho = in.find({"density"});
  if (m[0]) rho[0].reset();
  in.throw_faults();
  if (columns) *columns = {all_there(id), !no_size, all_there(v), all_there(w), all_there(rho)};
  if (grains.rows() == 0) in.fault(grains.header_line, "", "", "the table has no grain");

  Bodies<D> b;
  b.resize(grains.rows());
  std::unordered_map<std::int64_t, std::size_t> row_of_id;
  for (std::size_t row = 0; row < grains.rows(); ++row) {
    b.id[row] = in.integer(row, id[0], static_cast<std::int64_t>(row) + 1);
    const auto [first, is_new] = row_of_id.emplace(b.id[row], row);
    if (!is_new && id[0])
      in.cell_fault(row, *id[0],
                    "ids are distinct; used before in line " + std::to_string(grains.lines[first->second]));
    b.radius[row] = no_size ? *radius : size[0] ? in.real(row, size[0], 0) : in.real(row, size[1], 0) / 2;
    if (!(b.radius[row] > 0)) in.cell_fault(row, *(size[0] ? size[0] : size[1]), "must be positive");
    b.position[row] = in.vector<D>(row, x);
    b.velocity[row] = in.vector<D>(row, v);
    set_spin(in, row, w, b.spin[row]);
    b.mass[row] = in.real(row, m[0], 0);
    if (m[0] && !(b.mass[row] > 0)) in.cell_fault(row, *m[0], "must be positive");
    const double density = in.real(row, rho[0], 1);
    if (!(density > 0)) in.cell_fault(row, *rho[0], "must be positive");
    if (rho[0]) b.mass[row] = density * std::pow(2 * b.radius[row], D);
  }
  in.throw_faults();
  if (!m[0] && !rho[0]) return set_equal_densities(b), b;
  for (std::size_t k = 0; k < b.size(); ++k)
    b.inertia[k] = (D == 2 ? 0.5 : 0.4) * b.mass[k] * b.radius[k] * b.radius[k];
  return b;
}

template <int D>
void set_equal_densities(Bodies<D>& b) {
  const double largest = b.size() == 0 ? 1 : *std::max_element(b.radius.begin(), b.radius.end());
  for (std::size_t k = 0; k < b.size(); ++k) {
    b.mass[k] = std::pow(b.radius[k] / largest, D);
    b.inertia[k] = (D == 2 ? 0.5 : 0.4) * b.mass[k] * b.radius[k] * b.radius[k];
  }
}

template <int D>
std::vector<Link<D>> read_links(const TextTable& links, const Packing<D>& grains, const ColumnNames& named) {
  NumberReader in(links, TableKind::contacts, named);
  const Columns ends = in.find_required({"i", "j"});
  Columns s = in.find({"s1", "s2"});
  if (D == 3) s.push_back(in.find({"s3"})[0]);
  const Columns kind = in.find({"kind"}), h = in.find({"h"}), n = in.find({"N"}), f = in.find(with_axes(D, "f"));
  const Columns t_vector = in.find(with_axes(D, "T")), t = D == 2 ? in.find({"T"}) : t_vector;
  const Columns m = D == 2 ? in.find({"M"}) : in.find(with_axes(3, "M"));
  if (any_there(s) && !all_there(s))
    in.fault(links.header_line, "s1", "",
             "image shifts have a number for each axis: s1, s2" + std::string(D == 3 ? ", s3" : ""));
  if (const auto force = first_force(links); force && !any_there(f) && !n[0])
    in.fault(
        links.header_line, *force, "",
        "is a force that is not understood: convert --columns N=" + *force +
            " if it acts along the line of centres, repulsion positive, and T=... for the other; or fx=..., fy=... "
            "for the components of the force on j");
  if (any_there(f)) {
    if (!all_there(f))
      in.fault(links.header_line, "fx", "", std::string("a force is given whole: fx, fy") + (D == 3 ? ", fz" : ""));
    if (n[0] || (D == 2 && t[0]))
      in.fault(links.header_line, "N", "", "forces are given as N and T, or as fx and fy, not both");
  }
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
    const Vec<D> r = branch(grains, i, j, l.shift);
    const double distance = norm(r);
    if (!(distance > 0)) in.cell_fault(row, *ends[1], "is at the same place as grain i: the link has no normal");
    if (kind[0]) {
      const auto parsed = parse_kind(links.cell(row, *kind[0]));
      if (!parsed) in.cell_fault(row, *kind[0], "must be c, s, r, sr or d");
      l.kind = parsed.value_or(LinkKind::closed);
    }
    l.gap = in.real(row, h[0], distance - grains.bodies.radius[i] - grains.bodies.radius[j]);
    if (f[0]) {
      split_force(in.vector<D>(row, f) + in.vector<D>(row, t_vector), (1 / distance) * r, l);
    } else {
      l.normal_force = in.real(row, n[0], 0);
      set_spin(in, row, t, l.tangential_force);
    }
    set_spin(in, row, m, l.moment);
    out.push_back(l);
  }
  in.throw_faults();
  return out;
}

template Bodies<2> read_grains(const TextTable&, const ColumnNames&, std::optional<double>, GrainColumns*);
template Bodies<3> read_grains(const TextTable&, const ColumnNames&, std::optional<double>, GrainColumns*);
template void set_equal_densities(Bodies<2>&);
template void set_equal_densities(Bodies<3>&);
template std::vector<Link<2>> read_links(const TextTable&, const Packing<2>&, const ColumnNames&);
template std::vector<Link<3>> read_links(const TextTable&, const Packing<3>&, const ColumnNames&);

}  // namespace isostat
