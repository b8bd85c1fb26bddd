// Two nested Verlet lists. The outer one holds pairs within a wide skin and is rebuilt, with the bodies sorted along
// the cells of a grid, when motion may have used the skin up; the inner one is filtered from it every hundred steps or
// so and is what the force kernels run over: little more than the true interactions.
//
// Bodies are cut into chunks of consecutive storage order, a number that depends on N only. Pairs inside a chunk,
// pairs between a chunk and the next, and the rest go to groups of their own; groups of one phase touch disjoint
// bodies. So threads need no locks, and the order of every sum is the same for any number of threads.
// Within a group the pairs of a body stand in the order of the list, batches apart if the sample fits into the caches.
#pragma once
#include <cstdint>
#include <vector>

#include "dem/disks/bodies_store.hpp"
#include "dem/disks/kernel/pair_force.hpp"
#include "dem/solver/aligned.hpp"
#include "dem/state/state.hpp"
#include "geometry/periodic_cell.hpp"

namespace isostat {

// Image codes: (s1 + 1) + 3 (s2 + 1); 4 is the pair as it stands.
constexpr std::uint8_t image_code(const ImageShift<2>& s) {
  return static_cast<std::uint8_t>(s[0] + 1 + 3 * (s[1] + 1));
}
constexpr ImageShift<2> image_shift(std::uint8_t code) { return {code % 3 - 1, code / 3 - 1}; }
inline constexpr std::uint8_t kNoImage = 4;

// Consecutive pairs that one thread runs through: first those inside the cell, then those across its edge.
struct PairGroup {
  std::size_t begin = 0, images = 0, end = 0;  // multiples of kPairBatch
};

class NeighbourLists {
 public:
  // range: interaction beyond contact (D0) [a]; damping: zeta; stiffness: K_N [F0/a], for the damping coefficients.
  NeighbourLists(std::size_t bodies, double range, double damping, double stiffness);

  // Sorts and wraps the bodies, finds the pairs and attaches the given histories; for the start of a run.
  void build(BodiesStore& bodies, const PeriodicCell<2>& cell, std::vector<PairMemory> histories);

  // Once a step: pair_displacement [a] bounds how far two neighbours moved relative to each other in it. Rebuilds what
  // must be rebuilt; throws std::runtime_error if the cell has become smaller than an interaction.
  void update(BodiesStore& bodies, const PeriodicCell<2>& cell, double pair_displacement) {
    inner_travel_ += pair_displacement;
    outer_travel_ += pair_displacement;
    if (!(inner_travel_ <= inner_skin_)) rebuild(bodies, cell, pair_displacement);
  }

  void set_stiffness(double stiffness, const BodiesStore& bodies);  // K_N [F0/a], for the damping coefficients
  void scale_springs(double tangential, double moment);             // T and M of every pair, by these factors
  PairArrays arrays();
  const std::vector<PairGroup>& phase(int p) const { return phases_[p]; }  // 0: chunks, 1-2: between, 3: the rest
  static constexpr int kPhases = 4;
  static int chunk_count(std::size_t bodies);
  int chunks() const { return chunks_; }
  std::size_t chunk_begin(int chunk) const;  // first body of the chunk
  std::size_t inner_pairs() const { return i_.size(); }
  std::size_t outer_pairs() const { return outer_i_.size(); }
  std::size_t inner_rebuilds() const { return inner_rebuilds_; }
  std::size_t outer_rebuilds() const { return outer_rebuilds_; }

  template <class Visit>  // visit(i, j, shift code, T, M) for every listed pair, in list order
  void for_each(Visit&& visit) const {
    for (std::size_t k = 0; k < i_.size(); ++k)
      if (body_at(i_[k]) < static_cast<std::int32_t>(bodies_))
        visit(body_at(i_[k]), body_at(j_[k]), shift_[k], tangential_[k], moment_[k]);
  }

  void remember(SolverMemory& memory) const;
  // Lists exactly as they were when `memory` was taken; bodies are in the storage order of that time.
  void restore(const BodiesStore& bodies, const SolverMemory& memory);

 private:
  struct History {
    std::int32_t j;
    std::uint8_t shift;
    double tangential, moment;
  };
  void rebuild(BodiesStore& bodies, const PeriodicCell<2>& cell, double pair_displacement);
  void sort_bodies(BodiesStore& bodies, const PeriodicCell<2>& cell, std::vector<PairMemory>& histories);
  void find_outer(const BodiesStore& bodies);
  void filter_inner(const BodiesStore& bodies, const std::vector<PairMemory>& histories);
  std::vector<PairMemory> histories() const;
  double outer_skin_for(const PeriodicCell<2>& cell) const;
  double inner_skin_for(double pair_displacement) const;
  double damping_of(const BodyConstants& a, const BodyConstants& b) const;
  std::size_t segment_of(std::int32_t i, std::int32_t j, std::uint8_t shift) const;
  int chunk_of(std::int32_t body) const;

  static std::int32_t body_at(kernel::RowOffset o) { return static_cast<std::int32_t>(o / kernel::kRowWidth); }
  static kernel::RowOffset row_offset(std::size_t body) {
    return static_cast<kernel::RowOffset>(body * kernel::kRowWidth);
  }

  std::size_t bodies_;
  int chunks_;
  double smallest_diameter_ = 0, largest_diameter_ = 0, mean_diameter_ = 0;  // [a]
  double range_, damping_, stiffness_;
  double outer_skin_ = 0, inner_skin_ = -1, outer_travel_ = 0, inner_travel_ = 0;  // [a]
  std::size_t inner_rebuilds_ = 0, outer_rebuilds_ = 0;

  std::vector<Vec2> outer_position_, inner_position_;
  PeriodicCell<2> outer_cell_, inner_cell_;
  std::vector<std::int32_t> outer_i_, outer_j_;
  std::vector<std::uint8_t> outer_shift_;

  AlignedVector<kernel::RowOffset> i_, j_;
  AlignedVector<std::uint8_t> shift_;
  AlignedVector<double> damping_coefficient_, radius_sum_, tangential_, moment_;
  std::vector<PairGroup> phases_[kPhases];
};

}  // namespace isostat
