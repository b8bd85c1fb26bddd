#include "analysis/stiffness/area_tangent.hpp"

#include "analysis/rigidity/area_rows.hpp"
#include "dem/triangles/touching_triangles.hpp"

namespace isostat {
namespace {

// A number and its derivatives to x, y, angle of the two triangles of a pair.
struct Dual {
  double value = 0;
  std::array<double, 6> d{};
};
template <class F>
Dual combined(double value, F&& derivative) {
  Dual r{value, {}};
  for (std::size_t k = 0; k < 6; ++k) r.d[k] = derivative(k);
  return r;
}
Dual operator+(const Dual& a, const Dual& b) {
  return combined(a.value + b.value, [&](std::size_t k) { return a.d[k] + b.d[k]; });
}
Dual operator-(const Dual& a, const Dual& b) {
  return combined(a.value - b.value, [&](std::size_t k) { return a.d[k] - b.d[k]; });
}
Dual operator-(const Dual& a) { return Dual{} - a; }
Dual operator*(const Dual& a, const Dual& b) {
  return combined(a.value * b.value, [&](std::size_t k) { return a.d[k] * b.value + a.value * b.d[k]; });
}
Dual quotient(const Dual& a, const Dual& b) {
  const double q = a.value / b.value;
  return combined(q, [&](std::size_t k) { return (a.d[k] - q * b.d[k]) / b.value; });
}

using DualPoint = PlanePoint<Dual>;

// Corners and centroid of triangle 0 or 1 of the pair, relative to `origin`.
struct Moved {
  std::array<DualPoint, 3> corner;
  DualPoint centre;
};
Moved moved(const Triangle& t, const Vec2& origin, std::size_t which) {
  const Vec2 centre = (1.0 / 3) * ((t.corner[0] - origin) + (t.corner[1] - origin) + (t.corner[2] - origin));
  const auto point = [&](const Vec2& at) {
    DualPoint p;
    for (std::size_t a = 0; a < 2; ++a) {
      p[a].value = at[static_cast<int>(a)];
      p[a].d[3 * which + a] = 1;
    }
    const Vec2 arm = at - centre;
    p[0].d[3 * which + 2] = -arm[1], p[1].d[3 * which + 2] = arm[0];
    return p;
  };
  Moved m;
  for (std::size_t c = 0; c < 3; ++c) m.corner[c] = point(t.corner[c] - origin);
  m.centre = point(centre);
  return m;
}

}  // namespace

AreaTangent area_tangent(const LinkNetwork& n, const AreaLink& link) {
  AreaTangent t;
  std::vector<double> unit;  // -grad A
  for (const auto& [body, shift, at] : area_loads(n, link, false)) {
    t.place.push_back({body, shift});
    unit.insert(unit.end(), at.begin(), at.end());
  }
  const std::size_t size = unit.size();
  t.load.resize(size), t.resistance.resize(size * size);
  for (std::size_t r = 0; r < size; ++r) {
    t.load[r] = link.pressure * unit[r];
    for (std::size_t c = 0; c < size; ++c) t.resistance[r * size + c] = link.stiffness * unit[r] * unit[c];
  }
  const auto place_of = [&](std::int32_t body, const ImageShift<2>& shift) {
    std::size_t k = 0;
    while (t.place[k].body != body || t.place[k].shift != shift) ++k;
    return 3 * k;
  };
  for (const AreaPair& pair : link.pairs) {
    const Triangle &a = n.corners[idx(pair.i)], b = image_of(n.corners[idx(pair.j)], n.packing.cell, pair.shift);
    const Moved ma = moved(a, a.corner[0], 0), mb = moved(b, a.corner[0], 1);
    const PairLoad<Dual> twice = pair_area<Dual>(pair.boundary, ma.corner, mb.corner, ma.centre, mb.centre).twice;
    const std::array<Dual, 6> load{-twice.fx, -twice.fy, twice.moment_i, twice.fx, twice.fy, twice.moment_j};
    const std::array<std::size_t, 2> at{place_of(pair.i, {}), place_of(pair.j, pair.shift)};
    for (std::size_t r = 0; r < 6; ++r)
      for (std::size_t c = 0; c < 6; ++c)  // symmetric but for rounding: the mean of both orders
        t.resistance[(at[r / 3] + r % 3) * size + at[c / 3] + c % 3] -=
            link.pressure * (load[r].d[c] + load[c].d[r]) / 4;
  }
  return t;
}

}  // namespace isostat
