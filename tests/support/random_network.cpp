#include "tests/support/random_network.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace isostat {

Packing<2> random_network(const RandomNetwork& o) {
  std::mt19937_64 random(o.seed);
  std::uniform_real_distribution<> unit(0.0, 1.0);
  Packing<2> p;
  const double height = std::sqrt(3.0) / 2;
  const int rows = o.periodic ? o.rows + o.rows % 2 : o.rows;  // the stagger closes over an even number of rows
  if (o.periodic) p.cell = PeriodicCell<2>{{static_cast<double>(o.columns), rows * height}};
  const auto n = static_cast<std::size_t>(o.columns) * static_cast<std::size_t>(rows);
  p.bodies.resize(n);
  const auto index = [&](int x, int y) { return static_cast<std::int32_t>(y * o.columns + x); };
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < o.columns; ++x) {
      const auto i = static_cast<std::size_t>(index(x, y));
      p.bodies.id[i] = static_cast<std::int64_t>(i);
      p.bodies.position[i] = {
          {x + 0.5 * (y % 2) + o.jitter * (unit(random) - 0.5), y * height + o.jitter * (unit(random) - 0.5)}};
      p.bodies.radius[i] = 0.25 + 0.25 * unit(random);
      p.bodies.mass[i] = 4 * p.bodies.radius[i] * p.bodies.radius[i];
      p.bodies.inertia[i] = 0.5 * p.bodies.mass[i] * p.bodies.radius[i] * p.bodies.radius[i];
    }
  const auto add = [&](int x, int y, int to_x, int to_y) {
    Link<2> link;
    link.i = index(x, y);
    if (o.periodic) {
      const auto wrap = [](int v, int size) {
        return std::pair{((v % size) + size) % size, static_cast<int>(std::floor(static_cast<double>(v) / size))};
      };
      const auto [wx, sx] = wrap(to_x, o.columns);
      const auto [wy, sy] = wrap(to_y, rows);
      link.j = index(wx, wy), link.shift = {sx, sy};
    } else {
      if (to_x < 0 || to_x >= o.columns || to_y < 0 || to_y >= rows) return;
      link.j = index(to_x, to_y);
    }
    if (unit(random) * 6 > o.coordination) return;
    const double kind = unit(random);
    const double a = o.distant, b = a + o.sliding, c = b + o.rolling_yielded, d = c + o.both_yielded;
    link.kind = kind < a   ? LinkKind::distant
                : kind < b ? LinkKind::sliding
                : kind < c ? LinkKind::rolling_yielded
                : kind < d ? LinkKind::both_yielded
                           : LinkKind::closed;
    Vec2 r = p.bodies.position[static_cast<std::size_t>(link.j)] - p.bodies.position[static_cast<std::size_t>(link.i)];
    if (p.cell) r += p.cell->offset(link.shift);
    link.gap =
        norm(r) - p.bodies.radius[static_cast<std::size_t>(link.i)] - p.bodies.radius[static_cast<std::size_t>(link.j)];
    p.links.push_back(link);
  };
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < o.columns; ++x) {
      add(x, y, x + 1, y);
      add(x, y, x + y % 2, y + 1);
      add(x, y, x + y % 2 - 1, y + 1);
    }
  return p;
}

}  // namespace isostat
