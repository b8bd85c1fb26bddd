#include "tests/support/random_spheres.hpp"

#include <cmath>
#include <random>

#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

double shortened(double x) { return std::ldexp(std::round(std::ldexp(x, 8)), -8); }

struct Wrapped {
  int at, cells;
};
Wrapped wrapped(int v, int size) { return {((v % size) + size) % size, v < 0 ? -((size - 1 - v) / size) : v / size}; }

}  // namespace

Packing<3> random_spheres(const RandomSpheres& o) {
  std::mt19937_64 random(o.seed);
  std::uniform_real_distribution<> unit(0.0, 1.0);
  Packing<3> p;
  const auto [nx, ny, nz] = o.size;
  if (o.periodic)
    p.cell = PeriodicCell<3>{{static_cast<double>(nx), static_cast<double>(ny), static_cast<double>(nz)}, o.tilt};
  p.bodies.resize(idx(nx) * idx(ny) * idx(nz));
  const auto index = [&](int x, int y, int z) { return (z * ny + y) * nx + x; };
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        const auto i = idx(index(x, y, z));
        const auto near = [&](int v) { return shortened(v + o.jitter * (unit(random) - 0.5)); };
        p.bodies.id[i] = static_cast<std::int64_t>(i) + 1;
        p.bodies.position[i] = {{near(x), near(y), near(z)}};
        p.bodies.radius[i] = o.equal_radii ? 0.5 : shortened(0.3 + 0.2 * unit(random));
        p.bodies.mass[i] = 8 * std::pow(p.bodies.radius[i], 3);
        p.bodies.inertia[i] = 0.4 * p.bodies.mass[i] * p.bodies.radius[i] * p.bodies.radius[i];
      }
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        for (int way = 14; way < 27; ++way) {  // half of the 26 neighbours
          const auto [tx, sx] = wrapped(x + way % 3 - 1, nx);
          const auto [ty, sy] = wrapped(y + way / 3 % 3 - 1, ny);
          const auto [tz, sz] = wrapped(z + way / 9 - 1, nz);
          if (unit(random) * 26 > o.coordination) continue;
          const ImageShift<3> shift{sx, sy, sz};
          if (!o.periodic && shift != ImageShift<3>{}) continue;
          Link<3> link;
          link.i = index(x, y, z), link.j = index(tx, ty, tz), link.shift = shift;
          const double kind = unit(random), a = o.distant, b = a + o.sliding, c = b + o.rolling_yielded,
                       d = c + o.both_yielded;
          link.kind = kind < a   ? LinkKind::distant
                      : kind < b ? LinkKind::sliding
                      : kind < c ? LinkKind::rolling_yielded
                      : kind < d ? LinkKind::both_yielded
                                 : LinkKind::closed;
          link.gap = frame(ends(p, link)).gap;
          p.links.push_back(link);
        }
  return p;
}

Packing<3> replicated(const Packing<3>& packing, int n) {
  Packing<3> copy;
  copy.cell = PeriodicCell<3>{static_cast<double>(n) * packing.cell->length};
  const auto block = static_cast<std::int32_t>(packing.bodies.size());
  copy.bodies.resize(packing.bodies.size() * idx(n) * idx(n) * idx(n));
  std::size_t at = 0;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        for (std::size_t i = 0; i < packing.bodies.size(); ++i, ++at) {
          copy.bodies.id[at] = static_cast<std::int64_t>(at) + 1;
          copy.bodies.position[at] = packing.bodies.position[i] + packing.cell->offset({x, y, z});
          copy.bodies.radius[at] = packing.bodies.radius[i];
          copy.bodies.mass[at] = packing.bodies.mass[i];
          copy.bodies.inertia[at] = packing.bodies.inertia[i];
        }
        for (Link<3> link : packing.links) {
          const auto [tx, sx] = wrapped(x + link.shift[0], n);
          const auto [ty, sy] = wrapped(y + link.shift[1], n);
          const auto [tz, sz] = wrapped(z + link.shift[2], n);
          link.i += ((z * n + y) * n + x) * block, link.j += ((tz * n + ty) * n + tx) * block;
          link.shift = {sx, sy, sz};
          copy.links.push_back(link);
        }
      }
  return copy;
}

}  // namespace isostat
