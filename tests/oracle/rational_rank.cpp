#include "tests/oracle/rational_rank.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "tests/oracle/rational_overlap.hpp"

namespace isostat {
namespace {

using Row = std::map<std::size_t, mpq_class>;

std::int64_t rank_by_elimination(std::vector<Row> rows) {
  std::map<std::size_t, Row> pivots;  // by leading column
  for (Row& row : rows) {
    while (true) {
      while (!row.empty() && row.begin()->second == 0) row.erase(row.begin());
      if (row.empty()) break;
      const std::size_t column = row.begin()->first;
      const auto pivot = pivots.find(column);
      if (pivot == pivots.end()) {
        pivots.emplace(column, row);
        break;
      }
      const mpq_class factor = row.begin()->second / pivot->second.begin()->second;
      for (const auto& [c, v] : pivot->second) row[c] -= factor * v;
      row.erase(column);
    }
  }
  return static_cast<std::int64_t>(pivots.size());
}

}  // namespace

std::int64_t rational_rank(const Packing<2>& p, NetworkLaw law, bool cell_free) {
  std::vector<Row> rows;
  bool beams = false;
  for (const Link<2>& l : p.links) beams = beams || l.kind == LinkKind::beam;
  const bool spins = law != NetworkLaw::frictionless || beams;
  const std::size_t per_body = spins ? 3 : 2, strain = per_body * p.bodies.size();
  for (const Link<2>& l : p.links) {
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    mpq_class d[2];
    for (int k = 0; k < 2; ++k) {
      d[k] = mpq_class(p.bodies.position[j][k]) - mpq_class(p.bodies.position[i][k]);
      if (p.cell) d[k] += mpq_class(p.cell->length[k]) * l.shift[static_cast<std::size_t>(k)];
      if (p.cell && k == 0) d[0] += mpq_class(p.cell->tilt) * l.shift[1];
    }
    const auto row_along = [&](const mpq_class& nx, const mpq_class& ny) {
      Row row;
      row[per_body * j] += nx, row[per_body * j + 1] += ny;
      row[per_body * i] -= nx, row[per_body * i + 1] -= ny;
      if (cell_free) row[strain] -= nx * d[0], row[strain + 1] -= ny * d[1];
      return row;
    };
    rows.push_back(row_along(d[0], d[1]));
    const bool beam =
        l.kind ==
        LinkKind::beam;  // whatever the law; lever arms of half the length (Poeschel and Buchholtz 1995, Sec. 3)
    const bool tangential = beam || (law != NetworkLaw::frictionless &&
                                     (l.kind == LinkKind::closed || l.kind == LinkKind::rolling_yielded));
    const bool moment =
        beam || (law == NetworkLaw::rolling && (l.kind == LinkKind::closed || l.kind == LinkKind::sliding));
    if (tangential) {
      Row row = row_along(-d[1], d[0]);
      const mpq_class square = d[0] * d[0] + d[1] * d[1], ri(beam ? 1 : p.bodies.radius[i]),
                      rj(beam ? 1 : p.bodies.radius[j]);
      row[3 * i + 2] -= square * ri / (ri + rj);
      row[3 * j + 2] -= square * rj / (ri + rj);
      rows.push_back(row);
    }
    if (moment) {
      Row row;
      row[3 * j + 2] += 1, row[3 * i + 2] -= 1;
      rows.push_back(row);
    }
  }
  if (!p.part.empty())
    for (Row& row : rows)
      std::erase_if(row, [&](const auto& entry) {
        return entry.first < strain && p.part[entry.first / per_body] != GrainPart::free;
      });
  return rank_by_elimination(std::move(rows));
}

std::int64_t rational_rank(const Packing<3>& p, NetworkLaw law, bool cell_free) {
  std::vector<Row> rows;
  const bool friction = law != NetworkLaw::frictionless;
  const std::size_t per_body = friction ? 6 : 3, strain = per_body * p.bodies.size();
  for (const Link<3>& l : p.links) {
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    mpq_class d[3];
    for (int k = 0; k < 3; ++k) {
      d[k] = mpq_class(p.bodies.position[j][k]) - mpq_class(p.bodies.position[i][k]);
      if (p.cell) d[k] += mpq_class(p.cell->length[k]) * l.shift[static_cast<std::size_t>(k)];
      if (p.cell && k == 0) d[0] += mpq_class(p.cell->tilt) * l.shift[1];
    }
    const mpq_class ri(p.bodies.radius[i]), rj(p.bodies.radius[j]);
    const bool sticks = friction && (l.kind == LinkKind::closed || l.kind == LinkKind::rolling_yielded);
    const bool rolls = law == NetworkLaw::rolling && (l.kind == LinkKind::closed || l.kind == LinkKind::sliding);
    if (!sticks) {
      Row row;
      for (std::size_t k = 0; k < 3; ++k) {
        row[per_body * j + k] += d[k], row[per_body * i + k] -= d[k];
        if (cell_free) row[strain + k] -= d[k] * d[k];
      }
      rows.push_back(row);
    }
    // v_j - w_j x l_j n - v_i - w_i x l_i n, l n = R r / (R_i + R_j); (w x d)_k = w_a d_b - w_b d_a for k, a, b cyclic.
    for (std::size_t k = 0; sticks && k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      Row row;
      row[per_body * j + k] += 1, row[per_body * i + k] -= 1;
      if (cell_free) row[strain + k] -= d[k];
      for (const auto& [body, lever] : {std::pair{i, mpq_class(ri / (ri + rj))}, {j, mpq_class(rj / (ri + rj))}}) {
        row[per_body * body + 3 + a] -= lever * d[b];
        row[per_body * body + 3 + b] += lever * d[a];
      }
      rows.push_back(row);
    }
    for (std::size_t k = 3; rolls && k < 6; ++k) {
      Row row;
      row[per_body * j + k] += 1, row[per_body * i + k] -= 1;
      rows.push_back(row);
    }
  }
  if (!p.part.empty())
    for (Row& row : rows)
      std::erase_if(row, [&](const auto& entry) {
        return entry.first < strain && p.part[entry.first / per_body] != GrainPart::free;
      });
  return rank_by_elimination(std::move(rows));
}

namespace {

using oracle::RationalPoint;
mpq_class cross(const RationalPoint& a, const RationalPoint& b) { return a.x * b.y - a.y * b.x; }
RationalPoint minus(const RationalPoint& a, const RationalPoint& b) { return {a.x - b.x, a.y - b.y}; }

struct RationalTriangle {
  std::array<RationalPoint, 3> corner;
  RationalPoint centre;
  RationalTriangle(const Triangle& t, const mpq_class& ox, const mpq_class& oy) {
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = {mpq_class(t.corner[k][0]) + ox, mpq_class(t.corner[k][1]) + oy};
      centre = {centre.x + corner[k].x / 3, centre.y + corner[k].y / 3};
    }
  }
  // Part of one of its edges that the side from p to q is; 0 if it lies on none.
  mpq_class part_of_edge(const RationalPoint& p, const RationalPoint& q) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const RationalPoint u = minus(corner[(k + 1) % 3], corner[k]), side = minus(q, p);
      if (cross(u, minus(p, corner[k])) == 0 && cross(u, minus(q, corner[k])) == 0)
        return abs((side.x * u.x + side.y * u.y) / (u.x * u.x + u.y * u.y));
    }
    return 0;
  }
};

