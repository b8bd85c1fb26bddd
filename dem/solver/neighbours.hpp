// Two nested Verlet lists. The outer one holds pairs within a wide skin and is rebuilt, with the bodies sorted along
// the cells of a grid, when motion may have used the skin up; the inner one is filtered from it every hundred steps or
// so and is what the force kernels run over: little more than the true interactions.
//
// Bodies are cut into chunks of consecutive storage order, a number that depends on N only. Pairs inside a chunk,
// pairs between a chunk and the next, and the rest go to groups of their own; groups of one phase touch disjoint
// bodies. So threads need no locks, and the order of every sum is the same for any number of threads.
// Within a group the pairs of a body stand in the order of the list, batches apart if the sample fits into the caches.
//
// The lists see positions and radii. What a listed pair carries is a type Columns:
//   kDimension         of space
//   Columns::Bodies    the bodies' store: size(), position(k), radius(k), id[k], place(k, r), reorder(to),
//                      static pad(n, k) of kPads padding pairs; if there are bodies that never interact with each
//                      other whatever they do, inert(i, j)
//   Columns::History   what a pair keeps from step to step; History{} is none
//   kStride            kernels name body k by kStride k
//   resize(n), fill(k, bodies, i, j), history(k), remember(k, history), static turned(history)
//   static inner_skin(displacement of neighbours a step, mean diameter), kOuterSkin: optional, where the default skins
//   do not suit
//   kShortRows         optional: bodies are sorted row by row along the shorter side of what holds them, not along x
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "dem/solver/aligned.hpp"
#include "dem/state/list_memory.hpp"
#include "geometry/cell_grid.hpp"

namespace isostat {

// Image codes: (s1 + 1) + 3 (s2 + 1)(+ 9 (s3 + 1)); the one in the middle is the pair as it stands.
template <int D>
inline constexpr std::uint8_t kImages = D == 2 ? 9 : 27;
template <int D>
inline constexpr std::uint8_t kNoImage = kImages<D> / 2;
template <std::size_t D>
constexpr std::uint8_t image_code(const std::array<int, D>& shift) {
  int code = 0;
  for (std::size_t a = D; a-- > 0;) code = 3 * code + shift[a] + 1;
  return static_cast<std::uint8_t>(code);
}
template <int D>
constexpr ImageShift<D> image_shift(std::uint8_t code) {
  ImageShift<D> shift{};
  int rest = code;
  for (int& s : shift) s = rest % 3 - 1, rest /= 3;
  return shift;
}

// Groups begin and end at multiples of kPairBatch, the widest batch of any kernel (two AVX-512 vectors).
inline constexpr std::size_t kPairBatch = 16;

// Consecutive pairs that one thread runs through: first those inside the cell, then those across its edge.
struct PairGroup {
  std::size_t begin = 0, images = 0, end = 0;  // multiples of kPairBatch
};

// The lists cannot be made: the cell has become smaller than an interaction, or a body is lost. What to do about it
// the caller knows.
struct ListFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <class Columns>
class NeighbourLists {
 public:
  using Bodies = typename Columns::Bodies;
  using History = typename Columns::History;
  static constexpr int D = Columns::kDimension;
  using Pair = PairMemory<History, D>;
  using Cell = std::optional<PeriodicCell<D>>;

  // range: interaction beyond contact [a].
  NeighbourLists(std::size_t bodies, double range, Columns columns);

  // Sorts and wraps the bodies, finds the pairs and attaches the given histories; for the start of a run.
  void build(Bodies& bodies, const Cell& cell, std::vector<Pair> histories);

  // Once a step: pair_displacement [a] bounds how far two neighbours moved relative to each other in it. Rebuilds what
  // must be rebuilt; throws ListFailure.
  void update(Bodies& bodies, const Cell& cell, double pair_displacement) {
    inner_travel_ += pair_displacement;
    outer_travel_ += pair_displacement;
    if (!(inner_travel_ <= inner_skin_) || turns_ != 0) rebuild(bodies, cell, pair_displacement);
  }
  // The tilt of the cell has been lowered by so many L1, PeriodicCell::turns(): update() then rebuilds.
  void turn(int turns) { turns_ += turns; }
  // Bodies that move after update() tell so: it counts towards the next one.
  void add_travel(double pair_displacement) {
    inner_travel_ += pair_displacement;
    outer_travel_ += pair_displacement;
  }
  // Whether update() would rebuild: for who must prepare the bodies.
  bool outgrown(double pair_displacement) const {
    return !(inner_travel_ + pair_displacement <= inner_skin_) || turns_ != 0;
  }
  double inner_skin() const { return inner_skin_; }  // [a] within which listed pairs are

