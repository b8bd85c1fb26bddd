// Pairs of triangles that may overlap before the lists are made anew, packed for the kernel: of every near pair of
// grains the pairs of triangles nearer than the skin, by their separation over the six edge normals. That is a lower
// bound of the distance, so nothing is missed, at any depth and for any shape; few are listed in vain.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "dem/solver/aligned.hpp"
#include "dem/solver/neighbours.hpp"
#include "dem/triangles/grain_store.hpp"

namespace isostat {

// What a listed pair of grains carries: its friction spring. Columns of NeighbourLists (dem/solver/neighbours.hpp).
class GrainPairs {
 public:
  static constexpr int kDimension = 2;
  using Bodies = GrainStore;
  using History = GrainHistory;
  static constexpr std::uint32_t kStride = 1;

  void resize(std::size_t n) { spring_.assign(n, 0.0); }
  void fill(std::size_t, const Bodies&, std::size_t, std::size_t) {}
  History history(std::size_t k) const { return {spring_[k]}; }
  void remember(std::size_t k, const History& h) { spring_[k] = h.tangential_force; }
  static History turned(const History& h) { return h; }  // along z x n, which turns with the pair
  static constexpr bool kShortRows = true;  // a bed is wide: what touches is a row apart, in the second-level cache

  // A step costs 1.4 ns a triangle more for every .001 cm of skin (candidates), a rebuild 80 ns a triangle every skin /
  // displacement steps: the sum is least at the root of kSkin d times the displacement (TRIANGLES.md 2, sides .1-.2).
  // Sorting and laying out grains anew is dear: a wide outer skin.
  static constexpr double kOuterSkin = 0.6;  // [mean diameter]
  static double inner_skin(double displacement, double mean_diameter) {
    return std::max(std::sqrt(kSkin * mean_diameter * displacement), kLeastSkin * mean_diameter);
  }

 private:
  static constexpr double kSkin = 0.6, kLeastSkin = 1e-3;  // [diameter]
  std::vector<double> spring_;
};
extern template class NeighbourLists<GrainPairs>;

class Candidates {
 public:
  using Lists = NeighbourLists<GrainPairs>;
  using Cell = std::optional<PeriodicCell<2>>;
  struct Group {
    std::size_t begin = 0, end = 0;  // packs
  };
  // Springs of grains at smooth walls, which the lists do not know: by ids.
  struct WallSpring {
    std::int64_t grain, wall;
    double tangential_force;
  };

  // From the rows of the store as they stand; a pair is near within `skin`. Springs come from the lists' columns and
  // from `walls`.
  void build(const GrainStore& store, const Lists& lists, const Cell& cell, const TriangleLaw& law,
             SeparationKernel separation, double skin, const std::vector<WallSpring>& walls);

  // Groups of a phase touch disjoint grains; the last phase is of smooth walls, one group.
  static constexpr int kPhases = Lists::kPhases + 1;
  const std::vector<Group>& phase(int p) const { return phases_[p]; }
  std::size_t most_rows() const { return most_rows_; }
  std::size_t pairs() const { return pairs_; }  // of triangles, without padding

  template <class Visit>  // visit(grain i, grain j, slot a, slot b, offset of j) for every pair of triangles
  void for_each(Visit&& visit) const {
    for (std::size_t p = 0; p < of_lane_.size() / 8; ++p)
      for (std::size_t l = 0; l < 8; ++l) {
        const Near& near = of_lane_[8 * p + l];
        for (std::size_t r = 0; near.i != near.j && r < packs_[p].rows; ++r) {
          const std::size_t at = packs_[p].first + 8 * r + l;
          if (a_[at] < slots_)
            visit(near.i, near.j, a_[at], b_[at], Vec2{{offset_x_[8 * p + l], offset_y_[8 * p + l]}});
        }
      }
  }

  // Points the kernel's input at the arrays.
  void show(OverlapInput& in);
  void set_offsets(const Cell& cell);  // the cell moves between rebuilds
  // Springs back to where they are remembered.
  void store_springs(Lists& lists) const;
  std::vector<WallSpring> wall_springs(const GrainStore& store) const;
  std::vector<PairMemory<GrainHistory>> springs() const;  // all of them, by grains in storage order

 private:
  struct Near {  // a pair of grains, i < j
    std::uint32_t i, j;
    std::uint8_t shift;
    std::uint32_t place;  // in the lists; of a smooth wall kNowhere
    std::uint32_t begin, count;
  };
  static constexpr std::uint32_t kNowhere = 0xffffffff;
  struct Circle {  // of a triangle, about its centroid [cm]
    double x, y, reach;
  };
  void draw_circles(const GrainStore& store);
  // Of the circles of grain g those within `radius` of a point: their number; places within the grain go to `found`.
  std::size_t facing(std::size_t g, const Vec2& point, double radius, std::vector<std::uint32_t>& found) const;
  void make_room(std::size_t more);
  bool look(const GrainStore& store, Near near, const Vec2& offset, double skin);
  void pack(const GrainStore& store, SeparationKernel separation, double skin, std::size_t group);

  std::vector<OverlapPack> packs_;
  std::vector<Group> phases_[kPhases];
  AlignedVector<std::uint32_t> a_, b_;
  std::vector<std::uint32_t> seen_;                                 // OverlapInput::seen
  AlignedVector<double> stiffness_, offset_x_, offset_y_, spring_;  // by lane
  std::vector<Near> of_lane_;                                       // i == j: a lane without grains
  std::size_t most_rows_ = 0, pairs_ = 0, slots_ = 0;

  std::vector<Circle> circles_;  // grain after grain
  std::vector<std::uint32_t> circles_begin_, facing_i_, facing_j_, every_;
  std::vector<std::uint32_t> seen_by_;  // of slots: the last group that has seen it, counted from 1
  std::uint32_t groups_ = 0;

  // Of the group in the making: pairs of grains, and their pairs of triangles whose circles are near.
  std::vector<Near> near_;
  std::size_t maybes_ = 0;
  AlignedVector<std::uint32_t> maybe_a_, maybe_b_;
  AlignedVector<double> maybe_x_, maybe_y_;
  std::vector<std::uint8_t> flag_;
  std::vector<double> stiffness_of_, spring_of_;
};

}  // namespace isostat
