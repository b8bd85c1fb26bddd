// Near pairs among bodies of very different sizes. Each factor of two in diameter, counted from the smallest, has a
// grid of its own, as wide as its bodies reach. Between two levels either every body of the finer looks for partners in
// the coarser grid, in the few cells that its reach touches, or, where the larger bodies are few, they look in the
// finer grid, whose cells are read in rows: the inside of a large body is empty and costs nothing. What is cheaper
// follows from the numbers of bodies. In a tilted cell columns of the first axis lean with it: a place along it is
// x - slant y, which an image along the second edge leaves as it is.
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
  // Positions inside the cell, if there is one; pairs are wanted whose gap is at most `beyond` [a]. Opposite faces of
  // the cell are at least as far apart as the largest diameter and `beyond`.
  SizeLevels(const std::optional<PeriodicCell<D>>& cell, const std::vector<Vec<D>>& position,
             const std::vector<double>& radius, double beyond)
      : cell_(cell), position_(position), radius_(radius), beyond_(beyond), level_(position.size()) {
    const double smallest = *std::min_element(radius.begin(), radius.end());
    std::vector<std::vector<std::int32_t>> bodies(kMostLevels);
    for (std::size_t k = 0; k < position.size(); ++k) {
      level_[k] = std::clamp(static_cast<int>(std::log2(radius[k] / smallest)), 0, kMostLevels - 1);
      bodies[static_cast<std::size_t>(level_[k])].push_back(static_cast<std::int32_t>(k));
    }
    const Frame<D> frame = frame_of(cell, position);
    slant_ = frame.slant;
    levels_.reserve(kMostLevels);
    for (const std::vector<std::int32_t>& of_level : bodies) levels_.emplace_back(frame, of_level, *this);
    for (std::size_t from = 0; from < kMostLevels; ++from)
      for (std::size_t in = 0; in < kMostLevels; ++in)
        searches_[from][in] = from <= in ? cost(from, in) <= cost(in, from) : cost(from, in) < cost(in, from);
  }

  // visit(i, j, s): body j, moved by s cells, is near body i. Each pair of bodies and image once.
  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    for (std::size_t i = 0; i < position_.size(); ++i) {
      const auto from = static_cast<std::size_t>(level_[i]);
      for (std::size_t l = 0; l < kMostLevels; ++l)
        if (searches_[from][l] && !levels_[l].members.empty()) {
          if (l == from)
            levels_[l].template search<true>(i, *this, visit);
          else
            levels_[l].template search<false>(i, *this, visit);
        }
    }
  }

 private:
  static constexpr int kMostLevels = 20;         // beyond a size ratio of a million the coarsest grid holds the rest
  static constexpr double kRounding = 1 + 1e-9;  // of a reach that ends on the edge of a grid cell

  struct Member {
    Vec<D> position;
    double radius;
    std::int32_t body;
  };
  struct Level {
    CellGrid<D> grid;
    double largest_radius = 0;
    std::array<double, D> width{};    // [a] of a column; 0 in a flat frame
    double per_width = 0;             // along the first axis, columns per length along it
    std::vector<std::int32_t> begin;  // of cell c: members[begin[c] .. begin[c + 1])
    std::vector<Member> members;

    Level(const Frame<D>& frame, const std::vector<std::int32_t>& bodies, const SizeLevels& all)
        : grid(frame, reach_of(bodies, all), bodies.size()) {
      if (bodies.empty()) return;
      for (int a = 0; a < D; ++a) width[static_cast<std::size_t>(a)] = frame.length[a] > 0 ? grid.width(a) : 0.0;
      per_width = width[0] > 0 ? 1 / (grid.lean() * width[0]) : 0.0;
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

    // Rows of cells that a body of this radius touches, about.
    double rows_for(double radius, double beyond) const {
      double rows = 1;
      for (int a = 1; a < D; ++a)
        rows *= 1 + std::min(2 * (radius + largest_radius + beyond) / grid.width(a), 1.0 * grid.count(a));
      return rows;
    }

    // The cells of this grid that the reach of body i touches: a range of columns along each axis, counted on beyond
    // the edges of the cell. Of its own level a body sees the half of the cells that come after its own, and of its own
    // cell the bodies that come after it: so each pair is seen once.
    template <bool kOwn, class Visit>
    void search(std::size_t i, const SizeLevels& all, Visit& visit) const {
      Vec<D> ri = all.position_[i];
      ri[0] -= all.slant_ * ri[1];
      const double reach = (all.radius_[i] + largest_radius + all.beyond_) * kRounding;
      Box box;
      for (int a = 0; a < D; ++a) {
        const auto u = static_cast<std::size_t>(a);
        const int n = grid.count(a);
        const double along = a == 0 ? grid.lean() * reach : reach;
        const auto whole = [n](double x) { return static_cast<int>(std::clamp(x, -1.0 * n, 2.0 * n - 1) + n) - n; };
        box.low[u] = whole(grid.coordinate(ri[a] - along, a)), box.high[u] = whole(grid.coordinate(ri[a] + along, a));
        if (!all.cell_) box.low[u] = std::max(box.low[u], 0), box.high[u] = std::min(box.high[u], n - 1);
        box.at[u] = grid.coordinate(ri[a], a);
        if constexpr (kOwn) box.own[u] = grid.column(ri[a], a);
      }
      rows<D - 1, kOwn>(i, all, visit, box, reach * reach, 0, {}, {}, kOwn, {});
    }

    struct Box {
      std::array<int, D> low, high, own;
      std::array<double, D> at;  // the body, in columns
    };

    struct Lean {
      double low = 0, high = 0;  // in columns
    };

    // Axes from the last to the first. `rest`: the squared reach less the squared distance of the columns so far.
    // `level_with`: so far the columns are those of the body's own cell. `lean`: by how much columns of the first axis
    // are shifted between the body and what is near it in this row.
    template <int kAxis, bool kOwn, class Visit>
    void rows(std::size_t i, const SizeLevels& all, Visit& visit, const Box& box, double rest, std::size_t index,
              const Vec<D>& offset, ImageShift<D> shift, bool level_with, const Lean& lean) const {
      const int n = grid.count(kAxis);
      constexpr auto u = static_cast<std::size_t>(kAxis);
      const int low = kOwn && level_with ? box.own[u] : box.low[u];
      if constexpr (kAxis > 0) {
        for (int c = low; c <= box.high[u]; ++c) {
          const double away = width[u] * std::max({0.0, c - box.at[u], box.at[u] - (c + 1)});
          if (away * away > rest) continue;
          const int s = c < 0 ? -1 : c >= n ? 1 : 0;
          shift[u] = s;
          Vec<D> moved = offset;
          if (s != 0) moved[kAxis] = s * all.cell_->length[kAxis];
          if (kAxis == 1 && s != 0) moved[0] += s * all.cell_->tilt;
          rows<kAxis - 1, kOwn>(
              i, all, visit, box, rest - away * away,
              (index + static_cast<std::size_t>(c - s * n)) * static_cast<std::size_t>(grid.count(kAxis - 1)), moved,
              shift, level_with && c == box.own[u], kAxis == 1 ? lean_over(c, all, box, std::sqrt(rest)) : lean);
        }
      } else {
        const double half = std::sqrt(rest) * per_width + kRounding - 1;  // in columns
        const auto whole = [n](double x) { return static_cast<int>(std::clamp(x, -1.0 * n, 2.0 * n - 1) + n) - n; };
        const int begins = std::max(low, whole(box.at[u] + lean.low - half)),
                  ends = std::min(box.high[u], whole(box.at[u] + lean.high + half));
        for (int s = begins < 0 ? -1 : 0; s * n <= ends; ++s) {
          const int first = std::max(begins, s * n), last = std::min(ends, s * n + n - 1);
          if (first > last) continue;
          shift[u] = s;
          Vec<D> moved = offset;
          if (s != 0) moved[kAxis] += s * all.cell_->length[kAxis];
          const auto from = static_cast<std::size_t>(begin[index + static_cast<std::size_t>(first - s * n)]);
          const auto to = static_cast<std::size_t>(begin[index + static_cast<std::size_t>(last - s * n) + 1]);
          // The first cell of this run is the body's own.
          const bool own = kOwn && level_with && s == 0;
          scan(from, to, i, own ? static_cast<std::size_t>(begin[index + static_cast<std::size_t>(first) + 1]) : from,
               all, visit, moved, shift);
        }
      }
    }

    // Of the heights of row c that are within the reach.
    Lean lean_over(int c, const SizeLevels& all, const Box& box, double reach) const {
      const double low = std::clamp(width[1] * (c - box.at[1]), -reach, reach),
                   high = std::clamp(width[1] * (c + 1 - box.at[1]), -reach, reach);
      const double a = -all.slant_ * low * per_width, b = -all.slant_ * high * per_width;
      return {std::min(a, b), std::max(a, b)};
    }

    // Up to `own` only bodies of a higher index.
    template <class Visit>
    void scan(std::size_t from, std::size_t to, std::size_t i, std::size_t own, const SizeLevels& all, Visit& visit,
              const Vec<D>& offset, const ImageShift<D>& shift) const {
      const Vec<D> from_j = all.position_[i] - offset;
      const double reach_i = all.radius_[i] + all.beyond_;
      for (std::size_t m = from; m < to; ++m) {
        const Member& j = members[m];
        const Vec<D> d = j.position - from_j;
        const double reach = reach_i + j.radius;
        if (dot(d, d) > reach * reach || (m < own && j.body <= static_cast<std::int32_t>(i))) continue;
        visit(static_cast<std::int32_t>(i), j.body, shift);
      }
    }
  };

  // Of all bodies of one level in the grid of another.
  double cost(std::size_t from, std::size_t in) const {
    return static_cast<double>(levels_[from].members.size()) *
           levels_[in].rows_for(levels_[from].largest_radius, beyond_);
  }

  const std::optional<PeriodicCell<D>>& cell_;
  const std::vector<Vec<D>>& position_;
  const std::vector<double>& radius_;
  double beyond_, slant_ = 0;
  std::vector<int> level_;
  std::vector<Level> levels_;
  std::array<std::array<bool, kMostLevels>, kMostLevels> searches_{};  // bodies of the first in the grid of the second
};

}  // namespace isostat
