// The spheres as the kernels see them: rows, loads, spins, constants (see kernel/row.hpp), in storage order, which
// follows the cells of the neighbour grid. Beyond the last body lie pairs of far-apart rows that pad segments: one for
// each group of a phase, because threads add to their loads at the same time.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "dem/solver/aligned.hpp"
#include "dem/spheres/at_rest.hpp"
#include "dem/spheres/kernel/row.hpp"
#include "geometry/vec.hpp"

namespace isostat {

struct SphereConstants {
  double inverse_mass, inverse_inertia;  // [1/m], [1/(m a^2)]
  double radius;                         // [a] of a shell below zero
  double mass;                           // [m]
};

// A sphere that may touch a wall before the lists are made anew, and its spring there.
struct NearWall {
  std::int32_t body = 0, wall = 0;
  Vec3 tangential_force{};  // [F0] on the sphere
};

inline Vec3 triple_at(const double* p) { return {{p[0], p[1], p[2]}}; }
inline void put_triple(double* p, const Vec3& v) { p[0] = v[0], p[1] = v[1], p[2] = v[2]; }

struct SphereStore {
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> group;
  std::vector<SphereKind> kind;
  AlignedVector<double> rows;     // spheres::kRowWidth a body
  AlignedVector<double> loads;    // spheres::kLoadWidth a body
  AlignedVector<double> spins;    // spheres::kSpinWidth a body: half-step spin [1/T0]
  AlignedVector<double> moments;  // spheres::kSpinWidth a body: what R A lacks of the moment [F0 a]
  AlignedVector<SphereConstants> constants;
  std::vector<double> inertia;       // [m a^2] as given: 1/(1/I) is not always I, and restarts are exact
  std::vector<NearWall> near_walls;  // by body, then wall

  std::size_t size() const { return id.size(); }
  void resize(std::size_t n) {
    id.resize(n), group.assign(n, 0), kind.assign(n, SphereKind::grain);
    rows.assign((n + 2 * kPads) * spheres::kRowWidth, 0.0);
    for (std::size_t k = 0; k < kPads; ++k) *row(pad(n, k) + 1) = kFar;
    loads.assign((n + 2 * kPads) * spheres::kLoadWidth, 0.0);
    spins.assign((n + 2 * kPads) * spheres::kSpinWidth, 0.0);
    moments.assign((n + 2 * kPads) * spheres::kSpinWidth, 0.0);
    constants.resize(n);
    inertia.resize(n);
  }
  double* row(std::size_t k) { return rows.data() + k * spheres::kRowWidth; }
  const double* row(std::size_t k) const { return rows.data() + k * spheres::kRowWidth; }
  double* load(std::size_t k) { return loads.data() + k * spheres::kLoadWidth; }
  const double* load(std::size_t k) const { return loads.data() + k * spheres::kLoadWidth; }
  double* spin(std::size_t k) { return spins.data() + k * spheres::kSpinWidth; }
  const double* spin(std::size_t k) const { return spins.data() + k * spheres::kSpinWidth; }
  double* moment(std::size_t k) { return moments.data() + k * spheres::kSpinWidth; }
  const double* moment(std::size_t k) const { return moments.data() + k * spheres::kSpinWidth; }

  Vec3 position(std::size_t k) const { return triple_at(row(k) + spheres::Slot::position); }
  Vec3 half_velocity(std::size_t k) const { return triple_at(row(k) + spheres::Slot::half_velocity); }
  Vec3 half_spin(std::size_t k) const { return triple_at(spin(k)); }
  double radius(std::size_t k) const { return std::abs(constants[k].radius); }  // for the lists: what it fills
  double signed_radius(std::size_t k) const { return constants[k].radius; }     // for the law
  SphereBody body(std::size_t k) const { return {signed_radius(k), kind[k]}; }
  Vec3 force(std::size_t k) const { return triple_at(load(k) + spheres::LoadSlot::force); }
  Vec3 torque(std::size_t k) const {
    return signed_radius(k) * triple_at(load(k) + spheres::LoadSlot::moment_per_radius) + triple_at(moment(k));
  }

  // A shell is there for the grains of its group alone.
  bool inert(std::size_t i, std::size_t j) const {
    if (kind[i] != SphereKind::shell && kind[j] != SphereKind::shell) return false;
    return group[i] != group[j] || kind[i] == kind[j];
  }

  // For the lists: body k is now at r, and body k goes to place to[k] of the storage.
  void place(std::size_t k, const Vec3& r) { put_triple(row(k) + spheres::Slot::position, r); }
  void reorder(const std::vector<std::int32_t>& to) {
    SphereStore sorted;
    sorted.resize(size());
    for (std::size_t k = 0; k < size(); ++k) {
      const auto t = static_cast<std::size_t>(to[k]);
      sorted.id[t] = id[k], sorted.group[t] = group[k], sorted.kind[t] = kind[k];
      sorted.constants[t] = constants[k], sorted.inertia[t] = inertia[k];
      std::copy_n(row(k), spheres::kRowWidth, sorted.row(t));
      std::copy_n(load(k), spheres::kLoadWidth, sorted.load(t));
      std::copy_n(spin(k), spheres::kSpinWidth, sorted.spin(t));
      std::copy_n(moment(k), spheres::kSpinWidth, sorted.moment(t));
    }
    sorted.near_walls = std::move(near_walls);
    for (NearWall& w : sorted.near_walls) w.body = to[static_cast<std::size_t>(w.body)];
    std::sort(sorted.near_walls.begin(), sorted.near_walls.end(), [](const NearWall& a, const NearWall& b) {
      return a.body != b.body ? a.body < b.body : a.wall < b.wall;
    });
    *this = std::move(sorted);
  }

  void set_half_velocity(std::size_t k, const Vec3& v) { put_triple(row(k) + spheres::Slot::half_velocity, v); }
  void set_half_spin(std::size_t k, const Vec3& w) {
    put_triple(spin(k), w);
    put_triple(row(k) + spheres::Slot::half_surface, signed_radius(k) * w);
  }

  static constexpr std::size_t kPads = 64;
  // The first body of the k-th padding pair of n bodies; the second follows it.
  static constexpr std::size_t pad(std::size_t n, std::size_t k) { return n + 2 * k; }

 private:
  static constexpr double kFar = 1e6;  // [a] beyond any interaction; the distance of the padding pair
};

}  // namespace isostat
