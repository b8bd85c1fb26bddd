// One packing in a tilted cell, described in other ways: cells whose tilts differ by L1 are the same, and a tilt of
// L1/2 is undone by an upright cell of two copies.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dem/state/packing.hpp"
#include "dem/state/touching.hpp"

namespace isostat {

// tilt + turns L1.
template <int D>
void turn_description(Packing<D>& p, int turns) {
  p.cell->tilt += turns * p.cell->length[0];
  for (Link<D>& l : p.links) l.shift[0] -= turns * l.shift[1];
}

// Tilt L1/2, no matter what the links become.
template <int D>
Packing<D> half_tilted(Packing<D> p) {
  p.cell->tilt = 0.5 * p.cell->length[0];
  p.links = touching_links(p, 0.0);
  std::erase_if(p.links, [](const Link<D>& l) { return l.i == l.j; });
  return p;
}

// Of a cell with tilt L1/2 the upright one of two copies: the second is the image along the second edge.
template <int D>
Packing<D> two_copies(const Packing<D>& p) {
  Packing<D> out;
  const auto n = static_cast<std::int32_t>(p.bodies.size());
  out.cell = PeriodicCell<D>{p.cell->length};
  out.cell->length[1] *= 2;
  out.bodies.resize(2 * p.bodies.size());
  for (std::size_t k = 0; k < out.bodies.size(); ++k) {
    const std::size_t of = k % p.bodies.size();
    ImageShift<D> image{};
    image[1] = k == of ? 0 : 1;
    out.bodies.id[k] = static_cast<std::int64_t>(k);
    out.bodies.position[k] = p.bodies.position[of] + p.cell->offset(image);
    out.bodies.radius[k] = p.bodies.radius[of], out.bodies.mass[k] = 1, out.bodies.inertia[k] = 1;
  }
  for (const Link<D>& l : p.links)
    for (const int copy : {0, 1}) {
      Link<D> twin = l;
      const int row = copy + l.shift[1], up = row >= 0 ? row / 2 : -((1 - row) / 2);  // 2 (tilt, L2) = (L1, 2 L2)
      twin.i = l.i + copy * n, twin.j = l.j + (row - 2 * up) * n;
      twin.shift[0] = l.shift[0] + up, twin.shift[1] = up;
      out.links.push_back(twin);
    }
  return out;
}

// Numbers of two reports, in order; lists are compared as they stand.
inline void expect_near(const nlohmann::ordered_json& a, const nlohmann::ordered_json& b, double tolerance,
                        const std::string& where) {
  if (a.is_structured()) {
    ASSERT_EQ(a.size(), b.size()) << where;
    for (auto at = a.items().begin(), other = b.items().begin(); at != a.items().end(); ++at, ++other)
      expect_near(at.value(), other.value(), tolerance, where + "." + at.key());
  } else if (a.is_number()) {
    ASSERT_TRUE(b.is_number()) << where;
    EXPECT_NEAR(a.get<double>(), b.get<double>(), tolerance * (1 + std::abs(a.get<double>()))) << where;
  } else {
    EXPECT_EQ(a, b) << where;
  }
}

}  // namespace isostat
