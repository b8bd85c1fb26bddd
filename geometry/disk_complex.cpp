#include "geometry/disk_complex.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "geometry/base/index.hpp"
#include "geometry/disk_signs.hpp"

namespace isostat {
namespace {

// Spacing of the auxiliary sites in mean spacings of the disks: larger means fewer sites but a thicker padding. The
// optimum is flat (2 to 4) for 1400 to 1e5 disks.
constexpr double kAuxiliarySpacing = 3;
constexpr double kAuxiliaryJitter = 0.1;  // of the spacing: keeps them off degenerate lattices

// A fixed pseudo-random number in [-1, 1), the same on every machine (splitmix64).
double jitter(std::uint64_t n) {
  n += 0x9e3779b97f4a7c15u;
  n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9u;
  n = (n ^ (n >> 27)) * 0x94d049bb133111ebu;
  return std::ldexp(static_cast<double>((n ^ (n >> 31)) >> 11), -52) - 1;
}

struct Auxiliary {
  int nx, ny;
  Vec2 spacing;
  double lean;    // of a row against the one below, in a tilted cell
  double cover;   // every point of the plane is at most this far from an auxiliary site
  double weight;  // negative
};

Auxiliary auxiliary_lattice(const PeriodicCell<2>& cell, std::size_t disks) {
  const Vec2 length = cell.length;
  const double mean = std::sqrt(length[0] * length[1] / static_cast<double>(disks));
  Auxiliary a;
  a.nx = std::max(1, static_cast<int>(std::lround(length[0] / (kAuxiliarySpacing * mean))));
  a.ny = std::max(1, static_cast<int>(std::lround(length[1] / (kAuxiliarySpacing * mean))));
  a.spacing = {length[0] / a.nx, length[1] / a.ny};
  a.lean = cell.tilt / a.ny;
  a.cover = (0.5 + kAuxiliaryJitter) * norm(a.spacing + Vec2{{std::abs(a.lean), 0}});
  a.weight = -0x1p-20 * a.spacing[0] * a.spacing[1];
  return a;
}

// What the exact tests need beside the complex.
struct Work {
  const std::span<const Vec2> centre;
  const std::span<const double> radius;
  const PeriodicCell<2>& cell;
  double tolerance;
  PeriodicSites sites;                            // snapped
  std::vector<std::array<std::int64_t, 2>> wrap;  // per disk: cells from the snapped to the given position
};

void check(const Work& w) {
  if (w.centre.size() != w.radius.size()) throw std::invalid_argument("disk_complex: as many radii as centres");
  if (!(w.cell.length[0] > 0 && w.cell.length[1] > 0 && std::isfinite(w.cell.length[0]) &&
        std::isfinite(w.cell.length[1]) && std::isfinite(w.cell.tilt)))
    throw std::invalid_argument("disk_complex: the cell's edges must be positive");
  if (!(w.tolerance >= 0 && std::isfinite(w.tolerance)))
    throw std::invalid_argument("disk_complex: the gap tolerance must not be negative");
  for (std::size_t i = 0; i < w.centre.size(); ++i)
    if (!std::isfinite(w.centre[i][0]) || !std::isfinite(w.centre[i][1]) || !(w.radius[i] >= 0) ||
        !std::isfinite(w.radius[i]))
      throw std::invalid_argument("disk_complex: coordinates and radii must be finite, radii not negative");
}

double snapped(double x, double grid) { return std::nearbyint(x / grid) * grid; }

// Disks in the cell, on the grid, the smaller of two concentric ones dropped; then the auxiliary sites.
void place_sites(Work& w, DiskComplex& out) {
  const std::size_t n = w.centre.size();
  const double largest = *std::max_element(w.radius.begin(), w.radius.end());
  const auto aux = auxiliary_lattice(w.cell, n);
  // A face with a vertex in the cell has its orthocentre c within sqrt(rho + w_max) of it, and a site that could
  // contradict it lies as near to c on the other side; rho <= cover^2 - weight because of the auxiliary sites.
  const double reach = std::sqrt(aux.cover * aux.cover - aux.weight + largest * largest);
  w.sites.padding = 2.001 * reach;
  const double extent = std::max(w.cell.length[0] + std::abs(w.cell.tilt), w.cell.length[1]) + w.sites.padding;
  const double grid = std::ldexp(1.0, std::ilogb(extent) + 1 - 52);
  w.sites.length = {snapped(w.cell.length[0], grid), snapped(w.cell.length[1], grid)};
  w.sites.tilt = snapped(w.cell.tilt, grid);
  const double slant = w.sites.tilt / w.sites.length[1];

  struct Placed {
    Vec2 at;
    std::array<std::int64_t, 2> wrap;
    std::int32_t input;
  };
  std::vector<Placed> placed(n);
  for (std::size_t i = 0; i < n; ++i) {
    placed[i].input = static_cast<std::int32_t>(i);
    const Vec2 fractions = w.cell.fractions(w.centre[i]);
    const Vec2 cells{{std::floor(fractions[0]), std::floor(fractions[1])}};
    Vec2& at = placed[i].at = w.centre[i];
    for (int k = 0; k < 2; ++k) {
      at[k] = snapped(at[k] - cells[k] * w.cell.length[k] - (k == 0 ? cells[1] * w.cell.tilt : 0.0), grid);
      placed[i].wrap[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(cells[k]);
    }
    for (const int k : {1, 0}) {  // rounding may have taken it over an edge
      const double from = k == 0 ? slant * at[1] : 0;
      const int over = at[k] < from ? -1 : at[k] >= from + w.sites.length[k] ? 1 : 0;
      at[k] -= over * w.sites.length[k];
      if (k == 1) at[0] -= over * w.sites.tilt;
      placed[i].wrap[static_cast<std::size_t>(k)] += over;
    }
  }
  std::vector<std::int32_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const auto &p = placed[idx(a)].at, &q = placed[idx(b)].at;
    if (p[0] != q[0]) return p[0] < q[0];
    if (p[1] != q[1]) return p[1] < q[1];
    if (w.radius[idx(a)] != w.radius[idx(b)]) return w.radius[idx(a)] > w.radius[idx(b)];
    return a < b;
  });
  std::vector<bool> keep(n, true);
  for (std::size_t k = 1; k < n; ++k)
    if (placed[idx(order[k])].at == placed[idx(order[k - 1])].at) keep[idx(order[k])] = false;

