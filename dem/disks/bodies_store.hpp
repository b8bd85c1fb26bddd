// The bodies as the kernels see them: rows, loads, constants (see kernel/row.hpp), in storage order, which follows the
// cells of the neighbour grid. Beyond the last body lie pairs of far-apart rows that pad segments: one for each group
// of a phase, because threads add to their loads at the same time. Beyond them lie feet, points of smooth walls below
// the grains that are near them, until the bodies are sorted anew.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "dem/disks/kernel/row.hpp"
#include "dem/solver/aligned.hpp"
#include "dem/state/grain_part.hpp"
#include "geometry/vec.hpp"

namespace isostat {

struct BodyConstants {
  double inverse_mass, inverse_inertia;  // [1/m], [1/(m a^2)]
  double radius;                         // [a]
  double mass;                           // [m]
};

// A body of a wall or lid: a place of the container. It has no inverse mass, so that no force moves it.
struct DrivenBody {
  std::int32_t body;  // its place in the storage
  Vec2 built;         // [a] where it was built
  GrainPart part;
};

struct BodiesStore {
  std::vector<std::int64_t> id;
  AlignedVector<double> rows;   // kernel::kRowWidth a body: x, y, u, v, R w, w, p, q
  AlignedVector<double> loads;  // kernel::kLoadWidth a body: Fx, Fy, A, B; moment = R A + B
  AlignedVector<BodyConstants> constants;
  std::vector<double> inertia;     // [m a^2] as given: 1/(1/I) is not always I, and restarts are exact
  std::vector<DrivenBody> driven;  // in storage order

  std::size_t size() const { return id.size(); }
  void resize(std::size_t n) {
    id.resize(n);
    rows.assign((n + 2 * kPads) * kernel::kRowWidth, 0.0);
    for (std::size_t k = 0; k < kPads; ++k) *row(pad(n, k) + 1) = kFar;
    loads.assign((n + 2 * kPads) * kernel::kLoadWidth, 0.0);
    constants.resize(n);
    inertia.resize(n);
  }
  double* row(std::size_t k) { return rows.data() + k * kernel::kRowWidth; }
  const double* row(std::size_t k) const { return rows.data() + k * kernel::kRowWidth; }
  double* load(std::size_t k) { return loads.data() + k * kernel::kLoadWidth; }
  const double* load(std::size_t k) const { return loads.data() + k * kernel::kLoadWidth; }
  Vec2 position(std::size_t k) const { return {{row(k)[kernel::Slot::x], row(k)[kernel::Slot::y]}}; }
  double radius(std::size_t k) const { return constants[k].radius; }

  // For the lists: body k is now at r, and body k goes to place to[k] of the storage.
  void place(std::size_t k, const Vec2& r) { row(k)[kernel::Slot::x] = r[0], row(k)[kernel::Slot::y] = r[1]; }
  void reorder(const std::vector<std::int32_t>& to) {
    BodiesStore sorted;
    sorted.resize(size());
    for (std::size_t k = 0; k < size(); ++k) {
      const auto t = static_cast<std::size_t>(to[k]);
      sorted.id[t] = id[k], sorted.constants[t] = constants[k], sorted.inertia[t] = inertia[k];
      std::copy_n(row(k), kernel::kRowWidth, sorted.row(t));
      std::copy_n(load(k), kernel::kLoadWidth, sorted.load(t));
    }
    sorted.driven = driven;
    for (DrivenBody& d : sorted.driven) d.body = to[static_cast<std::size_t>(d.body)];
    std::sort(sorted.driven.begin(), sorted.driven.end(),
              [](const DrivenBody& a, const DrivenBody& b) { return a.body < b.body; });
    *this = std::move(sorted);
  }
  // Rows of n feet, with neither radius nor inverse mass. Pairs name them like bodies, by foot(k).
  void set_feet(std::size_t n) {
    rows.resize(foot(n) * kernel::kRowWidth, 0.0);
    loads.resize(foot(n) * kernel::kLoadWidth, 0.0);
    constants.resize(n > 0 ? foot(n) : size(), BodyConstants{});
  }
  std::size_t foot(std::size_t k) const { return pad(size(), kPads) + k; }

  // Two bodies of the container.
  bool inert(std::size_t i, std::size_t j) const {
    return !driven.empty() && constants[i].inverse_mass == 0 && constants[j].inverse_mass == 0;
  }

  static constexpr std::size_t kPads = 64;
  // The first body of the k-th padding pair of n bodies; the second follows it.
  static constexpr std::size_t pad(std::size_t n, std::size_t k) { return n + 2 * k; }

 private:
  static constexpr double kFar = 1e6;  // [a] beyond any interaction; the distance of the padding pair
};

}  // namespace isostat
