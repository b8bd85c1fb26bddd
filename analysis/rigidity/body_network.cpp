#include "analysis/rigidity/body_network.hpp"

#include <algorithm>

namespace isostat {

template <class F>
std::vector<BodyRow<F>> body_rows(const Packing<2>& packing, NetworkLaw law, bool cell_free, const RigidBodies& bodies,
                                  const FieldGeometry<F>& geometry) {
  std::vector<BodyRow<F>> rows;
  const bool points = law == NetworkLaw::frictionless;
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const Link<2>& link = packing.links[l];
    const auto i = static_cast<std::size_t>(link.i), j = static_cast<std::size_t>(link.j);
    BodyRow<F> row;
    row.a = bodies.body_of[i], row.b = bodies.body_of[j], row.link = static_cast<std::int32_t>(l);
    const ImageShift<2> image = bodies.image(link);
    const bool own_image = image[0] != 0 || image[1] != 0;
    if (row.a == row.b && !own_image) continue;

    const LinkRows kept = rows_of(link.kind, law);
    const FieldVec<F> r = geometry.branch(link);
    const FieldVec<F> x = geometry.placed(i, bodies.placement[i]);
    const FieldVec<F> back = geometry.offset(image);

    // Component of the relative velocity at `point` along `direction`: u_b(point - back) - e back - u_a(point).
    const auto add_row = [&](std::int8_t component, const FieldVec<F>& direction, const FieldVec<F>& point) {
      row.component = component;
      row.at_a = {-direction[0], -direction[1], F{}};
      row.at_b = {direction[0], direction[1], F{}};
      if (!points) {
        const auto moment = [&](const F& px, const F& py) { return px * direction[1] - py * direction[0]; };
        row.at_a[2] = -moment(point[0], point[1]);
        row.at_b[2] = moment(point[0] - back[0], point[1] - back[1]);
      }
      row.at_strain = {};
      if (cell_free) row.at_strain = {-(back[0] * direction[0]), -(back[1] * direction[1])};
      if (row.a == row.b) {
        for (std::size_t d = 0; d < 3; ++d) row.at_a[d] = row.at_a[d] + row.at_b[d];
        row.at_b = {};
      }
      rows.push_back(row);
    };
    if (kept.normal) add_row(0, r, x);
    if (kept.tangential) {
      // direction (R_i + R_j) z x r, at x + r R_i / (R_i + R_j): the moment is scaled like the direction.
      const F sum = geometry.radius[i] + geometry.radius[j];
      const FieldVec<F> t = {-r[1], r[0]};
      add_row(1, {t[0] * sum, t[1] * sum}, x);
      const F arm = geometry.radius[i] * (r[0] * r[0] + r[1] * r[1]);  // R_i (r x t) beyond the moment at x
      BodyRow<F>& last = rows.back();
      if (row.a != row.b) {  // on one body the two terms cancel
        last.at_a[2] = last.at_a[2] - arm;
        last.at_b[2] = last.at_b[2] + arm;
      }
    }
    if (kept.moment && row.a != row.b) {
      row.component = 2;
      row.at_a = {F{}, F{}, -F(1)};
      row.at_b = {F{}, F{}, F(1)};
      row.at_strain = {};
      rows.push_back(row);
    }
  }
  return rows;
}

namespace {

// Rank of up to three vectors of `dofs` entries, by elimination.
template <class F>
bool independent(std::array<std::array<F, 3>, 3> v, int count, int dofs) {
  const auto n = static_cast<std::size_t>(dofs), m = static_cast<std::size_t>(count);
  if (m > n) return false;
  for (std::size_t k = 0; k < m; ++k) {
    std::size_t c = 0;
    while (c < n && v[k][c].is_zero()) ++c;
    if (c == n) return false;
    for (std::size_t other = k + 1; other < m; ++other) {
      const F factor = v[other][c], pivot = v[k][c];  // fraction-free: v_o <- pivot v_o - factor v_k
      for (std::size_t d = 0; d < n; ++d) v[other][d] = pivot * v[other][d] - factor * v[k][d];
    }
  }
  return true;
}

}  // namespace