  for (std::size_t i = 0; i < n; ++i) {
    if (!keep[i]) continue;
    const auto& p = placed[i];
    w.sites.position.push_back(p.at);
    w.sites.weight.push_back(w.radius[i] * w.radius[i]);
    w.wrap.push_back(p.wrap);
    out.input.push_back(p.input);
    out.centre.push_back(p.at);
    out.radius.push_back(w.radius[i]);
  }
  for (int iy = 0; iy < aux.ny; ++iy)
    for (int ix = 0; ix < aux.nx; ++ix) {
      const auto seed =
          2 * (static_cast<std::uint64_t>(iy) * static_cast<std::uint64_t>(aux.nx) + static_cast<std::uint64_t>(ix));
      Vec2 p{(ix + 0.5 + kAuxiliaryJitter * jitter(seed)) * aux.spacing[0],
             (iy + 0.5 + kAuxiliaryJitter * jitter(seed + 1)) * aux.spacing[1]};
      p[0] += aux.lean / aux.spacing[1] * p[1];
      for (int k = 0; k < 2; ++k) p[k] = snapped(p[k], grid);
      w.sites.position.push_back(p);
      w.sites.weight.push_back(aux.weight);
    }
}

Vec2 image_position(const PeriodicSites& s, const SiteImage& v) {
  const auto& p = s.position[idx(v.site)];
  return {p[0] + v.shift[0] * s.length[0] + v.shift[1] * s.tilt, p[1] + v.shift[1] * s.length[1]};
}

void classify_faces(const Work& w, DiskComplex& out) {
  const auto& t = out.triangulation;
  out.face_covered.resize(t.faces.size());
  for (std::size_t f = 0; f < t.faces.size(); ++f) {
    const auto& [u, v, x] = t.faces[f];
    if (!out.is_disk(u.site) || !out.is_disk(v.site) || !out.is_disk(x.site)) continue;  // power > 0 at its centre
    const Vec2 p = image_position(w.sites, u);
    out.face_covered[f] =
        orthoradius_sign(image_position(w.sites, v) - p, image_position(w.sites, x) - p, w.sites.weight[idx(u.site)],
                         w.sites.weight[idx(v.site)], w.sites.weight[idx(x.site)]) <= 0;
  }
}

// An edge is closed if one of its faces is covered, or if the two disks meet at a point of their power edge.
EdgeState classify_edge(const Work& w, const DiskComplex& c, std::int32_t i, std::int32_t slot) {
  const auto& t = c.triangulation;
  const auto k = idx(slot), before = idx(t.previous(i, slot)), after = idx(t.next(i, slot));
  const auto j = t.neighbour[k];
  if (!c.is_disk(j.site)) return EdgeState::open;
  if (c.face_covered[idx(t.face[k])] || c.face_covered[idx(t.face[before])]) return EdgeState::closed;
  const auto &wi = w.wrap[idx(i)], &wj = w.wrap[idx(j.site)];
  const auto a = idx(c.input[idx(i)]), b = idx(c.input[idx(j.site)]);
  const auto reach_sign = [&](double radius_b, double tolerance) {
    return gap_sign(w.centre[a], w.centre[b], j.shift[0] + wi[0] - wj[0], j.shift[1] + wi[1] - wj[1], w.cell,
                    w.radius[a], radius_b, tolerance);
  };
  if (reach_sign(w.radius[b], w.tolerance) > 0) return EdgeState::open;
  if (reach_sign(-w.radius[b], 0) < 0) return EdgeState::open;  // one inside the other: their circles do not meet
  const Vec2 p = w.sites.position[idx(i)], d = image_position(w.sites, j) - p;
  for (const auto side : {before, after}) {
    const auto& o = t.neighbour[side];
    if (edge_centre_sign(d, image_position(w.sites, o) - p, w.sites.weight[idx(i)], w.sites.weight[idx(j.site)],
                         w.sites.weight[idx(o.site)]) < 0)
      return EdgeState::open;
  }
  return w.tolerance == 0 || reach_sign(w.radius[b], 0) <= 0 ? EdgeState::closed : EdgeState::bridged;
}

}  // namespace

DiskComplex disk_complex(std::span<const Vec2> centre, std::span<const double> radius, const PeriodicCell<2>& cell,
                         double gap_tolerance) {
  Work w{centre, radius, cell, gap_tolerance, {}, {}};
  check(w);
  DiskComplex out;
  out.cell = cell;
  if (centre.empty()) {
    out.triangulation.first = {0};
    return out;
  }
  place_sites(w, out);
  out.triangulation = power_triangulation(w.sites);
  const auto& t = out.triangulation;
  out.branch.resize(t.neighbour.size());
  out.edge.resize(t.neighbour.size(), EdgeState::open);
  classify_faces(w, out);
  for (std::int32_t i = 0; idx(i) + 1 < t.first.size(); ++i)
    for (auto slot = t.first[idx(i)]; slot < t.first[idx(i) + 1]; ++slot) {
      out.branch[idx(slot)] = image_position(w.sites, t.neighbour[idx(slot)]) - w.sites.position[idx(i)];
      if (out.is_disk(i)) out.edge[idx(slot)] = classify_edge(w, out, i, slot);
    }
  return out;
}

}  // namespace isostat
