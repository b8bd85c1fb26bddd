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

  static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

  // Of a body with its centre at r; `except` is the body itself, where it has been placed already.
  bool free(const Vec<D>& r, double radius, const Bodies<D>& bodies, std::size_t except = kNobody) const {
    return visit(r, bodies, [&](std::size_t k, double distance) {
      return k == except || !(distance < radius + bodies.radius[k] + gap_);
    });
  }

  // look(k, distance of its centre from r) for the bodies that may be near, until it says false; whether it never did.
  template <class Look>
  bool visit(const Vec<D>& r, const Bodies<D>& bodies, Look look) const {
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
        if (!look(k, norm(d))) return false;
      }
      std::size_t a = 0;
      while (a < D && ++step[a] > 1) step[a++] = -1;
      if (a == D) return true;
    }
  }
  void add(const Vec<D>& r, std::size_t k) { members_[grid_.index(r)].push_back(k); }
  void remove(const Vec<D>& r, std::size_t k) { std::erase(members_[grid_.index(r)], k); }

 private:
  std::optional<PeriodicCell<D>> cell_;
  double gap_;
  CellGrid<D> grid_;
  std::vector<std::vector<std::size_t>> members_;
};

}  // namespace isostat
