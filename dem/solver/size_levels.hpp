// Near pairs among bodies of very different sizes. Each factor of two in diameter has a grid of its own, as wide as its
// bodies reach. A body looks for partners of its own level and of the coarser ones, in the few cells that its reach
// touches: the smaller body finds the larger, never the other way round, so that a large body meets its many small
// neighbours one by one and no cell holds more than a few bodies of its level.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/cell_grid.hpp"

namespace isostat {

template <int D>
class SizeLevels {
 public:
  // Positions inside the cell, if there is one; pairs are wanted whose gap is at most `beyond` [a]. In each direction
  // the cell is at least as long as the largest diameter and `beyond`.
  SizeLevels(const std::optional<PeriodicCell<D>>& cell, const std::vector<Vec<D>>& position,
             const std::vector<double>& radius, double beyond)
      : cell_(cell), position_(position), radius_(radius), beyond_(beyond), level_(position.size()) {
    const double largest = *std::max_element(radius.begin(), radius.end());
    std::vector<std::vector<std::int32_t>> bodies(kMostLevels);
    for (std::size_t k = 0; k < position.size(); ++k) {
      level_[k] = std::clamp(static_cast<int>(std::log2(largest / radius[k])), 0, kMostLevels - 1);
      bodies[static_cast<std::size_t>(level_[k])].push_back(static_cast<std::int32_t>(k));
    }
    const Frame<D> frame = frame_of(cell, position);
    levels_.reserve(kMostLevels);
    for (const std::vector<std::int32_t>& of_level : bodies) levels_.emplace_back(frame, of_level, *this);
  }

  // visit(i, j, s): body j, moved by s cells, is near body i. Each pair of bodies and image once, from the body of the
  // finer level; within a level i < j.
  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    for (std::size_t i = 0; i < position_.size(); ++i)
      for (int l = 0; l <= level_[i]; ++l) levels_[static_cast<std::size_t>(l)].search(i, l == level_[i], *this, visit);
  }

 private:
  static constexpr int kMostLevels = 20;         // beyond a size ratio of a million the finest grid holds the rest
  static constexpr double kRounding = 1 + 1e-9;  // of a reach that ends on the edge of a grid cell

  struct Member {
    Vec<D> position;
    double radius;
    std::int32_t body;
  };
  struct Level {
    CellGrid<D> grid;
    double largest_radius = 0;
    std::vector<std::int32_t> begin;  // of cell c: members[begin[c] .. begin[c + 1])
    std::vector<Member> members;

    Level(const Frame<D>& frame, const std::vector<std::int32_t>& bodies, const SizeLevels& all)
        : grid(frame, reach_of(bodies, all), bodies.size()) {
      if (bodies.empty()) return;
      begin.assign(grid.size() + 1, 0), members.resize(bodies.size());
      std::vector<std::size_t> cell(bodies.size());
      for (std::size_t n = 0; n < bodies.size(); ++n) {
        const auto k = static_cast<std::size_t>(bodies[n]);
        largest_radius = std::max(largest_radius, all.radius_[k]);
        ++begin[(cell[n] = grid.index(all.position_[k])) + 1];
      }
      for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
      std::vector<std::int32_t> fill(begin.begin(), begin.end() - 1);
      for (std::size_t n = 0; n < bodies.size(); ++n) {
        const auto k = static_cast<std::size_t>(bodies[n]);
        members[static_cast<std::size_t>(fill[cell[n]]++)] = {all.position_[k], all.radius_[k], bodies[n]};
      }
    }
    static double reach_of(const std::vector<std::int32_t>& bodies, const SizeLevels& all) {
      double largest = 0;
      for (const std::int32_t k : bodies) largest = std::max(largest, all.radius_[static_cast<std::size_t>(k)]);
      return 2 * largest + all.beyond_;
    }

    // The cells of this grid that the reach of body i touches: a range of columns along each axis, counted on beyond
    // the edges of the cell.
    template <class Visit>
    void search(std::size_t i, bool own_level, const SizeLevels& all, Visit& visit) const {
      if (members.empty()) return;
      const Vec<D>& ri = all.position_[i];
      const double reach = (all.radius_[i] + largest_radius + all.beyond_) * kRounding;
      std::array<int, D> low, high;
      for (int a = 0; a < D; ++a) {
        const auto u = static_cast<std::size_t>(a);
        low[u] = static_cast<int>(std::floor(grid.coordinate(ri[a] - reach, a)));
        high[u] = static_cast<int>(std::floor(grid.coordinate(ri[a] + reach, a)));
        const int n = grid.count(a);
        if (!all.cell_)
          low[u] = std::clamp(low[u], 0, n - 1), high[u] = std::clamp(high[u], 0, n - 1);
        else
          low[u] = std::max(low[u], -n), high[u] = std::min(high[u], 2 * n - 1);
      }
      rows<D - 1>(i, own_level, all, visit, low, high, 0, {}, {});
    }

    // Axes from the last to the first; the cells of a row along the first axis lie side by side but for its edges.
    template <int kAxis, class Visit>
    void rows(std::size_t i, bool own_level, const SizeLevels& all, Visit& visit, const std::array<int, D>& low,
              const std::array<int, D>& high, std::size_t index, const Vec<D>& offset, ImageShift<D> shift) const {
      const int n = grid.count(kAxis);
      const auto u = static_cast<std::size_t>(kAxis);
      if constexpr (kAxis > 0) {
        for (int c = low[u]; c <= high[u]; ++c) {
          const int s = c < 0 ? -1 : c >= n ? 1 : 0;
          shift[u] = s;
          Vec<D> moved = offset;
          if (s != 0) moved[kAxis] = s * all.cell_->length[kAxis];
          rows<kAxis - 1>(
              i, own_level, all, visit, low, high,
              (index + static_cast<std::size_t>(c - s * n)) * static_cast<std::size_t>(grid.count(kAxis - 1)), moved,
              shift);
        }
      } else {
        for (int s = -1; s <= 1; ++s) {
          const int first = std::max(low[u], s * n), last = std::min(high[u], s * n + n - 1);
          if (first > last) continue;
          shift[u] = s;
          Vec<D> moved = offset;
          if (s != 0) moved[kAxis] = s * all.cell_->length[kAxis];
          scan(begin[index + static_cast<std::size_t>(first - s * n)],
               begin[index + static_cast<std::size_t>(last - s * n) + 1], i, own_level, all, visit, moved, shift);
        }
      }
    }

    template <class Visit>
    void scan(std::int32_t from, std::int32_t to, std::size_t i, bool own_level, const SizeLevels& all, Visit& visit,
              const Vec<D>& offset, const ImageShift<D>& shift) const {
      const Vec<D> from_j = all.position_[i] - offset;
      const double reach_i = all.radius_[i] + all.beyond_;
      for (std::int32_t m = from; m < to; ++m) {
        const Member& j = members[static_cast<std::size_t>(m)];
        const Vec<D> d = j.position - from_j;
        const double reach = reach_i + j.radius;
        if (dot(d, d) > reach * reach) continue;
        if (own_level && j.body <= static_cast<std::int32_t>(i)) continue;
        visit(static_cast<std::int32_t>(i), j.body, shift);
      }
    }
  };

  const std::optional<PeriodicCell<D>>& cell_;
  const std::vector<Vec<D>>& position_;
  const std::vector<double>& radius_;
  double beyond_;
  std::vector<int> level_;
  std::vector<Level> levels_;
};

}  // namespace isostat
