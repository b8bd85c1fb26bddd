// The rigidity matrix of spheres in doubles.
#include <algorithm>
#include <cmath>

#include "analysis/rigidity/link_rows_3d.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "dem/input_error.hpp"
#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

Vec3 normal_of(const Packing<3>& packing, const Link<3>& link) { return {frame(ends(packing, link)).n}; }

// An orthonormal frame n, t1, t2: t1 comes from the axis that n is farthest from.
std::array<Vec3, 3> contact_frame(const Vec3& n) {
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(n[k]) < std::abs(n[axis])) axis = k;
  Vec3 t = -n[axis] * n;
  t[axis] += 1;
  t = (1 / norm(t)) * t;
  return {n, t, {cross_3d<double>(n.c, t.c)}};
}

}  // namespace

RigidityMatrix rigidity_matrix(const SphereNetwork& network, NetworkLaw law, bool cell_free) {
  const Packing<3>& packing = network.packing;
  if (cell_free && !packing.cell) throw InputError("command line", 0, "--cell", "free", "the input has no cell");
  RigidityMatrix g;
  g.layout = dof_layout(network, law, cell_free);
  const auto per_body = idx(g.layout.per_body);
  const auto rows = idx(row_count(network, law));
  g.row_start.reserve(rows + 1), g.link_of_row.reserve(rows), g.kind.reserve(rows), g.axis.reserve(rows);
  g.row_start.push_back(0);

  for (std::size_t l = 0; l < network.links(); ++l) {
    const Link<3>& link = packing.links[l];
    const LinkEnds<3> where = ends(packing, link);
    const LinkFrame3<double> f = frame(where);
    const SphereRows kept = sphere_rows(link.kind, law);
    for (int k = 0; k < kept.count(); ++k) {
      const SphereRow row = kept.at(k);
      const LinkLoad3<double> load = unit_load<double>(row, f);  // G is the transpose of the map to body forces
      std::array<double, 6> on_i, on_j;
      for (std::size_t d = 0; d < 3; ++d) {
        on_i[d] = -load.force[d], on_j[d] = load.force[d];
        on_i[3 + d] = load.moment_i[d], on_j[3 + d] = load.moment_j[d];
      }
      const auto add = [&](std::int64_t column, double value) {
        if (value != 0) g.column.push_back(column), g.value.push_back(value);
      };
      const auto add_body = [&](std::int32_t body, const std::array<double, 6>& at) {
        if (!network.is_free(body)) return;
        for (std::size_t d = 0; d < per_body; ++d) add(static_cast<std::int64_t>(per_body * idx(body) + d), at[d]);
      };
      if (link.i == link.j) {
        for (std::size_t d = 0; d < 6; ++d) on_i[d] += on_j[d];
        add_body(link.i, on_i);
      } else if (link.i < link.j) {
        add_body(link.i, on_i), add_body(link.j, on_j);
      } else {
        add_body(link.j, on_j), add_body(link.i, on_i);
      }
      for (int a = 0; cell_free && a < 3; ++a) add(g.layout.strain_column(a), -load.force[idx(a)] * where.branch[a]);
      g.row_start.push_back(static_cast<std::int64_t>(g.column.size()));
      g.link_of_row.push_back(static_cast<std::int32_t>(l));
      g.kind.push_back(row.kind);
      g.axis.push_back(static_cast<std::int8_t>(row.axis));
    }
  }
  return g;
}