// Force on, and moment about the centre of, a triangle.
struct Load {
  std::size_t body;
  RationalPoint at;  // centre of the image
  mpq_class fx, fy, moment;
};

struct Overlapping {
  std::vector<Load> loads;  // of unit pressure
  struct Pair {
    std::size_t i, j;
    RationalPoint at_i, at_j, point;
    mpq_class area;
  };
  std::vector<Pair> pairs;
};

}  // namespace

std::int64_t rational_rank(const TrianglePacking& p, const std::vector<Triangle>& triangles, NetworkLaw law,
                           bool cell_free) {
  const std::size_t n = p.bodies.size(), strain = 3 * n;
  std::vector<Row> rows;
  const auto add_row = [&](const std::vector<Load>& loads) {
    Row row;
    for (const Load& l : loads) {
      row[3 * l.body] += l.fx, row[3 * l.body + 1] += l.fy, row[3 * l.body + 2] += l.moment;
      if (cell_free) row[strain] -= l.fx * l.at.x, row[strain + 1] -= l.fy * l.at.y;
    }
    rows.push_back(row);
  };
  const auto offset = [&](const ImageShift<2>& s, int k) {
    return p.cell ? mpq_class(p.cell->length[k]) * s[static_cast<std::size_t>(k)] : mpq_class(0);
  };
  for (const Link<2>& l : p.links) {
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    const RationalPoint a = RationalTriangle(triangles[i], 0, 0).centre,
                        b = RationalTriangle(triangles[j], offset(l.shift, 0), offset(l.shift, 1)).centre;
    const RationalPoint d = minus(b, a);
    const mpq_class arm = (d.x * d.x + d.y * d.y) / 2;
    add_row({{i, a, -d.x, -d.y, 0}, {j, b, d.x, d.y, 0}});
    add_row({{i, a, d.y, -d.x, -arm}, {j, b, -d.y, d.x, -arm}});
    add_row({{i, a, 0, 0, -1}, {j, b, 0, 0, 1}});
  }

  const std::vector<std::int32_t> grain = grain_of(p.grains);
  std::map<std::tuple<std::int32_t, std::int32_t, ImageShift<2>>, Overlapping> overlaps;
  const int reach = p.cell ? 3 : 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (int sx = -reach; sx <= reach; ++sx)
        for (int sy = -reach; sy <= reach; ++sy) {
          const ImageShift<2> s{sx, sy}, back{-sx, -sy};
          if (grain[i] > grain[j] || (grain[i] == grain[j] && s <= back)) continue;
          Triangle image = triangles[j];
          for (Vec2& c : image.corner) c += Vec2{{offset(s, 0).get_d(), offset(s, 1).get_d()}};
          double apart = 0, extent = 0;  // far ones cost more than they are worth
          for (int k = 0; k < 2; ++k) apart = std::max(apart, std::abs(image.corner[0][k] - triangles[i].corner[0][k]));
          for (const Triangle* t : {&triangles[i], &triangles[j]})
            for (const Vec2& c : t->corner) extent = std::max(extent, norm(c - t->corner[0]));
          if (apart > 2 * extent) continue;
          const oracle::RationalOverlap o = oracle::rational_overlap(triangles[i], image);
          if (!(o.area > 0)) continue;
          const RationalTriangle a(triangles[i], 0, 0), b(image, 0, 0);
          Load on_a{i, a.centre, 0, 0, 0}, on_b{j, b.centre, 0, 0, 0};
          Overlapping::Pair pair{i, j, a.centre, b.centre, {}, o.area};
          const std::size_t corners = o.polygon.size();
          mpq_class parts;
          for (std::size_t k = 0; k < corners; ++k) {
            const RationalPoint &from = o.polygon[k], &to = o.polygon[(k + 1) % corners], side = minus(to, from);
            const mpq_class of_a = a.part_of_edge(from, to), part = of_a > 0 ? of_a : b.part_of_edge(from, to);
            Load& on = of_a > 0 ? on_a : on_b;
            const RationalPoint middle{(from.x + to.x) / 2, (from.y + to.y) / 2}, arm = minus(middle, on.at);
            on.fx -= side.y, on.fy += side.x;  // pressure acts against the outward normal (side.y, -side.x)
            on.moment += arm.x * side.x + arm.y * side.y;
            parts += part, pair.point.x += part * middle.x, pair.point.y += part * middle.y;
          }
          pair.point.x /= parts, pair.point.y /= parts;
          Overlapping& all = overlaps[{grain[i], grain[j], s}];
          all.loads.push_back(on_a), all.loads.push_back(on_b);
          all.pairs.push_back(pair);
        }
  for (const auto& [key, o] : overlaps) {
    add_row(o.loads);
    if (law == NetworkLaw::frictionless) continue;
    RationalPoint force, point;  // on the second grain
    mpq_class area;
    for (std::size_t k = 1; k < o.loads.size(); k += 2) force.x += o.loads[k].fx, force.y += o.loads[k].fy;
    for (const auto& q : o.pairs) area += q.area, point.x += q.area * q.point.x, point.y += q.area * q.point.y;
    point.x /= area, point.y /= area;
    std::vector<Load> loads;
    for (const auto& q : o.pairs) {
      const RationalPoint t{-force.y * q.area, force.x * q.area};
      loads.push_back({q.i, q.at_i, -t.x, -t.y, -cross(minus(point, q.at_i), t)});
      loads.push_back({q.j, q.at_j, t.x, t.y, cross(minus(point, q.at_j), t)});
    }
    add_row(loads);
  }
  return rank_by_elimination(std::move(rows));
}

}  // namespace isostat