template <class F>
PrunedNetwork prune(const std::vector<BodyRow<F>>& rows, std::int32_t body_count, int dofs) {
  const auto n = static_cast<std::size_t>(body_count);
  std::vector<std::int32_t> degree(n, 0);
  for (const auto& row : rows) {
    ++degree[static_cast<std::size_t>(row.a)];
    if (row.b != row.a) ++degree[static_cast<std::size_t>(row.b)];
  }
  std::vector<std::int32_t> start(n + 1, 0);
  for (std::size_t b = 0; b < n; ++b) start[b + 1] = start[b] + degree[b];
  std::vector<std::int32_t> incident(static_cast<std::size_t>(start[n]));
  {
    std::vector<std::int32_t> next(start.begin(), start.end() - 1);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      incident[static_cast<std::size_t>(next[static_cast<std::size_t>(rows[r].a)]++)] = static_cast<std::int32_t>(r);
      if (rows[r].b != rows[r].a)
        incident[static_cast<std::size_t>(next[static_cast<std::size_t>(rows[r].b)]++)] = static_cast<std::int32_t>(r);
    }
  }

  PrunedNetwork result;
  std::vector<char> row_gone(rows.size(), 0), body_gone(n, 0);
  std::vector<std::int32_t> queue;
  for (std::size_t b = n; b-- > 0;)
    if (degree[b] > 0 && degree[b] <= dofs) queue.push_back(static_cast<std::int32_t>(b));
  while (!queue.empty()) {
    const std::int32_t body = queue.back();
    const auto b = static_cast<std::size_t>(body);
    queue.pop_back();
    if (body_gone[b] || degree[b] == 0 || degree[b] > dofs) continue;
    std::array<std::array<F, 3>, 3> entries{};
    std::array<std::int32_t, 3> mine{};
    int count = 0;
    for (std::int32_t e = start[b]; e < start[b + 1]; ++e) {
      const std::int32_t r = incident[static_cast<std::size_t>(e)];
      if (row_gone[static_cast<std::size_t>(r)]) continue;
      const auto& row = rows[static_cast<std::size_t>(r)];
      mine[static_cast<std::size_t>(count)] = r;
      entries[static_cast<std::size_t>(count++)] = row.a == body ? row.at_a : row.at_b;
    }
    if (!independent(entries, count, dofs)) continue;
    body_gone[b] = 1;
    result.pruned.push_back({body, count, mine});
    result.pruned_rank += count;
    for (int k = 0; k < count; ++k) {
      const auto r = static_cast<std::size_t>(mine[static_cast<std::size_t>(k)]);
      row_gone[r] = 1;
      const std::int32_t other = rows[r].a == body ? rows[r].b : rows[r].a;
      if (other == body) continue;
      if (--degree[static_cast<std::size_t>(other)] <= dofs) queue.push_back(other);
    }
  }
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (!row_gone[r]) result.rows.push_back(static_cast<std::int32_t>(r));
  for (std::size_t b = 0; b < n; ++b)
    if (!body_gone[b]) result.bodies.push_back(static_cast<std::int32_t>(b));
  return result;
}

template std::vector<BodyRow<FirstField>> body_rows(const Packing<2>&, NetworkLaw, bool, const RigidBodies&,
                                                    const FieldGeometry<FirstField>&);
template std::vector<BodyRow<SecondField>> body_rows(const Packing<2>&, NetworkLaw, bool, const RigidBodies&,
                                                     const FieldGeometry<SecondField>&);
template std::vector<BodyRow<WideField>> body_rows(const Packing<2>&, NetworkLaw, bool, const RigidBodies&,
                                                   const FieldGeometry<WideField>&);
template PrunedNetwork prune(const std::vector<BodyRow<FirstField>>&, std::int32_t, int);
template PrunedNetwork prune(const std::vector<BodyRow<WideField>>&, std::int32_t, int);

}  // namespace isostat