RigidityMatrix in_contact_frames(const SphereNetwork& network, const RigidityMatrix& g) {
  RigidityMatrix turned;
  turned.layout = g.layout;
  turned.link_of_row = g.link_of_row, turned.kind = g.kind, turned.axis = g.axis;
  turned.row_start.push_back(0);
  std::vector<std::int64_t> columns;
  std::vector<double> value;
  for (std::size_t r = 0; r < idx(g.rows()); ++r) {
    if (g.kind[r] != RowKind::tangential) {
      turned.column.insert(turned.column.end(), g.column.begin() + g.row_start[r],
                           g.column.begin() + g.row_start[r + 1]);
      turned.value.insert(turned.value.end(), g.value.begin() + g.row_start[r], g.value.begin() + g.row_start[r + 1]);
      turned.row_start.push_back(static_cast<std::int64_t>(turned.column.size()));
      continue;
    }
    columns.assign(g.column.begin() + g.row_start[r], g.column.begin() + g.row_start[r + 3]);  // rows r, r + 1, r + 2
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    const auto frame = contact_frame(normal_of(network.packing, network.packing.links[idx(g.link_of_row[r])]));
    for (std::size_t k = 0; k < 3; ++k) {
      value.assign(columns.size(), 0.0);
      for (std::size_t a = 0; a < 3; ++a)
        for (auto e = idx(g.row_start[r + a]); e < idx(g.row_start[r + a + 1]); ++e)
          value[idx(std::lower_bound(columns.begin(), columns.end(), g.column[e]) - columns.begin())] +=
              frame[k][static_cast<int>(a)] * g.value[e];
      turned.column.insert(turned.column.end(), columns.begin(), columns.end());
      turned.value.insert(turned.value.end(), value.begin(), value.end());
      turned.row_start.push_back(static_cast<std::int64_t>(turned.column.size()));
      turned.kind[r + k] = k == 0 ? RowKind::normal : RowKind::tangential;
      turned.axis[r + k] = static_cast<std::int8_t>(k == 0 ? 0 : k - 1);
    }
    r += 2;
  }
  return turned;
}

Vec3 axis_in_frame(const SphereNetwork& network, const RigidityMatrix& g, std::size_t row) {
  const auto frame = contact_frame(normal_of(network.packing, network.packing.links[idx(g.link_of_row[row])]));
  return frame[g.kind[row] == RowKind::tangential ? 1 + idx(g.axis[row]) : 0];
}

std::vector<double> body_velocities(const Packing<3>& packing, const DofLayout& layout, const Vec3& strain_rate) {
  std::vector<double> u;
  u.reserve(idx(layout.size()));
  for (std::size_t i = 0; i < idx(layout.bodies); ++i) {
    u.insert(u.end(), packing.bodies.velocity[i].c.begin(), packing.bodies.velocity[i].c.end());
    if (layout.per_body == 6) u.insert(u.end(), packing.bodies.spin[i].c.begin(), packing.bodies.spin[i].c.end());
  }
  for (int a = 0; a < layout.strains; ++a) u.push_back(strain_rate[a]);
  return u;
}

std::vector<double> link_forces(const SphereNetwork& network, const RigidityMatrix& matrix) {
  std::vector<double> f(idx(matrix.rows()));
  for (std::size_t r = 0; r < f.size(); ++r) {
    const Link<3>& link = network.packing.links[idx(matrix.link_of_row[r])];
    const int axis = matrix.axis[r];
    if (matrix.kind[r] == RowKind::normal)
      f[r] = link.normal_force;
    else if (matrix.kind[r] == RowKind::rolling)
      f[r] = link.moment[axis];
    else
      f[r] = link.normal_force * normal_of(network.packing, link)[axis] + link.tangential_force[axis];
  }
  return f;
}

SphereForces by_link(const SphereNetwork& network, const RigidityMatrix& matrix, const std::vector<double>& of_row) {
  SphereForces f;
  f.normal.resize(network.links()), f.tangential.resize(network.links()), f.moment.resize(network.links());
  for (std::size_t r = 0; r < of_row.size(); ++r) {
    const auto l = idx(matrix.link_of_row[r]);
    if (matrix.kind[r] == RowKind::normal)
      f.normal[l] = of_row[r];
    else
      (matrix.kind[r] == RowKind::rolling ? f.moment : f.tangential)[l][matrix.axis[r]] = of_row[r];
  }
  for (std::size_t l = 0; l < network.links(); ++l) {
    const Vec3 n = normal_of(network.packing, network.packing.links[l]);
    const double along = dot(n, f.tangential[l]);
    f.normal[l] += along;
    f.tangential[l] -= along * n;
  }
  return f;
}

}  // namespace isostat
