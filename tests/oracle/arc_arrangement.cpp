#include "tests/oracle/arc_arrangement.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace isostat::oracle {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
using Name = std::tuple<int, int, int>;  // other disk and its image

struct Cover {
  double from, to;  // [rad] covered, anticlockwise, from in [0, 2 pi)
  Name by;
};
struct Arc {
  double start, sweep;
  Name opened_by, closed_by;  // which cover ended where the arc starts, and began where it ends
};

std::vector<std::vector<Arc>> exposed_arcs(const Disks& d) {
  const int n = static_cast<int>(d.centre.size());
  const auto centre = [&](int i) { return d.centre[static_cast<std::size_t>(i)]; };
  const auto radius = [&](int i) { return d.radius[static_cast<std::size_t>(i)]; };
  const double largest = *std::max_element(d.radius.begin(), d.radius.end());
  const int reach_x = 1 + static_cast<int>(2 * largest / d.cell.length[0]),
            reach_y = 1 + static_cast<int>(2 * largest / d.cell.length[1]);
  std::vector<std::vector<Arc>> arcs(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    std::vector<Cover> covers;
    bool hidden = false;
    for (int j = 0; j < n && !hidden; ++j)
      for (int sx = -reach_x; sx <= reach_x && !hidden; ++sx)
        for (int sy = -reach_y; sy <= reach_y && !hidden; ++sy) {
          if (i == j && sx == 0 && sy == 0) continue;
          const Vec2 b = centre(j) + d.cell.offset({sx, sy}) - centre(i);
          const double dist = norm(b);
          if (dist >= radius(i) + radius(j) || dist + radius(j) <= radius(i)) continue;
          if (dist + radius(i) <= radius(j)) {
            hidden = true;
            continue;
          }
          const double half =
              std::acos((dist * dist + radius(i) * radius(i) - radius(j) * radius(j)) / (2 * dist * radius(i)));
          double from = std::atan2(b[1], b[0]) - half;
          from -= kTwoPi * std::floor(from / kTwoPi);
          covers.push_back({from, from + 2 * half, {j, sx, sy}});
        }
    if (hidden) continue;
    if (covers.empty()) {
      arcs[static_cast<std::size_t>(i)].push_back({0, kTwoPi, {-1, 0, 0}, {-1, 0, 0}});
      continue;
    }
    std::sort(covers.begin(), covers.end(), [](const Cover& a, const Cover& b) { return a.from < b.from; });
    // Sweep twice around so that covers across the zero direction are seen.
    const auto m = covers.size();
    double end = covers[0].to;
    Name last = covers[0].by;
    for (std::size_t k = 1; k <= 2 * m; ++k) {
      const auto& c = covers[k % m];
      const double from = c.from + kTwoPi * static_cast<double>(k / m), to = c.to + kTwoPi * static_cast<double>(k / m);
      if (from > end && k > m) arcs[static_cast<std::size_t>(i)].push_back({end, from - end, last, c.by});
      if (to > end) end = to, last = c.by;
    }
  }
  return arcs;
}

}  // namespace

std::vector<WallArc> wall_arcs(const Disks& d) {
  std::vector<WallArc> out;
  const auto arcs = exposed_arcs(d);
  for (std::size_t i = 0; i < arcs.size(); ++i)
    for (const auto& a : arcs[i]) out.push_back({d.centre[i], d.radius[i], a.start, a.sweep});
  return out;
}

std::vector<WallLoop> wall_loops(const Disks& d) {
  const int n = static_cast<int>(d.centre.size());
  const auto centre = [&](int i) { return d.centre[static_cast<std::size_t>(i)]; };
  const auto radius = [&](int i) { return d.radius[static_cast<std::size_t>(i)]; };
  const auto arcs = exposed_arcs(d);
  // Where i dives under image (j, s), the wall goes on along j from where its cover by (i, -s) ends.
  std::vector<std::map<Name, std::size_t>> opened(static_cast<std::size_t>(n));
  std::vector<std::vector<bool>> done(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    for (std::size_t k = 0; k < arcs[i].size(); ++k) opened[i][arcs[i][k].opened_by] = k;
    done[i].assign(arcs[i].size(), false);
  }
  std::vector<WallLoop> loops;
  for (int i0 = 0; i0 < n; ++i0)
    for (std::size_t k0 = 0; k0 < arcs[static_cast<std::size_t>(i0)].size(); ++k0) {
      if (done[static_cast<std::size_t>(i0)][k0]) continue;
      WallLoop loop;
      int i = i0, sx = 0, sy = 0;
      std::size_t k = k0;
      do {
        const auto& a = arcs[static_cast<std::size_t>(i)][k];
        done[static_cast<std::size_t>(i)][k] = true;
        const Vec2 c = centre(i) + d.cell.offset({sx, sy}) - centre(i0);
        const double r = radius(i), e = a.start + a.sweep;
        loop.length += r * a.sweep;
        loop.signed_area +=
            0.5 * r *
            (r * a.sweep + c[0] * (std::sin(e) - std::sin(a.start)) - c[1] * (std::cos(e) - std::cos(a.start)));
        const auto& [j, tx, ty] = a.closed_by;
        if (j < 0) break;
        k = opened[static_cast<std::size_t>(j)].at({i, -tx, -ty});
        i = j, sx += tx, sy += ty;
      } while (i != i0 || k != k0);
      loop.winding = {sx, sy};
      loops.push_back(loop);
    }
  return loops;
}

}  // namespace isostat::oracle
