// Grains of widely different size, and which of them are near a point: one grid for each factor of two in radius.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "dem/sample/enclosure.hpp"

namespace isostat {

template <int D>
class GrainIndex {
 public:
  struct Grain {
    Vec<D> centre;
    double radius;
  };

  // expected: how many grains may come of radius in (largest 2^-(t + 1), largest 2^-t], by tier t; it bounds the grids.
  GrainIndex(const Enclosure<D>& enclosure, double largest, const std::vector<std::size_t>& expected)
      : enclosure_(enclosure), frame_(enclosure.frame()), largest_(largest) {
    double edge = kColumnsPerRadius * largest;
    for (const std::size_t n : expected) {
      tiers_.emplace_back(enclosure.frame(), edge, n);
      edge /= 2;
    }
  }
  static std::size_t tier(double largest, double radius) {
    return static_cast<std::size_t>(std::max(0, std::ilogb(largest / radius)));
  }

  const std::vector<Grain>& grains() const { return grains_; }

  void add(const Vec<D>& centre, double radius) {
    Tier& t = tiers_[tier(largest_, radius)];
    t.largest = std::max(t.largest, radius);
    std::int32_t& first = t.first[t.grid.index(centre)];
    next_.push_back(std::exchange(first, static_cast<std::int32_t>(grains_.size())));
    grains_.push_back({centre, radius});
    tier_of_.push_back(static_cast<std::uint8_t>(&t - tiers_.data()));
  }
  void grow(std::size_t k, double radius) {
    grains_[k].radius = radius;
    Tier& t = tiers_[tier_of_[k]];
    t.largest = std::max(t.largest, radius);
  }

  // Calls visit(k, distance of centres) for every grain whose surface is nearer to the point than `reach`, and stops
  // where it returns true: is there such a grain?
  template <class Visit>
  bool any_within(const Vec<D>& point, double reach, const Visit& visit) const {
    for (const Tier& t : tiers_)
      if (t.largest > 0 && any_in_tier(t, point, reach, visit)) return true;
    return false;
  }

  // Of the grains that overlap with this one, if there are any, that which does so deepest.
  const Grain* overlapping(const Vec<D>& point, double radius) const {
    const Grain* found = nullptr;
    double least = radius;
    any_within(point, radius, [&](std::size_t k, double distance) {
      const double gap = distance - grains_[k].radius;
      if (!found || gap < least) found = &grains_[k], least = gap;
      return false;
    });
    return found;
  }

 private:
  static constexpr double kColumnsPerRadius = 2;

  struct Tier {
    Tier(const Frame<D>& frame, double edge, std::size_t n) : grid(frame, edge, n), first(grid.size(), kNone) {
      for (int k = 0; k < D; ++k) inverse[k] = 1 / grid.width(k);
    }
    CellGrid<D> grid;
    Vec<D> inverse;
    std::vector<std::int32_t> first;  // grain of a cell, and from there on by next_
    double largest = 0;
  };

  template <class Visit>
  bool any_in_tier(const Tier& t, const Vec<D>& point, double reach, const Visit& visit) const {
    std::array<int, D> low, high, at;
    for (int k = 0; k < D; ++k) {
      const auto u = static_cast<std::size_t>(k);
      const double x = point[k] - frame_.origin[k], far = t.largest + reach;
      const int n = t.grid.count(k);
      low[u] = static_cast<int>(std::floor((x - far) * t.inverse[k]));
      high[u] = static_cast<int>(std::floor((x + far) * t.inverse[k]));
      if (!frame_.periodic)
        low[u] = std::clamp(low[u], 0, n - 1), high[u] = std::clamp(high[u], 0, n - 1);
      else if (high[u] - low[u] + 1 >= n)
        low[u] = 0, high[u] = n - 1;
      at[u] = low[u];
    }
    for (;;) {
      std::array<int, D> column = at;
      for (std::size_t u = 0; frame_.periodic && u < D; ++u) {
        const int n = t.grid.count(static_cast<int>(u));
        column[u] += at[u] < 0 ? n : at[u] >= n ? -n : 0;
      }
      for (std::int32_t i = t.first[t.grid.index(column)]; i != kNone; i = next_[static_cast<std::size_t>(i)]) {
        const auto k = static_cast<std::size_t>(i);
        const Vec<D> d = enclosure_.separation(point, grains_[k].centre);
        const double most = grains_[k].radius + reach, square = dot(d, d);
        if (square < most * most && visit(k, std::sqrt(square))) return true;
      }
      std::size_t u = 0;
      while (u < D && ++at[u] > high[u]) at[u] = low[u], ++u;
      if (u == D) return false;
    }
  }

  static constexpr std::int32_t kNone = -1;

  Enclosure<D> enclosure_;
  Frame<D> frame_;
  double largest_;
  std::vector<Tier> tiers_;
  std::vector<Grain> grains_;
  std::vector<std::int32_t> next_;
  std::vector<std::uint8_t> tier_of_;
};

}  // namespace isostat
