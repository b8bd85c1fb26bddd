#include "analysis/rigidity/rigidity_matrix.hpp"

#include <algorithm>
#include <array>

#include "dem/input_error.hpp"
#include "dem/state/link.hpp"

namespace isostat {
namespace {

Vec2 branch_vector(const Packing<2>& packing, const Link<2>& link) {
  Vec2 r = packing.bodies.position[static_cast<std::size_t>(link.j)] -
           packing.bodies.position[static_cast<std::size_t>(link.i)];
  if (packing.cell) r += packing.cell->offset(link.shift);
  return r;
}

}  // namespace

RigidityMatrix rigidity_matrix(const Packing<2>& packing, NetworkLaw law, bool cell_free) {
  if (cell_free && !packing.cell) throw InputError("command line", 0, "--cell", "free", "the input has no cell");
  RigidityMatrix g;
  g.layout = dof_layout(packing.bodies.size(), law, cell_free);
  const auto rows = static_cast<std::size_t>(row_count(packing, law));
  const int per_body = g.layout.per_body;
  g.row_start.reserve(rows + 1);
  g.row_start.push_back(0);
  g.column.reserve(rows * static_cast<std::size_t>(2 * per_body + g.layout.strains));
  g.value.reserve(g.column.capacity());

  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const Link<2>& link = packing.links[l];
    const Vec2 r = branch_vector(packing, link);
    const auto f = link_frame(r[0], r[1], packing.bodies.radius[static_cast<std::size_t>(link.i)],
                              packing.bodies.radius[static_cast<std::size_t>(link.j)]);
    // One column a unit motion: the row entries are the link velocities of unit body velocities.
    const auto velocity = [&](double dvx, double dvy, double spin_i, double spin_j) {
      const auto v = link_velocity(f, dvx, dvy, spin_i, spin_j);
      return std::array<double, 3>{v.normal, v.tangential, v.rolling};
    };
    const std::array<std::array<double, 3>, 3> of_i = {velocity(-1, 0, 0, 0), velocity(0, -1, 0, 0),
                                                       velocity(0, 0, 1, 0)};
    const std::array<std::array<double, 3>, 3> of_j = {velocity(1, 0, 0, 0), velocity(0, 1, 0, 0),
                                                       velocity(0, 0, 0, 1)};
    const std::array<std::array<double, 3>, 2> of_strain = {velocity(-r[0], 0, 0, 0), velocity(0, -r[1], 0, 0)};

    const LinkRows kept = rows_of(link.kind, law);
    const std::array<bool, 3> present = {kept.normal, kept.tangential, kept.moment};
    for (std::size_t c = 0; c < 3; ++c) {
      if (!present[c]) continue;
      const bool j_first = link.j < link.i;
      const auto add = [&](std::int64_t column, double value) {
        g.column.push_back(column);
        g.value.push_back(value);
      };
      for (int d = 0; d < per_body; ++d) {
        const auto u = static_cast<std::size_t>(d);
        const std::int64_t base = static_cast<std::int64_t>(per_body) * (j_first ? link.j : link.i) + d;
        if (link.i == link.j)
          add(base, of_i[u][c] + of_j[u][c]);
        else
          add(base, j_first ? of_j[u][c] : of_i[u][c]);
      }
      if (link.i != link.j)
        for (int d = 0; d < per_body; ++d)
          add(static_cast<std::int64_t>(per_body) * (j_first ? link.i : link.j) + d,
              (j_first ? of_i : of_j)[static_cast<std::size_t>(d)][c]);
      for (int a = 0; a < g.layout.strains; ++a)
        add(g.layout.strain_column(a), of_strain[static_cast<std::size_t>(a)][c]);
      g.row_start.push_back(static_cast<std::int64_t>(g.column.size()));
      g.link_of_row.push_back(static_cast<std::int32_t>(l));
      g.component.push_back(static_cast<std::int8_t>(c));
    }
  }
  return g;
}

std::vector<double> RigidityMatrix::link_velocities(const std::vector<double>& u) const {
  std::vector<double> result(static_cast<std::size_t>(rows()));
  for (std::size_t r = 0; r < result.size(); ++r) {
    double sum = 0;
    for (std::int64_t e = row_start[r]; e < row_start[r + 1]; ++e) {
      const auto k = static_cast<std::size_t>(e);
      sum += value[k] * u[static_cast<std::size_t>(column[k])];
    }
    result[r] = sum;
  }
  return result;
}

std::vector<double> RigidityMatrix::body_forces(const std::vector<double>& f) const {
  std::vector<double> result(static_cast<std::size_t>(columns()), 0.0);
  for (std::size_t r = 0; r < f.size(); ++r)
    for (std::int64_t e = row_start[r]; e < row_start[r + 1]; ++e) {
      const auto k = static_cast<std::size_t>(e);
      result[static_cast<std::size_t>(column[k])] += value[k] * f[r];
    }
  return result;
}

std::vector<double> body_velocities(const Packing<2>& packing, const DofLayout& layout, const Vec2& strain_rate) {
  std::vector<double> u(static_cast<std::size_t>(layout.size()), 0.0);
  const auto per_body = static_cast<std::size_t>(layout.per_body);
  for (std::size_t i = 0; i < packing.bodies.size(); ++i) {
    u[per_body * i] = packing.bodies.velocity[i][0];
    u[per_body * i + 1] = packing.bodies.velocity[i][1];
    if (per_body == 3) u[per_body * i + 2] = packing.bodies.spin[i];
  }
  for (int a = 0; a < layout.strains; ++a) u[static_cast<std::size_t>(layout.strain_column(a))] = strain_rate[a];
  return u;
}

std::vector<double> link_forces(const Packing<2>& packing, const RigidityMatrix& matrix) {
  std::vector<double> f(static_cast<std::size_t>(matrix.rows()));
  for (std::size_t r = 0; r < f.size(); ++r) {
    const Link<2>& link = packing.links[static_cast<std::size_t>(matrix.link_of_row[r])];
    f[r] = matrix.component[r] == 0   ? link.normal_force
           : matrix.component[r] == 1 ? link.tangential_force
                                      : link.moment;
  }
  return f;
}

}  // namespace isostat
