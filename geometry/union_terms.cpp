#include "geometry/union_terms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "geometry/disk_complex.hpp"
#include "geometry/gauss_legendre.hpp"

namespace isostat {
namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

struct Pair {
  std::int32_t i, j;
  Vec2 branch;  // to the image of j
};

class PointWriter {
 public:
  PointWriter(UnionTerms& out, double k_max, double tolerance) : out_(out), k_max_(k_max), tolerance_(tolerance) {}

  // Lens of two disks whose circles cross, times `weight`. Returns the weight with which each of the two whole disks
  // enters besides: where the centre of one lies beyond the common chord, the lens is that disk plus a (negative)
  // crescent. Points are spread across the crescent or lens along the branch vector and along its chord.
  std::array<double, 2> lens(const Vec2& p, const Vec2& branch, double r, double q, double weight) {
    const double d = norm(branch), product = (r + q - d) * (r + q + d) * (d - (r - q)) * (d + (r - q));
    const double foot_p = (d * d + (r - q) * (r + q)) / (2 * d), foot_q = d - foot_p;
    const std::array<double, 2> whole{foot_p < 0 ? weight : 0, foot_q < 0 ? weight : 0};
    if (!(product > 0)) return whole;
    const double s = std::sqrt(product) / (2 * d), width = r + q - d;
    const Vec2 n = (1 / d) * branch, t{-n[1], n[0]};
    const double share = s * width / (r * r);
    if (share < tolerance_) return whole;
    // Shallow lenses are parabolas along the chord (two points are exact for the area, three for the next order); for
    // deep ones v = s sin(tau) takes the roots at the ends away.
    const double depth = s / std::min(r, q);
    const bool deep = depth > 0.3;
    const int across = points_for(0.5 * k_max_ * width, share);
    const int along = points_for(k_max_ * s, share) + (deep ? 12 : share * depth * depth < tolerance_ ? 1 : 2);
    const Quadrature &qu = rule(across), &qv = rule(along);
    const double stretch = deep ? std::numbers::pi / 2 : 1;
    for (std::size_t a = 0; a < qv.node.size(); ++a) {
      const double tau = stretch * qv.node[a], v = s * (deep ? std::sin(tau) : tau);
      const double dv = s * stretch * qv.weight[a] * (deep ? std::cos(tau) : 1);
      const double right = rise(r, s, v, foot_p), left = rise(q, s, v, foot_q);
      const double mid = foot_p + 0.5 * (right - left), half = 0.5 * (right + left);
      for (std::size_t b = 0; b < qu.node.size(); ++b)
        add(p + (mid + half * qu.node[b]) * n + v * t, weight * dv * half * qu.weight[b]);
    }
    return whole;
  }

  // Common part of three disks, times `weight`: the convex polygon of its corners and a segment of one of the disks
  // over each side. Returns the weight with which each whole disk enters besides.
  std::array<double, 3> triple(const std::array<Vec2, 3>& p, const std::array<double, 3>& r, double weight) {
    std::array<double, 3> whole{};
    auto corner = corners(p, r);
    if (corner.size() < 2) {  // one disk lies inside the other two
      whole[static_cast<std::size_t>(std::min_element(r.begin(), r.end()) - r.begin())] = weight;
      return whole;
    }
    Vec2 middle{};
    for (const auto& c : corner) middle += (1.0 / static_cast<double>(corner.size())) * c.at;
    std::sort(corner.begin(), corner.end(), [&](const Corner& a, const Corner& b) {
      return std::atan2(a.at[1] - middle[1], a.at[0] - middle[0]) <
             std::atan2(b.at[1] - middle[1], b.at[0] - middle[0]);
    });
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const auto &a = corner[k], &b = corner[(k + 1) % corner.size()];
      triangle(middle, a.at, b.at, weight);
      const auto m = disk_of_side(a, b, p, r);
      const Vec2 side = b.at - a.at;
      const double length = norm(side);
      if (!(length > 0)) continue;
      const Vec2 out{side[1] / length, -side[0] / length}, foot = 0.5 * (a.at + b.at);
      const double offset = dot(foot - p[m], out);
      if (offset < 0) whole[m] += weight;
      segment(foot, out, 0.5 * length, r[m], offset, weight);
    }
    return whole;
  }

