// Random sequential placement without overlap, with a grid of cells of the largest diameter: in a periodic cell, or in
// a room (its columns at the edges see those on the other side, where nothing is near).
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "dem/state/packing.hpp"
#include "geometry/cell_grid.hpp"

namespace isostat {

template <int D>
class Placement {
 public:
  Placement(const Frame<D>& frame, double largest_diameter, double gap, std::size_t bodies)
      : gap_(gap), grid_(frame, largest_diameter + gap, bodies), members_(grid_.size()) {
    if (frame.periodic) cell_ = PeriodicCell<D>{frame.length};
  }

  bool free(const Vec<D>& r, double radius, const Bodies<D>& bodies) const {
    const std::array<int, D> at = grid_.columns(r);
    std::array<int, D> step;
    step.fill(-1);
    for (;;) {
      std::array<int, D> column;
      for (std::size_t a = 0; a < D; ++a) {
        const int n = grid_.count(static_cast<int>(a));
        column[a] = (at[a] + step[a] + n) % n;
      }
      for (const std::size_t k : members_[grid_.index(column)]) {
        Vec<D> d = bodies.position[k] - r;
        if (cell_) d += cell_->offset(cell_->nearest_image(d));
        if (norm(d) < radius + bodies.radius[k] + gap_) return false;
      }
      std::size_t a = 0;
      while (a < D && ++step[a] > 1) step[a++] = -1;
      if (a == D) return true;
    }
  }
  void add(const Vec<D>& r, std::size_t k) { members_[grid_.index(r)].push_back(k); }

 private:
  std::optional<PeriodicCell<D>> cell_;
  double gap_;
  CellGrid<D> grid_;
  std::vector<std::vector<std::size_t>> members_;
};

}  // namespace isostat
