// Time and error of the overlap of two triangles: batch kernels, the exact path, and what one would write or take
// instead: plain Sutherland-Hodgman in doubles, and CGAL's exact intersection. Errors against the exact path, which
// tests/geometry holds to rational arithmetic.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "geometry/overlap_batch.hpp"
#include "geometry/polygon_intersection.hpp"
#include "geometry/triangle_overlap.hpp"
#include "tests/support/triangle_pairs.hpp"

using namespace isostat;

namespace {

constexpr std::size_t kPairs = 4096;

struct Table {
  std::vector<oracle::TrianglePair> pairs;
  std::vector<double> exact;
  std::array<std::vector<double>, 12> column;
  TriangleArrays a, b;
};

Table table_of(const std::function<oracle::TrianglePair()>& next) {
  Table t;
  for (auto& c : t.column) c.resize(kPairs);
  for (std::size_t p = 0; p < kPairs; ++p) {
    oracle::TrianglePair pair = next();
    pair = {oracle::anticlockwise(pair.a), oracle::anticlockwise(pair.b)};
    for (std::size_t k = 0; k < 3; ++k) {
      t.column[k][p] = pair.a.corner[k][0], t.column[k + 3][p] = pair.a.corner[k][1];
      t.column[k + 6][p] = pair.b.corner[k][0], t.column[k + 9][p] = pair.b.corner[k][1];
    }
    t.pairs.push_back(pair), t.exact.push_back(triangle_overlap(pair.a, pair.b).area);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    t.a.x[k] = t.column[k].data(), t.a.y[k] = t.column[k + 3].data();
    t.b.x[k] = t.column[k + 6].data(), t.b.y[k] = t.column[k + 9].data();
  }
  return t;
}

double sutherland_hodgman(const Triangle& a, const Triangle& b) {
  std::array<Vec2, 8> now{a.corner[0], a.corner[1], a.corner[2]}, kept;
  std::size_t n = 3;
  for (std::size_t f = 0; f < 3 && n > 0; ++f) {
    const Vec2 q = b.corner[f], w = b.corner[(f + 1) % 3] - q;
    const auto depth = [&](const Vec2& p) { return w[0] * (p[1] - q[1]) - w[1] * (p[0] - q[0]); };
    std::size_t m = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 from = now[k], to = now[k + 1 == n ? 0 : k + 1];
      const double d = depth(from), e = depth(to);
      if (d >= 0) kept[m++] = from;
      if ((d > 0 && e < 0) || (d < 0 && e > 0)) kept[m++] = from + d / (d - e) * (to - from);
    }
    now = kept, n = m;
  }
  double twice = 0;
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const Vec2 u = now[k] - now[0], v = now[k + 1] - now[0];
    twice += u[0] * v[1] - u[1] * v[0];
  }
  return twice / 2;
}

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

void row(const char* pairs, const std::string& method, const Table& t, std::size_t count, int rounds,
         const std::function<void(std::vector<double>&)>& areas) {
  std::vector<double> out(kPairs);
  std::vector<double> seconds;
  for (int r = 0; r < rounds; ++r) {
    const double start = cpu_seconds();
    areas(out);
    seconds.push_back(cpu_seconds() - start);
  }
  std::sort(seconds.begin(), seconds.end());
  std::vector<double> error;
  double absolute = 0;
  for (std::size_t k = 0; k < count; ++k) {
    absolute = std::max(absolute, std::abs(out[k] - t.exact[k]));
    if (t.exact[k] > 0) error.push_back(std::abs(out[k] / t.exact[k] - 1));
  }
  std::sort(error.begin(), error.end());
  const double ns = 1e9 / double(count);
  std::printf("%s,%s,%.2f,%.2f,", pairs, method.c_str(), ns * seconds.front(), ns * seconds[seconds.size() / 2]);
  if (error.empty())
    std::printf(",,");
  else
    std::printf("%.1e,%.1e,", error[error.size() / 2], error.back());
  std::printf("%.1e\n", absolute);
  std::fflush(stdout);
}

void rows(const char* pairs, const Table& t) {
  std::array<std::vector<double>, 5> rest;
  for (auto& c : rest) c.resize(kPairs);
  for (const Isa isa : {Isa::avx512, Isa::avx2, Isa::scalar}) {
    if (isa > machine_isa()) continue;
    const OverlapBatch batch = overlap_batch(isa);
    row(pairs, "batch " + std::string(name(isa)), t, kPairs, 400, [&](std::vector<double>& out) {
      batch(kPairs, t.a, t.b,
            {out.data(), rest[0].data(), rest[1].data(), rest[2].data(), rest[3].data(), rest[4].data()});
    });
  }
  const auto each = [&](std::size_t count, auto&& area) {
    return [&t, count, area](std::vector<double>& out) {
      for (std::size_t k = 0; k < count; ++k) out[k] = area(t.pairs[k].a, t.pairs[k].b);
    };
  };
  row(pairs, "Sutherland-Hodgman", t, kPairs, 100, each(kPairs, sutherland_hodgman));
  row(pairs, "exact", t, kPairs, 20,
      each(kPairs, [](const Triangle& a, const Triangle& b) { return triangle_overlap(a, b).area; }));
  std::vector<double> types(kPairs);
  row(pairs, "exact type only", t, kPairs, 50, [&](std::vector<double>& out) {
    for (std::size_t k = 0; k < kPairs; ++k) types[k] = double(overlap_type(t.pairs[k].a, t.pairs[k].b));
    out = t.exact;
  });
  constexpr std::size_t few = 512;
  row(pairs, "CGAL Epeck", t, few, 3,
      each(few, [](const Triangle& a, const Triangle& b) { return polygon_intersection(a.corner, b.corner).area; }));
}

}  // namespace

int main() {
  std::mt19937_64 random(1);
  std::printf(
      "pairs,method,least_ns_per_pair,median_ns_per_pair,median_relative_error,largest_relative_error,"
      "largest_error_of_side_squared\n");
  rows("random overlapping", table_of([&] {
         for (;;) {
           const auto p = oracle::triangle_pair(oracle::PairKind::random, 0, random);
           if (overlap_type(p.a, p.b) > OverlapType::degenerate) return p;
         }
       }));
  rows("corner in edge 3e-3", table_of([&] { return oracle::corner_into_edge(3e-3, random); }));
  rows("near miss 3e-3", table_of([&] { return oracle::corner_into_edge(-3e-3, random); }));
  rows("one ulp from degenerate", table_of([&] {
         return oracle::triangle_pair(random() % 2 ? oracle::PairKind::shared : oracle::PairKind::on_edge, 1, random);
       }));
}