 private:
  // Height over the common chord of the minor arc that it cuts off, sqrt(r^2 - v^2) - |f| with |f|^2 + s^2 = r^2, in
  // the form that does not cancel in thin lenses; negative where the arc lies on the other side of the chord.
  static double rise(double r, double s, double v, double foot) {
    const double height = (s - v) * (s + v) / (std::sqrt(std::max(0.0, (r - v) * (r + v))) + std::abs(foot));
    return foot < 0 ? -height : height;
  }
  struct Corner {
    Vec2 at;
    std::size_t a, b;  // whose circles cross there
  };
  // Crossing points of two circles that lie in the third disk.
  static std::vector<Corner> corners(const std::array<Vec2, 3>& p, const std::array<double, 3>& r) {
    std::vector<Corner> out;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, third = (a + 2) % 3;
      const Vec2 branch = p[b] - p[a];
      const double d = norm(branch);
      const double product = (r[a] + r[b] - d) * (r[a] + r[b] + d) * (d - (r[a] - r[b])) * (d + (r[a] - r[b]));
      if (!(product > 0)) continue;
      const double foot = (d * d + (r[a] - r[b]) * (r[a] + r[b])) / (2 * d), s = std::sqrt(product) / (2 * d);
      const Vec2 n = (1 / d) * branch, t{-n[1], n[0]};
      for (const double side : {-s, s}) {
        const Vec2 x = p[a] + foot * n + side * t;
        if (norm(x - p[third]) <= r[third]) out.push_back({x, a, b});
      }
    }
    return out;
  }
  // The disk whose arc goes from corner a to corner b anticlockwise along the region's border: of those that pass
  // through both corners the one whose arc stays inside the others.
  static std::size_t disk_of_side(const Corner& a, const Corner& b, const std::array<Vec2, 3>& p,
                                  const std::array<double, 3>& r) {
    std::size_t best = a.a;
    double best_excess = 1e300;
    for (const auto m : {a.a, a.b}) {
      if (m != b.a && m != b.b) continue;
      const Vec2 u = a.at - p[m], v = b.at - p[m];
      double sweep = std::atan2(u[0] * v[1] - u[1] * v[0], dot(u, v));
      if (sweep < 0) sweep += 2 * std::numbers::pi;
      const double c = std::cos(sweep / 2), s = std::sin(sweep / 2);
      const Vec2 top = p[m] + Vec2{u[0] * c - u[1] * s, u[0] * s + u[1] * c};
      double excess = -1e300;
      for (std::size_t o = 0; o < 3; ++o)
        if (o != m) excess = std::max(excess, norm(top - p[o]) - r[o]);
      if (excess < best_excess) best_excess = excess, best = m;
    }
    return best;
  }
  void triangle(const Vec2& apex, const Vec2& b, const Vec2& c, double weight) {
    const Vec2 u = b - apex, v = c - apex;
    const double twice = u[0] * v[1] - u[1] * v[0];
    if (!(std::abs(twice) > 0)) return;
    const Quadrature& q = rule(4 + points_for(0.5 * k_max_ * std::max({norm(u), norm(v), norm(c - b)}), 1));
    for (std::size_t m = 0; m < q.node.size(); ++m) {
      const double x = 0.5 * (1 + q.node[m]);
      for (std::size_t n = 0; n < q.node.size(); ++n) {
        const double y = 0.5 * (1 + q.node[n]);
        add(apex + x * (u + y * (v - u)), weight * 0.25 * q.weight[m] * q.weight[n] * x * twice);
      }
    }
  }
  // Between a chord of half length s and the arc over it, on the side `out`; foot: distance of the chord from the
  // disk's centre along `out`. With foot < 0 the minor segment on the other side, negative.
  void segment(const Vec2& middle, const Vec2& out, double s, double r, double foot, double weight) {
    const Vec2 along{-out[1], out[0]};
    const Quadrature &qv = rule(16 + points_for(k_max_ * s, 1)), &qu = rule(2 + points_for(k_max_ * s / 2, 1));
    for (std::size_t a = 0; a < qv.node.size(); ++a) {
      const double tau = std::numbers::pi / 2 * qv.node[a], v = s * std::sin(tau);
      const double half = 0.5 * rise(r, s, v, foot), dv = s * std::numbers::pi / 2 * qv.weight[a] * std::cos(tau);
      for (std::size_t b = 0; b < qu.node.size(); ++b)
        add(middle + half * (1 + qu.node[b]) * out + v * along, weight * dv * half * qu.weight[b]);
    }
  }
  // Gauss points that integrate exp(i x), |x| <= phase, with an error below tolerance / share.
  int points_for(double phase, double share) const {
    double term = share;
    int n = 0;
    do {
      ++n;
      term *= phase * phase / (2.0 * n * (2.0 * n - 1)) / 4;
    } while (term > tolerance_ && n < 200);
    return n;
  }
  const Quadrature& rule(int n) {
    auto& r = rules_[n];
    if (r.node.empty()) r = gauss_legendre(n);
    return r;
  }
  void add(const Vec2& at, double weight) { out_.point.push_back(at), out_.point_weight.push_back(weight); }

  UnionTerms& out_;
  double k_max_, tolerance_;
  std::map<int, Quadrature> rules_;
};

