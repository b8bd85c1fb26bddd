#include "analysis/stiffness/matrix_files.hpp"

#include <array>
#include <initializer_list>

#include "analysis/stiffness/stiff_rows.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "dem/files/formats/real_text.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

// Sizes, then a line an entry; indices count from 1.
class MatrixMarket {
 public:
  MatrixMarket(const char* form, std::initializer_list<std::int64_t> sizes)
      : text_(std::string("%%MatrixMarket matrix ") + form + '\n') {
    for (const std::int64_t& n : sizes) text_ += std::to_string(n) + (&n + 1 == sizes.end() ? '\n' : ' ');
  }
  void add(std::int64_t row, std::int64_t column, double value) {
    text_ += std::to_string(row + 1) + ' ' + std::to_string(column + 1) + ' ';
    add(value);
  }
  void add(double value) {
    append_real(text_, value);
    text_ += '\n';
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string text_;
};

std::string text_of(const RigidityMatrix& g) {
  MatrixMarket file("coordinate real general", {g.rows(), g.columns(), std::ssize(g.value)});
  for (std::int64_t r = 0; r < g.rows(); ++r)
    for (auto e = idx(g.row_start[idx(r)]); e < idx(g.row_start[idx(r + 1)]); ++e) file.add(r, g.column[e], g.value[e]);
  return std::move(file).text();
}

std::string text_of(const SymmetricMatrix& k) {
  MatrixMarket file("coordinate real symmetric", {k.size, k.size, std::ssize(k.value)});
  for (std::int32_t c = 0; c < k.size; ++c)
    for (auto e = idx(k.start[idx(c)]); e < idx(k.start[idx(c + 1)]); ++e) file.add(k.row[e], c, k.value[e]);
  return std::move(file).text();
}

// Strains have no mass.
std::string diagonal_text(const std::vector<double>& mass, std::int64_t size) {
  MatrixMarket file("coordinate real symmetric", {size, size, std::ssize(mass)});
  for (std::int64_t c = 0; c < std::ssize(mass); ++c) file.add(c, c, mass[idx(c)]);
  return std::move(file).text();
}

std::string text_of(const std::vector<std::vector<double>>& columns, std::int64_t size) {
  MatrixMarket file("array real general", {size, std::ssize(columns)});
  for (const auto& column : columns)
    for (const double v : column) file.add(v);
  return std::move(file).text();
}

template <int D>
std::string columns_text(const Packing<D>& packing, const DofLayout& layout) {
  const std::vector<std::string> of_body = D == 2
                                               ? std::vector<std::string>{"x", "y", "spin"}
                                               : std::vector<std::string>{"x", "y", "z", "spin_x", "spin_y", "spin_z"};
  std::string text = "column,id,component\n";
  for (std::int64_t c = 0; c < layout.size(); ++c) {
    const std::int64_t body = c / layout.per_body;
    text += std::to_string(c + 1) + ',';
    if (body < layout.bodies)
      text += std::to_string(packing.bodies.id[idx(body)]) + ',' + of_body[idx(c % layout.per_body)];
    else
      text += ",strain_" + std::string(2, static_cast<char>('1' + c - layout.strain_column(0)));
    text += '\n';
  }
  return text;
}

constexpr std::array<const char*, 3> kComponents{"N", "T", "M"};  // by RowKind

template <int D>
std::string ends_text(std::int64_t i, std::int64_t j, const ImageShift<D>& shift) {
  std::string text = std::to_string(i) + ',' + std::to_string(j);
  for (const auto s : shift) text += ',' + std::to_string(s);
  return text;
}

std::string rows_text(const AnalysisInput& input, const StiffRows& rows) {
  const bool space = input.packing_3d.has_value();
  std::string text = space ? "row,i,j,s1,s2,s3,component,nx,ny,nz,k\n" : "row,i,j,s1,s2,component,k\n";
  const auto id = [](const auto& packing, std::int32_t body) { return packing.bodies.id[idx(body)]; };
  for (std::int64_t r = 0; r < rows.g.rows(); ++r) {
    const auto link = idx(rows.g.link_of_row[idx(r)]);
    const char* const component = kComponents[static_cast<std::size_t>(rows.g.kind[idx(r)])];
    text += std::to_string(r + 1) + ',';
    if (space) {
      const Link<3>& l = input.packing_3d->links[link];
      text += ends_text<3>(id(*input.packing_3d, l.i), id(*input.packing_3d, l.j), l.shift) + ',' + component;
      Vec3 axis{};
      if (rows.g.kind[idx(r)] == RowKind::rolling)
        axis[rows.g.axis[idx(r)]] = 1;
      else
        axis = axis_in_frame(input.spheres(), rows.g, idx(r));
      for (const double a : axis.c) text += ',', append_real(text, a);
    } else if (const LinkNetwork network = input.network(); network.is_area(link)) {
      const AreaLink& area = network.area(link);
      const auto& grain = input.triangles->packing.grains.id;
      text += ends_text<2>(grain[idx(area.grain_i)], grain[idx(area.grain_j)], area.shift) + ',' +
              (rows.g.kind[idx(r)] == RowKind::normal ? "area" : component);
    } else {
      const Link<2>& l = network.packing.links[link];
      text += ends_text<2>(id(network.packing, l.i), id(network.packing, l.j), l.shift) + ',' + component;
    }
    text += ',';
    append_real(text, rows.k[idx(r)]);
    text += '\n';
  }
  return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> matrix_files(const AnalysisInput& input,
                                                              const AnalysisOptions& options, bool with_modes) {
  const StiffRows rows = stiff_rows(input, options);
  const NetworkLaw law = input.network_law(options);
  const std::vector<double> mass =
      input.packing_3d ? dof_masses(input.spheres(), law) : dof_masses(input.network(), law);
  std::vector<std::pair<std::string, std::string>> files{
      {"G.mtx", text_of(rows.g)},
      {"K.mtx", text_of(weighted_normal_matrix(rows.g, rows.k))},
      {"M.mtx", diagonal_text(mass, rows.g.columns())},
      {"rows.csv", rows_text(input, rows)},
      {"columns.csv", input.packing_3d ? columns_text(*input.packing_3d, rows.g.layout)
                                       : columns_text(input.packing(), rows.g.layout)}};
  if (with_modes)
    files.emplace_back("modes.mtx", text_of(modes_of(input, options, mode_count(input, options), true).displacement,
                                            std::ssize(mass)));
  return files;
}

}  // namespace isostat
