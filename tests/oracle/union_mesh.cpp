#include "tests/oracle/union_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace isostat::oracle {

Mesh union_mesh(std::span<const Vec2> centre, std::span<const double> radius, const PeriodicCell<2>& cell,
                double step) {
  Mesh m;
  m.nx = static_cast<int>(std::ceil(cell.length[0] / step)), m.ny = static_cast<int>(std::ceil(cell.length[1] / step));
  m.step = {cell.length[0] / m.nx, cell.length[1] / m.ny};
  m.covered.assign(static_cast<std::size_t>(m.nx) * static_cast<std::size_t>(m.ny), 0);
  for (std::size_t i = 0; i < centre.size(); ++i) {
    const double r = radius[i];
    const int y0 = static_cast<int>(std::ceil((centre[i][1] - r) / m.step[1] - 0.5));
    const int y1 = static_cast<int>(std::floor((centre[i][1] + r) / m.step[1] - 0.5));
    for (int y = y0; y <= y1; ++y) {
      const double dy = (y + 0.5) * m.step[1] - centre[i][1], w2 = r * r - dy * dy;
      if (w2 < 0) continue;
      const double w = std::sqrt(w2);
      const int x0 = static_cast<int>(std::ceil((centre[i][0] - w) / m.step[0] - 0.5));
      const int x1 = static_cast<int>(std::floor((centre[i][0] + w) / m.step[0] - 0.5));
      const int row = ((y % m.ny) + m.ny) % m.ny;
      for (int x = x0; x <= x1; ++x) {
        const int column = ((x % m.nx) + m.nx) % m.nx;
        m.covered[static_cast<std::size_t>(row) * static_cast<std::size_t>(m.nx) + static_cast<std::size_t>(column)] =
            1;
      }
    }
  }
  return m;
}

std::vector<MeshPore> mesh_pores(const Mesh& m) {
  struct Node {
    int x, y;  // unwrapped
  };
  constexpr int kUnseen = 1 << 30;
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(((y % m.ny) + m.ny) % m.ny) * static_cast<std::size_t>(m.nx) +
           static_cast<std::size_t>(((x % m.nx) + m.nx) % m.nx);
  };
  std::vector<Node> seen(m.covered.size(), {kUnseen, 0});
  std::vector<MeshPore> out;
  for (int y0 = 0; y0 < m.ny; ++y0)
    for (int x0 = 0; x0 < m.nx; ++x0) {
      if (m.covered[at(x0, y0)] || seen[at(x0, y0)].x != kUnseen) continue;
      MeshPore pore;
      std::vector<Node> members{{x0, y0}};
      seen[at(x0, y0)] = {x0, y0};
      for (std::size_t k = 0; k < members.size(); ++k)
        for (const auto& [dx, dy] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          const Node n{members[k].x + dx, members[k].y + dy};
          if (m.covered[at(n.x, n.y)]) continue;
          auto& s = seen[at(n.x, n.y)];
          if (s.x == kUnseen)
            s = n, members.push_back(n);
          else if (s.x != n.x || s.y != n.y)
            pore.percolating = true;
        }
      const double cell = m.step[0] * m.step[1], count = static_cast<double>(members.size());
      double sx = 0, sy = 0, s2 = 0;
      for (const auto& n : members) sx += (n.x + 0.5) * m.step[0], sy += (n.y + 0.5) * m.step[1];
      pore.area = count * cell;
      pore.centroid = {sx / count, sy / count};
      for (const auto& n : members) {
        const double dx = (n.x + 0.5) * m.step[0] - pore.centroid[0], dy = (n.y + 0.5) * m.step[1] - pore.centroid[1];
        s2 += dx * dx + dy * dy;
      }
      pore.equivalent_radius = std::sqrt(2 * s2 / count);
      out.push_back(pore);
    }
  std::sort(out.begin(), out.end(), [](const MeshPore& a, const MeshPore& b) { return a.area > b.area; });
  return out;
}

}  // namespace isostat::oracle