// All overlapping pairs by bins, or nothing where bins do not help (small cells, very unequal disks).
std::optional<std::vector<Pair>> overlapping_pairs(std::span<const Vec2> centre, std::span<const double> radius,
                                                   const PeriodicCell<2>& cell) {
  constexpr double kMostPerBin = 40;
  const double largest = *std::max_element(radius.begin(), radius.end());
  if (!(largest > 0)) return std::vector<Pair>{};
  const double bins_x = std::floor(cell.length[0] / (2 * largest)), bins_y = std::floor(cell.length[1] / (2 * largest));
  if (bins_x < 3 || bins_y < 3 || static_cast<double>(centre.size()) > kMostPerBin * bins_x * bins_y)
    return std::nullopt;
  const double most = std::ceil(std::sqrt(static_cast<double>(centre.size()))) + 3;
  const int nx = static_cast<int>(std::min(bins_x, most)), ny = static_cast<int>(std::min(bins_y, most));
  std::vector<Vec2> at(centre.begin(), centre.end());
  std::vector<std::int32_t> bin(at.size()), first(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) + 1, 0),
      member(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    at[i] = cell.wrap(at[i]);
    const int x = std::min(nx - 1, static_cast<int>(at[i][0] / cell.length[0] * nx)),
              y = std::min(ny - 1, static_cast<int>(at[i][1] / cell.length[1] * ny));
    bin[i] = y * nx + x;
    ++first[index(bin[i]) + 1];
  }
  for (std::size_t b = 1; b < first.size(); ++b) first[b] += first[b - 1];
  auto fill = first;
  for (std::size_t i = 0; i < at.size(); ++i) member[index(fill[index(bin[i])]++)] = static_cast<std::int32_t>(i);
  std::vector<Pair> pairs;
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int ox = x + dx, oy = y + dy;
          const Vec2 move{ox < 0     ? -cell.length[0]
                          : ox >= nx ? cell.length[0]
                                     : 0,
                          oy < 0     ? -cell.length[1]
                          : oy >= ny ? cell.length[1]
                                     : 0};
          const auto here = index(y * nx + x), there = index(((oy + ny) % ny) * nx + (ox + nx) % nx);
          for (auto a = first[here]; a < first[here + 1]; ++a)
            for (auto b = first[there]; b < first[there + 1]; ++b) {
              const auto i = member[index(a)], j = member[index(b)];
              if (j <= i) continue;
              const Vec2 s = at[index(j)] + move - at[index(i)];
              const double reach = radius[index(i)] + radius[index(j)];
              if (dot(s, s) < reach * reach) pairs.push_back({i, j, s});
            }
        }
  return pairs;
}

