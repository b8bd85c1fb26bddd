#include "tests/oracle/rational_rank.hpp"

#include <gmpxx.h>

#include <map>

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

}  // namespace isostat