  Columns& columns() { return columns_; }
  const Columns& columns() const { return columns_; }
  const std::uint32_t* i() const { return i_.data(); }  // times Columns::kStride, as the kernels want it
  const std::uint32_t* j() const { return j_.data(); }
  const std::uint8_t* shift() const { return shift_.data(); }
  const std::vector<PairGroup>& phase(int p) const { return phases_[p]; }  // 0: chunks, 1-2: between, 3: the rest
  static constexpr int kPhases = 4;
  static int chunk_count(std::size_t bodies);
  int chunks() const { return chunks_; }
  std::size_t chunk_begin(int chunk) const;                                      // first body of the chunk
  const std::vector<Vec<D>>& inner_position() const { return inner_position_; }  // [a] when the inner list was made
  const Cell& inner_cell() const { return inner_cell_; }
  std::size_t inner_pairs() const { return i_.size(); }
  std::size_t outer_pairs() const { return outer_i_.size(); }
  std::size_t inner_rebuilds() const { return inner_rebuilds_; }
  std::size_t outer_rebuilds() const { return outer_rebuilds_; }

  template <class Visit>  // visit(place, i, j, shift code) for every listed pair, in list order
  void for_each(Visit&& visit) const {
    for (std::size_t k = 0; k < i_.size(); ++k)
      if (body_at(i_[k]) < static_cast<std::int32_t>(bodies_)) visit(k, body_at(i_[k]), body_at(j_[k]), shift_[k]);
  }

  void remember(ListMemory<D>& memory, std::vector<Pair>& pairs) const;
  // Lists exactly as they were when `memory` was taken; bodies are in the storage order of that time.
  void restore(const Bodies& bodies, const ListMemory<D>& memory, const std::vector<Pair>& pairs);

 private:
  struct Claimable {
    std::int32_t j;
    std::uint8_t shift;
    History history;
  };
  void measure(const Bodies& bodies);
  void rebuild(Bodies& bodies, const Cell& cell, double pair_displacement);
  void sort_bodies(Bodies& bodies, const Cell& cell, std::vector<Pair>& histories);
  void find_outer(const Bodies& bodies);
  void filter_inner(const Bodies& bodies, const std::vector<Pair>& histories);
  std::vector<Pair> histories() const;
  void find_outer_by_size(const Bodies& bodies);
  bool broad() const;
  CellGrid<D> grid_in(const Frame<D>& frame, double cutoff) const;
  double outer_skin_for(const Cell& cell) const;
  double inner_skin_for(double pair_displacement) const;
  std::size_t segment_of(std::int32_t i, std::int32_t j, std::uint8_t shift) const;
  int chunk_of(std::int32_t body) const;

  static std::int32_t body_at(std::uint32_t o) { return static_cast<std::int32_t>(o / Columns::kStride); }
  static std::uint32_t offset_of(std::size_t body) { return static_cast<std::uint32_t>(body * Columns::kStride); }

  std::size_t bodies_;
  int chunks_;
  double smallest_diameter_ = 0, largest_diameter_ = 0, mean_diameter_ = 0;  // [a]
  double range_;
  double outer_skin_ = 0, inner_skin_ = -1, outer_travel_ = 0, inner_travel_ = 0;  // [a]
  std::size_t inner_rebuilds_ = 0, outer_rebuilds_ = 0;
  int turns_ = 0;  // since the last rebuild

  std::vector<Vec<D>> outer_position_, inner_position_;
  Cell outer_cell_, inner_cell_;
  std::vector<std::int32_t> outer_i_, outer_j_;
  std::vector<std::uint8_t> outer_shift_;

  AlignedVector<std::uint32_t> i_, j_;
  AlignedVector<std::uint8_t> shift_;
  Columns columns_;
  std::vector<PairGroup> phases_[kPhases];
};

}  // namespace isostat
