#include "analysis/rigidity/rigidity_matrix.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "analysis/rigidity/area_rows.hpp"
#include "dem/input_error.hpp"
#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

// Columns of a body once, whatever of its images the overlap meets.
void add_area_row(RigidityMatrix& g, const LinkNetwork& network, std::size_t link, RowKind kind, bool cell_free) {
  std::map<std::int32_t, std::array<double, 3>> by_body;
  Vec2 strain{};
  for (const auto& [body, shift, at] : area_loads(network, network.area(link), kind == RowKind::tangential)) {
    Vec2 x = network.packing.bodies.position[idx(body)];
    if (network.packing.cell) x += network.packing.cell->offset(shift);
    for (int a = 0; a < 2; ++a) strain[a] -= at[idx(a)] * x[a];
    if (!network.is_free(body)) continue;
    auto& sum = by_body[body];
    for (std::size_t d = 0; d < 3; ++d) sum[d] += at[d];
  }
  const auto add = [&](std::int64_t column, double value) { g.column.push_back(column), g.value.push_back(value); };
  for (const auto& [body, at] : by_body)
    for (int d = 0; d < 3; ++d) add(3 * static_cast<std::int64_t>(body) + d, at[idx(d)]);
  for (int a = 0; cell_free && a < 2; ++a) add(g.layout.strain_column(a), strain[a]);
  g.row_start.push_back(static_cast<std::int64_t>(g.column.size()));
  g.link_of_row.push_back(static_cast<std::int32_t>(link));
  g.kind.push_back(kind);
}

}  // namespace

RigidityMatrix rigidity_matrix(const LinkNetwork& network, NetworkLaw law, bool cell_free) {
  const Packing<2>& packing = network.packing;
  if (cell_free && !packing.cell) throw InputError("command line", 0, "--cell", "free", "the input has no cell");
  RigidityMatrix g;
  g.layout = dof_layout(network, law, cell_free);
  const auto rows = idx(row_count(network, law));
  const int per_body = g.layout.per_body;
  g.row_start.reserve(rows + 1);
  g.row_start.push_back(0);
  g.column.reserve(rows * idx(2 * per_body + g.layout.strains));
  g.value.reserve(g.column.capacity());

  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const Link<2>& link = packing.links[l];
    const LinkEnds<2> where = ends(packing, link);
    const Vec2& r = where.branch;
    const LinkFrame<double> f = frame(where);
    const LinkRows kept = rows_of(link.kind, law);
    for (const RowKind kind : kRowKinds) {
      if (!kept[kind]) continue;
      const LinkLoad<double> load = unit_load(kind, f);  // a column a body force: G is the transpose of that map
      const std::array<double, 3> on_i = {-load.fx, -load.fy, load.moment_i}, on_j = {load.fx, load.fy, load.moment_j};
      const auto add = [&](std::int64_t column, double value) {
        g.column.push_back(column);
        g.value.push_back(value);
      };
      const auto add_body = [&](std::int32_t body, const std::array<double, 3>& at) {
        if (!network.is_free(body)) return;
        for (int d = 0; d < per_body; ++d) add(static_cast<std::int64_t>(per_body) * body + d, at[idx(d)]);
      };
      if (link.i == link.j)
        add_body(link.i, {on_i[0] + on_j[0], on_i[1] + on_j[1], on_i[2] + on_j[2]});
      else if (link.i < link.j)
        add_body(link.i, on_i), add_body(link.j, on_j);
      else
        add_body(link.j, on_j), add_body(link.i, on_i);
      if (cell_free) add(g.layout.strain_column(0), -load.fx * r[0]), add(g.layout.strain_column(1), -load.fy * r[1]);
      g.row_start.push_back(static_cast<std::int64_t>(g.column.size()));
      g.link_of_row.push_back(static_cast<std::int32_t>(l));
      g.kind.push_back(kind);
    }
  }
  for (std::size_t l = packing.links.size(); l < network.links(); ++l)
    for (const RowKind kind : kRowKinds)
      if (rows_of_area(law)[kind]) add_area_row(g, network, l, kind, cell_free);
  return g;
}

std::vector<double> RigidityMatrix::link_velocities(const std::vector<double>& u) const {
  std::vector<double> result(idx(rows()));
  for (std::size_t r = 0; r < result.size(); ++r) {
    double sum = 0;
    for (std::int64_t e = row_start[r]; e < row_start[r + 1]; ++e) {
      const auto k = idx(e);
      sum += value[k] * u[idx(column[k])];
    }
    result[r] = sum;
  }
  return result;
}

std::vector<double> RigidityMatrix::body_forces(const std::vector<double>& f) const {
  std::vector<double> result(idx(columns()), 0.0);
  for (std::size_t r = 0; r < f.size(); ++r)
    for (std::int64_t e = row_start[r]; e < row_start[r + 1]; ++e) {
      const auto k = idx(e);
      result[idx(column[k])] += value[k] * f[r];
    }
  return result;
}

std::vector<double> body_velocities(const Packing<2>& packing, const DofLayout& layout, const Vec2& strain_rate) {
  std::vector<double> u(idx(layout.size()), 0.0);
  const auto per_body = idx(layout.per_body);
  for (std::size_t i = 0; i < idx(layout.bodies); ++i) {
    u[per_body * i] = packing.bodies.velocity[i][0];
    u[per_body * i + 1] = packing.bodies.velocity[i][1];
    if (per_body == 3) u[per_body * i + 2] = packing.bodies.spin[i];
  }
  for (int a = 0; a < layout.strains; ++a) u[idx(layout.strain_column(a))] = strain_rate[a];
  return u;
}

std::vector<double> link_forces(const LinkNetwork& network, const RigidityMatrix& matrix) {
  std::vector<double> f(idx(matrix.rows()));
  for (std::size_t r = 0; r < f.size(); ++r) {
    const auto l = idx(matrix.link_of_row[r]);
    if (network.is_area(l)) {
      const AreaLink& area = network.area(l);
      f[r] = matrix.kind[r] == RowKind::normal ? area.pressure : area.tangential_force;
      continue;
    }
    const Link<2>& link = network.packing.links[l];
    f[r] = ByRow<double>{link.normal_force, link.tangential_force, link.moment}[matrix.kind[r]];
  }
  return f;
}

}  // namespace isostat