// True if some disk may reach into the lens of two others, or lies inside another.
bool deep_overlaps(const std::vector<Pair>& pairs, std::span<const double> radius) {
  std::vector<std::vector<std::pair<std::int32_t, Vec2>>> around(radius.size());
  for (const auto& p : pairs)
    around[index(p.i)].push_back({p.j, p.branch}), around[index(p.j)].push_back({p.i, -1.0 * p.branch});
  for (const auto& p : pairs) {
    const double r = radius[index(p.i)], q = radius[index(p.j)], d = norm(p.branch);
    if (d <= std::abs(r - q)) return true;
    const double foot = (d * d + (r - q) * (r + q)) / (2 * d), s = std::sqrt(std::max(0.0, (r - foot) * (r + foot)));
    const double lens = std::max(s, r + q - d);  // radius of a circle about the foot that holds the lens
    for (const auto& [k, branch] : around[index(p.i)]) {
      const Vec2 apart = branch - (foot / d) * p.branch;
      if ((k != p.j || norm(branch - p.branch) > 0.5 * d) && norm(apart) < radius[index(k)] + lens) return true;
    }
  }
  return false;
}

void terms_of_complex(const DiskComplex& c, PointWriter& write, UnionTerms& out) {
  const auto& t = c.triangulation;
  std::fill(out.disk_weight.begin(), out.disk_weight.end(), 0.0);
  for (std::int32_t i = 0; index(i) < c.size(); ++i) {
    double& weight = out.disk_weight[index(c.input[index(i)])];
    const double r = c.radius[index(i)];
    bool closed = false, inside = t.first[index(i)] < t.first[index(i) + 1];
    for (auto slot = t.first[index(i)]; slot < t.first[index(i) + 1]; ++slot) {
      const auto& j = t.neighbour[index(slot)];
      if (!c.is_disk(j.site)) continue;
      const Vec2 b = c.branch[index(slot)];
      const double q = c.radius[index(j.site)];
      if (dot(b, b) + r * r - q * q < 0) inside = false;
      if (c.edge[index(slot)] != EdgeState::closed) continue;
      closed = true;
      const bool once = j.site > i || (j.site == i && (j.shift[0] > 0 || (j.shift[0] == 0 && j.shift[1] > 0)));
      if (!once) continue;
      if (norm(b) > std::abs(r - q)) {
        const auto whole = write.lens(c.centre[index(i)], b, r, q, -1);
        weight += whole[0], out.disk_weight[index(c.input[index(j.site)])] += whole[1];
      } else {
        out.disk_weight[index(c.input[index(r < q ? i : j.site)])] -= 1;  // the smaller one is the common part
      }
    }
    if (closed || inside) weight += 1;
  }
  for (std::size_t f = 0; f < t.faces.size(); ++f) {
    if (!c.face_covered[f]) continue;
    const auto& v = t.faces[f];
    const auto slot = t.slot_of(v[0].site, v[1]);
    const Vec2 p = c.centre[index(v[0].site)], a = c.branch[index(slot)], b = c.branch[index(t.next(v[0].site, slot))];
    const std::array<double, 3> r{c.radius[index(v[0].site)], c.radius[index(v[1].site)], c.radius[index(v[2].site)]};
    const auto whole = write.triple({p, p + a, p + b}, r, 1);
    for (std::size_t m = 0; m < 3; ++m) out.disk_weight[index(c.input[index(v[m].site)])] += whole[m];
  }
}

}  // namespace

UnionTerms union_terms(std::span<const Vec2> centre, std::span<const double> radius, const PeriodicCell<2>& cell,
                       double k_max, double tolerance) {
  UnionTerms out;
  out.disk_weight.assign(centre.size(), 1);
  if (centre.empty()) return out;
  PointWriter write(out, k_max, tolerance);
  const auto pairs = overlapping_pairs(centre, radius, cell);
  if (pairs && !deep_overlaps(*pairs, radius)) {
    for (const auto& p : *pairs) {
      const auto whole = write.lens(centre[index(p.i)], p.branch, radius[index(p.i)], radius[index(p.j)], -1);
      out.disk_weight[index(p.i)] += whole[0], out.disk_weight[index(p.j)] += whole[1];
    }
    return out;
  }
  terms_of_complex(disk_complex(centre, radius, cell), write, out);
  return out;
}

}  // namespace isostat
