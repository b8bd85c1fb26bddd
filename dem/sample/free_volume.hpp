// Where the centre of one more grain may still lie: a tree of cells that is refined where trials fail.
//
// Candidates are the cells of which it is not proved that every point in them is refused. A grain k refuses all of a
// cell to radii r above max|x - x_k| - r_k, the shell to those above R_s - min|x|: this threshold is stored with the
// cell, and as radii descend, the cell is looked at again when they pass it. So a random point of the candidates is a
// random point of the enclosure, given that it is not one of those that must fail.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "dem/sample/grain_index.hpp"
#include "dem/sample/threshold_queue.hpp"
#include "dem/solver/random.hpp"

namespace isostat {

template <int D>
class FreeVolume {
 public:
  using Grain = typename GrainIndex<D>::Grain;
  struct Point {
    Vec<D> position;
    std::size_t level, place;  // of its cell
  };

  // radius_last: no grain to come is smaller.
  FreeVolume(const Enclosure<D>& enclosure, const GrainIndex<D>& grains, double radius_first, double radius_last);

  void descend(double radius);  // of the grain that comes next
  double fraction() const;      // of the enclosure's measure that candidates take; they lie in it
  Point draw(Random& random) const;
  // Its cell is found to be covered by that grain (none: by the shell), or divided.
  void refine(const Point& refused, const Grain* by);

  std::size_t cells() const { return parked_.size() + candidates_; }

 private:
  static constexpr std::size_t kLevels = 26;  // 64 roots, halved: columns fit in 32 bits

  struct Cell {
    std::array<std::uint32_t, D> at;  // column in the grid of its level
    std::uint32_t level;
  };

  Vec<D> middle(const Cell& cell) const;
  bool inside(const Cell& cell) const;
  double threshold(const Cell& cell, const Grain& grain) const;
  double shell_threshold(const Cell& cell) const;
  std::vector<Grain> neighbours(const Cell& cell) const;
  void admit(const Cell& cell, const std::vector<Grain>& near);
  void divide(const Cell& cell, const std::vector<Grain>& near);
  void open(const Cell& cell);
  void park(const Cell& cell, double at);

  const Enclosure<D>& enclosure_;
  const GrainIndex<D>& grains_;
  Frame<D> frame_;
  double radius_, radius_last_;
  std::array<std::vector<Cell>, kLevels> active_;  // candidates
  std::array<Vec<D>, kLevels> edge_;
  std::array<double, kLevels> weight_;  // measure of a cell over that of the enclosure
  ThresholdQueue<Cell> parked_;         // refused to radii above the threshold
  std::size_t candidates_ = 0;
};

}  // namespace isostat
