#include "tests/support/disk_packings.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <stdexcept>

namespace isostat::oracle {
namespace {

double uniform(std::mt19937_64& g, double low, double high) {
  return low + (high - low) * std::ldexp(static_cast<double>(g() >> 11), -53);
}

}  // namespace

Disks read_disks(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot open " + path);
  const auto j = nlohmann::json::parse(in);
  Disks d;
  d.cell.length = {j["L"].get<double>(), j["L"].get<double>()};
  for (const auto& disk : j["disks"]) {
    d.centre.push_back({disk[0].get<double>(), disk[1].get<double>()});
    d.radius.push_back(disk[2].get<double>());
  }
  return d;
}

Disks poisson_disks(std::size_t n, Vec2 length, double r_min, double r_max, std::uint64_t seed) {
  std::mt19937_64 g(seed);
  Disks d;
  d.cell.length = length;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = uniform(g, 0, length[0]), y = uniform(g, 0, length[1]);
    d.centre.push_back({x, y});
    d.radius.push_back(uniform(g, r_min, r_max));
  }
  return d;
}

Disks rsa_disks(std::size_t n, Vec2 length, double r_min, double r_max, std::uint64_t seed) {
  std::mt19937_64 g(seed);
  Disks d;
  d.cell.length = length;
  const int nx = std::max(1, static_cast<int>(length[0] / (2 * r_max))),
            ny = std::max(1, static_cast<int>(length[1] / (2 * r_max)));
  std::vector<std::vector<std::size_t>> bins(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
  const auto bin = [&](int x, int y) -> std::vector<std::size_t>& {
    return bins[static_cast<std::size_t>(((y % ny) + ny) % ny) * static_cast<std::size_t>(nx) +
                static_cast<std::size_t>(((x % nx) + nx) % nx)];
  };
  for (std::size_t trial = 0; trial < 1000 * n && d.centre.size() < n; ++trial) {
    const Vec2 p{uniform(g, 0, length[0]), uniform(g, 0, length[1])};
    const double r = uniform(g, r_min, r_max);
    const int bx = std::min(nx - 1, static_cast<int>(p[0] / length[0] * nx)),
              by = std::min(ny - 1, static_cast<int>(p[1] / length[1] * ny));
    bool free = true;
    for (int dy = -1; dy <= 1 && free; ++dy)
      for (int dx = -1; dx <= 1 && free; ++dx)
        for (const auto j : bin(bx + dx, by + dy)) {
          Vec2 s = d.centre[j] - p;
          s += d.cell.offset(d.cell.nearest_image(s));
          if (norm(s) < r + d.radius[j]) free = false;
        }
    if (!free) continue;
    bin(bx, by).push_back(d.centre.size());
    d.centre.push_back(p);
    d.radius.push_back(r);
  }
  return d;
}

Disks chain_disks(std::size_t walls, Vec2 length, double overlap, std::uint64_t seed) {
  std::mt19937_64 g(seed);
  Disks d;
  d.cell.length = length;
  for (std::size_t n = 0; n < walls; ++n) {
    const Vec2 middle{uniform(g, 0, length[0]), uniform(g, 0, length[1])};
    const double size = uniform(g, 1.5, 6);
    const int corners = 3 + static_cast<int>(g() % 5);
    std::vector<Vec2> corner;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * (k + uniform(g, -0.3, 0.3)) / corners;
      corner.push_back(middle + size * uniform(g, 0.6, 1.2) * Vec2{std::cos(angle), std::sin(angle)});
    }
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const Vec2 a = corner[k], b = corner[(k + 1) % corner.size()];
      const int grains = std::max(1, static_cast<int>(norm(b - a) / 0.8));
      const double radius = norm(b - a) / grains / 2 * (1 + overlap);
      for (int m = 0; m < grains; ++m)
        d.centre.push_back(a + (double(m) / grains) * (b - a)), d.radius.push_back(radius);
    }
    for (int m = 0; m < 3; ++m)  // loose grains inside
      d.centre.push_back(middle + size * 0.4 * Vec2{uniform(g, -1, 1), uniform(g, -1, 1)}),
          d.radius.push_back(uniform(g, 0.25, 0.5));
  }
  for (auto& p : d.centre) p = d.cell.wrap(p);
  return d;
}

Disks closing_lattice(bool hexagonal, double jitter, std::uint64_t seed) {
  std::mt19937_64 g(seed);
  const double row = hexagonal ? std::sqrt(0.75) : 0.5;
  const int rows = hexagonal ? 4 : 6;
  Disks d{{{3, rows * row}}, {}, {}};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < 3; ++x) {
      const double dx = g() % 2 ? 0 : uniform(g, -jitter, jitter), dy = g() % 2 ? 0 : uniform(g, -jitter, jitter);
      d.centre.push_back({x + 0.5 * (y % 2) + dx, y * row + dy});
      d.radius.push_back(hexagonal ? 1 / std::sqrt(3.0) : 0.5);
    }
  return d;
}

}  // namespace isostat::oracle
