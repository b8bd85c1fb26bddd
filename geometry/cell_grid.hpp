// A uniform grid over the room that bodies are in: the periodic cell, or the box of an isolated packing.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/periodic_cell.hpp"

namespace isostat {

template <int D>
struct Frame {
  Vec<D> origin{}, length{};
  bool periodic = false;
  double slant = 0;  // [-] x per y of the edges that are not along x
};

// The cell itself, or without one the smallest box that holds the positions.
template <int D>
Frame<D> frame_of(const std::optional<PeriodicCell<D>>& cell, const std::vector<Vec<D>>& position) {
  if (cell) return {Vec<D>{}, cell->length, true, cell->slant()};
  Frame<D> box;
  for (int k = 0; k < D && !position.empty(); ++k) {
    const auto [low, high] = std::minmax_element(position.begin(), position.end(),
                                                 [k](const Vec<D>& a, const Vec<D>& b) { return a[k] < b[k]; });
    box.origin[k] = (*low)[k], box.length[k] = (*high)[k] - (*low)[k];
  }
  return box;
}

// Grid cells at least as wide as the cutoff (one at least), and not many more of them than bodies: a frame may be far
// larger than what is in it. In a slanted frame columns of the first axis lean with it: what they are asked by is
// x - slant y.
template <int D>
class CellGrid {
 public:
  CellGrid(const Frame<D>& frame, double cutoff, std::size_t bodies)
      : origin_(frame.origin), slant_(frame.slant), lean_(std::sqrt(1 + slant_ * slant_)) {
    std::array<double, D> wanted;
    double cells = 1;
    for (int k = 0; k < D; ++k) {
      const auto u = static_cast<std::size_t>(k);
      wanted[u] = std::clamp(frame.length[k] / (k == 0 ? lean_ * cutoff : cutoff), 1.0, kMostColumns);
      cells *= std::floor(wanted[u]);
    }
    const double most = std::max(kCellsPerBody * static_cast<double>(bodies), kAlwaysAllowed);
    const double shrink = cells > most ? std::pow(most / cells, 1.0 / D) : 1.0;
    for (int k = 0; k < D; ++k) {
      const auto u = static_cast<std::size_t>(k);
      count_[u] = std::max(1, static_cast<int>(shrink * wanted[u]));
      inverse_[u] = frame.length[k] > 0 ? count_[u] / frame.length[k] : 0.0;
    }
  }
  double lean() const { return lean_; }  // how much longer a column's edge is than it is wide; 1 in an upright frame
  int count(int axis) const { return count_[static_cast<std::size_t>(axis)]; }
  double width(int axis) const {  // across the columns; infinite in a flat frame
    return 1 / ((axis == 0 ? lean_ : 1.0) * inverse_[static_cast<std::size_t>(axis)]);
  }
  double coordinate(double x, int axis) const {  // in columns
    return (x - origin_[axis]) * inverse_[static_cast<std::size_t>(axis)];
  }
  int column(double x, int axis) const {
    return std::clamp(static_cast<int>(coordinate(x, axis)), 0, count_[static_cast<std::size_t>(axis)] - 1);
  }
  std::size_t index(const std::array<int, D>& column) const {
    std::size_t f = 0;
    for (int k = D - 1; k >= 0; --k) {
      const auto u = static_cast<std::size_t>(k);
      f = f * static_cast<std::size_t>(count_[u]) + static_cast<std::size_t>(column[u]);
    }
    return f;
  }
  std::array<int, D> columns(const Vec<D>& r) const {
    std::array<int, D> at;
    for (int k = 0; k < D; ++k) at[static_cast<std::size_t>(k)] = column(k == 0 ? r[0] - slant_ * r[1] : r[k], k);
    return at;
  }
  std::size_t index(const Vec<D>& r) const { return index(columns(r)); }
  std::size_t size() const {
    std::size_t n = 1;
    for (const int c : count_) n *= static_cast<std::size_t>(c);
    return n;
  }

 private:
  static constexpr double kMostColumns = 30000, kCellsPerBody = 16, kAlwaysAllowed = 65536;
  Vec<D> origin_;
  double slant_, lean_;
  std::array<int, D> count_{};
  std::array<double, D> inverse_{};
};

// What lies in each cell of a grid, in the order in which it was given.
template <int D>
struct GridMembers {
  std::vector<std::int32_t> begin, member;  // of cell c: member[begin[c] .. begin[c + 1])
  GridMembers(const CellGrid<D>& grid, const std::vector<Vec<D>>& position)
      : begin(grid.size() + 1, 0), member(position.size()) {
    std::vector<std::size_t> cell(position.size());
    for (std::size_t k = 0; k < position.size(); ++k) ++begin[(cell[k] = grid.index(position[k])) + 1];
    for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
    std::vector<std::int32_t> fill(begin.begin(), begin.end() - 1);
    for (std::size_t k = 0; k < position.size(); ++k)
      member[static_cast<std::size_t>(fill[cell[k]]++)] = static_cast<std::int32_t>(k);
  }
};

}  // namespace isostat
