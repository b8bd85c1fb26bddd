#include "tests/oracle/network_oracle.hpp"

#include <cmath>
#include <random>
#include <set>
#include <tuple>

namespace isostat::oracle {
namespace {
std::size_t at(std::int32_t k) { return static_cast<std::size_t>(k); }
double cross(const Vec2& a, const Vec2& b) { return a[0] * b[1] - a[1] * b[0]; }
}  // namespace

std::vector<NetLoad> net_loads(const Packing<2>& packing) {
  const Bodies<2>& b = packing.bodies;
  std::vector<NetLoad> loads(b.size());
  for (const Link<2>& link : packing.links) {
    const Vec2 ri = b.position[at(link.i)];
    Vec2 rj = b.position[at(link.j)];
    if (packing.cell) rj += packing.cell->offset(link.shift);
    const Vec2 rij = rj - ri;
    const double distance = norm(rij);
    const Vec2 n = (1 / distance) * rij, t{{-n[1], n[0]}};
    const double share = b.radius[at(link.i)] / (b.radius[at(link.i)] + b.radius[at(link.j)]);
    const Vec2 contact = ri + share * rij;
    const Vec2 on_j = link.normal_force * n + link.tangential_force * t;
    loads[at(link.j)].force += on_j;
    loads[at(link.i)].force -= on_j;
    loads[at(link.j)].moment += cross(contact - rj, on_j) + link.moment;
    loads[at(link.i)].moment -= cross(contact - ri, on_j) + link.moment;
  }
  return loads;
}

Packing<2> random_packing(std::uint64_t seed, std::size_t grains, std::size_t links, bool periodic) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> unit(0, 1), symmetric(-1, 1);
  std::uniform_int_distribution<int> shift(-1, 1), body(0, static_cast<int>(grains) - 1);
  Packing<2> p;
  if (periodic) p.cell = PeriodicCell<2>{{{3 + unit(engine), 4 + unit(engine)}}};
  p.bodies.resize(grains);
  for (std::size_t k = 0; k < grains; ++k) {
    p.bodies.id[k] = static_cast<std::int64_t>(10 * k + 7);
    p.bodies.position[k] = {{5 * unit(engine), 5 * unit(engine)}};
    p.bodies.velocity[k] = {{symmetric(engine), symmetric(engine)}};
    p.bodies.spin[k] = symmetric(engine);
    const double r = p.bodies.radius[k] = 0.25 + 0.25 * unit(engine);
    p.bodies.mass[k] = 4 * r * r;
    p.bodies.inertia[k] = 0.5 * p.bodies.mass[k] * r * r;
  }
  while (p.links.size() < links) {
    Link<2> l;
    l.i = body(engine), l.j = body(engine);
    if (periodic) l.shift = {shift(engine), shift(engine)};
    if (l.i == l.j && l.shift == ImageShift<2>{}) continue;
    l.gap = -0.01 * unit(engine);
    l.normal_force = symmetric(engine), l.tangential_force = symmetric(engine), l.moment = symmetric(engine);
    p.links.push_back(l);
  }
  return p;
}

std::vector<Link<2>> touching_pairs(const Packing<2>& packing, double tolerance, int reach) {
  const Bodies<2>& b = packing.bodies;
  const int r = packing.cell ? reach : 0;
  std::vector<Link<2>> links;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(b.size()); ++i)
    for (std::int32_t j = i; j < static_cast<std::int32_t>(b.size()); ++j)
      for (int s1 = -r; s1 <= r; ++s1)
        for (int s2 = -r; s2 <= r; ++s2) {
          if (i == j && (s1 < 0 || (s1 == 0 && s2 <= 0))) continue;  // one of each pair of opposite images
          Vec2 rij = b.position[at(j)] - b.position[at(i)];
          if (packing.cell) rij += packing.cell->offset({s1, s2});
          const double gap = norm(rij) - b.radius[at(i)] - b.radius[at(j)];
          if (!(gap <= tolerance)) continue;
          Link<2> l;
          l.i = i, l.j = j, l.shift = {s1, s2}, l.gap = gap;
          links.push_back(l);
        }
  return links;
}

std::array<bool, 2> percolates(const Packing<2>& packing, double threshold, int reach) {
  using Node = std::tuple<std::int32_t, int, int>;  // body, copy of the cell
  std::array<bool, 2> along{};
  for (std::int32_t start = 0; start < static_cast<std::int32_t>(packing.bodies.size()); ++start) {
    std::set<Node> seen{{start, 0, 0}};
    std::vector<Node> front{{start, 0, 0}};
    while (!front.empty()) {
      const auto [k, c1, c2] = front.back();
      front.pop_back();
      for (const Link<2>& l : packing.links) {
        if (std::hypot(l.normal_force, l.tangential_force) < threshold) continue;
        for (int sign : {1, -1}) {
          if ((sign == 1 ? l.i : l.j) != k) continue;
          const Node next{sign == 1 ? l.j : l.i, c1 + sign * l.shift[0], c2 + sign * l.shift[1]};
          if (std::abs(std::get<1>(next)) > reach || std::abs(std::get<2>(next)) > reach) continue;
          if (seen.insert(next).second) front.push_back(next);
        }
      }
    }
    for (const auto& [k, c1, c2] : seen)
      if (k == start) along[0] = along[0] || c1 != 0, along[1] = along[1] || c2 != 0;
  }
  return along;
}

}  // namespace isostat::oracle
