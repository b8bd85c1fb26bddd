// NeighbourLists<Columns> written out; included where a system instantiates it.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "dem/solver/neighbours.hpp"
#include "dem/solver/size_levels.hpp"

namespace isostat {
namespace lists {

// Tuning, in the regime of METHODS.md "The disk engine"; none of these enters a result.
inline constexpr double kOuterSkin = 0.35;          // [mean diameter], of a broad distribution [smallest diameter]
inline constexpr double kInnerSteps = 100;          // steps that the inner skin should last
inline constexpr double kSmallestInnerSkin = 5e-4;  // [smallest diameter]
inline constexpr double kLargestInnerSkin = 0.3;    // [outer skin]
inline constexpr std::size_t kBodiesPerChunk = 4096;
// Beyond this ratio of sizes a grid as wide as the largest body holds too many of the smallest.
inline constexpr double kBroad = 2.5;
inline constexpr double kBroadOrder = 2;  // [mean diameter] width of the grid along which these are sorted

struct Wrapped {
  int cell, shift;
};
inline Wrapped wrap_index(int c, int n) {
  return c < 0 ? Wrapped{c + n, -1} : c >= n ? Wrapped{c - n, 1} : Wrapped{c, 0};
}

// Place of the n-th pair in a segment of so many batches. Pairs come sorted by body i. Dealt out like cards, one to
// each lane of kDeck batches before the next, those of one body come to stand batches apart; side by side, each would
// wait for the load of that body to come back from the store before it (5 to 20 % of the step,
// docs/measured/benchmarks.md). In samples beyond the caches the prefetcher wants the sorted order instead.
inline constexpr std::size_t kDeck = 16;          // batches
inline constexpr std::size_t kMostDealt = 32768;  // bodies: 3 MB of rows and loads
inline std::size_t dealt(std::size_t n, std::size_t batches) {
  const std::size_t first = n / (kDeck * kPairBatch) * kDeck, rows = std::min(kDeck, batches - first);
  const std::size_t card = n - first * kPairBatch;
  return (first + card % rows) * kPairBatch + card / rows;
}

}  // namespace lists

template <class Columns>
int NeighbourLists<Columns>::chunk_count(std::size_t bodies) {
  const int chunks = static_cast<int>(std::min<std::size_t>(bodies / lists::kBodiesPerChunk, Bodies::kPads));
  return chunks < 2 ? 1 : chunks - chunks % 2;  // even: segments between chunks alternate between two phases
}

template <class Columns>
NeighbourLists<Columns>::NeighbourLists(std::size_t bodies, double range, Columns columns)
    : bodies_(bodies), chunks_(chunk_count(bodies)), range_(range), columns_(std::move(columns)) {}

template <class Columns>
std::size_t NeighbourLists<Columns>::chunk_begin(int chunk) const {
  return bodies_ * static_cast<std::size_t>(chunk) / static_cast<std::size_t>(chunks_);
}

template <class Columns>
int NeighbourLists<Columns>::chunk_of(std::int32_t body) const {
  if (chunks_ == 1) return 0;
  int c = static_cast<int>(static_cast<std::size_t>(body) * static_cast<std::size_t>(chunks_) / bodies_);
  while (static_cast<std::size_t>(body) < chunk_begin(c)) --c;
  while (static_cast<std::size_t>(body) >= chunk_begin(c + 1)) ++c;
  return c;
}

// No pair may be listed through its second image: in a tiny cell the skin is what the cell leaves.
template <class Columns>
double NeighbourLists<Columns>::outer_skin_for(const Cell& cell) const {
  // Among many sizes the small grains are the many: a skin of the mean would list most of their second neighbours.
  double wanted = lists::kOuterSkin * (broad() ? smallest_diameter_ : mean_diameter_);
  if constexpr (requires { Columns::kOuterSkin; }) wanted = Columns::kOuterSkin * mean_diameter_;
  return cell ? std::min(wanted, cell->shortest_spacing() - largest_diameter_ - range_) : wanted;
}

template <class Columns>
auto NeighbourLists<Columns>::grid_in(const Frame<D>& frame, double cutoff) const -> CellGrid<D> {
  const Vec<D> spacing =
      frame.periodic ? PeriodicCell<D>{frame.length, frame.slant * frame.length[1]}.spacing() : Vec<D>{};
  for (int k = 0; k < D; ++k) {
    if (!std::isfinite(frame.length[k])) throw ListFailure("a position is not a number");
    if (frame.periodic && !(spacing[k] >= cutoff))
      throw ListFailure("the cell, L" + std::to_string(k + 1) + " = " + std::to_string(frame.length[k]) +
                        " a, is smaller than the largest interaction distance " + std::to_string(cutoff) +
                        " a: a grain would touch itself");
  }
  return {frame, cutoff, bodies_};
}

// In the order of size: the storage order, which changes in the run, must not show in the last bit after a restart.
template <class Columns>
void NeighbourLists<Columns>::measure(const Bodies& bodies) {
  if (bodies_ == 0) return;
  std::vector<double> radii;
  for (std::size_t k = 0; k < bodies_; ++k) radii.push_back(bodies.radius(k));
  std::sort(radii.begin(), radii.end());
  smallest_diameter_ = 2 * radii.front(), largest_diameter_ = 2 * radii.back();
  mean_diameter_ = 2 * std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(bodies_);
}

template <class Columns>
double NeighbourLists<Columns>::inner_skin_for(double pair_displacement) const {
  if constexpr (requires { Columns::inner_skin(pair_displacement, mean_diameter_); })
    return std::min(Columns::inner_skin(pair_displacement, mean_diameter_), lists::kLargestInnerSkin * outer_skin_);
  return std::min(std::max(lists::kInnerSteps * pair_displacement, lists::kSmallestInnerSkin * smallest_diameter_),
                  lists::kLargestInnerSkin * outer_skin_);
}

template <class Columns>
void NeighbourLists<Columns>::build(Bodies& bodies, const Cell& cell, std::vector<Pair> histories) {
  measure(bodies);
  if (bodies_ == 0) return;
  sort_bodies(bodies, cell, histories);
  outer_skin_ = outer_skin_for(cell);
  inner_skin_ = inner_skin_for(0);
  find_outer(bodies);
  inner_cell_ = cell;
  filter_inner(bodies, histories);
}

template <class Columns>
void NeighbourLists<Columns>::rebuild(Bodies& bodies, const Cell& cell, double pair_displacement) {
  if (bodies_ == 0) return;
  if (!std::isfinite(inner_travel_)) throw ListFailure("a velocity is not a number");
  std::vector<Pair> kept = histories();
  for (Pair& h : kept) h.shift[0] += turns_ * h.shift[1];
  inner_skin_ = inner_skin_for(pair_displacement);
  // A pair now within the inner range had, when the outer list was made, at most this gap plus what it has moved.
  if (outer_travel_ + inner_skin_ > outer_skin_ || turns_ != 0) {
    turns_ = 0;
    sort_bodies(bodies, cell, kept);
    outer_skin_ = outer_skin_for(cell);
    inner_skin_ = inner_skin_for(pair_displacement);
    find_outer(bodies);
  }
  inner_cell_ = cell;
  filter_inner(bodies, kept);
}

// Counting sort by grid cell, row by row, stable: the order is a function of the positions and the order before.
template <class Columns>
void NeighbourLists<Columns>::sort_bodies(Bodies& bodies, const Cell& cell, std::vector<Pair>& histories) {
  outer_cell_ = cell;
  std::vector<ImageShift<D>> wraps(bodies_);
  std::vector<Vec<D>> position(bodies_);
  for (std::size_t k = 0; k < bodies_; ++k) {
    Vec<D>& r = position[k] = bodies.position(k);
    if (!cell) continue;
    const Vec<D> fractions = cell->fractions(r);
    for (int a = 0; a < D; ++a) {
      const double cells = std::floor(fractions[a]);
      if (!(std::abs(cells) < 1e6)) throw ListFailure("grain " + std::to_string(bodies.id[k]) + " has left the cell");
      r[a] -= cells * cell->length[a];
      if (a == 1) r[0] -= cells * cell->tilt;
      wraps[k][static_cast<std::size_t>(a)] = static_cast<int>(cells);
    }
    bodies.place(k, r);
  }
  Frame<D> frame = frame_of(outer_cell_, position);
  if constexpr (requires { Columns::kShortRows; })
    if (frame.length[0] > frame.length[1]) {
      std::swap(frame.origin[0], frame.origin[1]), std::swap(frame.length[0], frame.length[1]);
      for (Vec<D>& r : position) std::swap(r[0], r[1]);
    }
  const double width = broad() ? std::min(lists::kBroadOrder * mean_diameter_, largest_diameter_) : largest_diameter_;
  const GridMembers<D> members(grid_in(frame, width + range_), position);
  std::vector<std::int32_t> to(bodies_);
  for (std::size_t n = 0; n < bodies_; ++n)
    to[static_cast<std::size_t>(members.member[n])] = static_cast<std::int32_t>(n);
  bodies.reorder(to);

  // r_j + s L - r_i is unchanged when j is wrapped by w_j cells and i by w_i: s becomes s + w_j - w_i.
  for (Pair& h : histories) {
    for (std::size_t a = 0; a < D; ++a)
      h.shift[a] += wraps[static_cast<std::size_t>(h.j)][a] - wraps[static_cast<std::size_t>(h.i)][a];
    h.i = to[static_cast<std::size_t>(h.i)];
    h.j = to[static_cast<std::size_t>(h.j)];
    if (h.i > h.j) {
      std::swap(h.i, h.j);
      for (int& s : h.shift) s = -s;
      h.history = Columns::turned(h.history);
    }
  }
  ++outer_rebuilds_;
}

template <class Columns>
bool NeighbourLists<Columns>::broad() const {
  return largest_diameter_ > lists::kBroad * smallest_diameter_;
}

// Pairs as the levels find them, sorted by their first body: i < j.
template <class Columns>
void NeighbourLists<Columns>::find_outer_by_size(const Bodies& bodies) {
  struct Found {
    std::int32_t i, j;
    std::uint8_t shift;
  };
  std::vector<double> radius(bodies_);
  for (std::size_t k = 0; k < bodies_; ++k) radius[k] = bodies.radius(k);
  std::vector<Found> found;
  found.reserve(4 * bodies_);
  std::vector<std::uint32_t> begin(bodies_ + 1, 0);
  const SizeLevels<D> levels(outer_cell_, outer_position_, radius, range_ + outer_skin_);
  levels.for_each_pair([&](std::int32_t i, std::int32_t j, ImageShift<D> shift) {
    if constexpr (requires { bodies.inert(0, 0); })
      if (bodies.inert(static_cast<std::size_t>(i), static_cast<std::size_t>(j))) return;
    if (i > j) {
      std::swap(i, j);
      for (int& s : shift) s = -s;
    }
    found.push_back({i, j, image_code(shift)});
    ++begin[static_cast<std::size_t>(i) + 1];
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  outer_i_.resize(found.size()), outer_j_.resize(found.size()), outer_shift_.resize(found.size());
  for (const Found& f : found) {
    const std::size_t to = begin[static_cast<std::size_t>(f.i)]++;
    outer_i_[to] = f.i, outer_j_[to] = f.j, outer_shift_[to] = f.shift;
  }
}

template <class Columns>
void NeighbourLists<Columns>::find_outer(const Bodies& bodies) {
  outer_travel_ = 0;
  outer_position_.resize(bodies_);
  for (std::size_t k = 0; k < bodies_; ++k) outer_position_[k] = bodies.position(k);
  outer_i_.clear(), outer_j_.clear(), outer_shift_.clear();

  const CellGrid<D> grid = grid_in(frame_of(outer_cell_, outer_position_), largest_diameter_ + range_ + outer_skin_);
  if (broad()) return find_outer_by_size(bodies);
  const GridMembers<D> members(grid, outer_position_);
  for (std::size_t i = 0; i < bodies_; ++i) {
    const Vec<D> ri = outer_position_[i];
    const double reach_i = bodies.radius(i) + range_ + outer_skin_;
    const std::array<int, D> at = grid.columns(ri);
    for (std::uint8_t around = 0; around < kImages<D>; ++around) {
      const ImageShift<D> step = image_shift<D>(around);
      std::array<int, D> column;
      ImageShift<D> shift;
      for (std::size_t a = 0; a < D; ++a) {
        const lists::Wrapped w = lists::wrap_index(at[a] + step[a], grid.count(static_cast<int>(a)));
        column[a] = w.cell, shift[a] = w.shift;
      }
      if (!outer_cell_ && shift != ImageShift<D>{}) continue;
      const Vec<D> offset = outer_cell_ ? outer_cell_->offset(shift) : Vec<D>{};
      const std::size_t c = grid.index(column);
      for (auto m = static_cast<std::size_t>(members.begin[c]); m < static_cast<std::size_t>(members.begin[c + 1]);
           ++m) {
        const auto j = static_cast<std::size_t>(members.member[m]);
        if (j <= i) continue;
        const Vec<D> d = outer_position_[j] + offset - ri;
        const double reach = reach_i + bodies.radius(j);
        if (dot(d, d) > reach * reach) continue;
        if constexpr (requires { bodies.inert(i, j); })
          if (bodies.inert(i, j)) continue;
        outer_i_.push_back(static_cast<std::int32_t>(i));
        outer_j_.push_back(static_cast<std::int32_t>(j));
        outer_shift_.push_back(image_code(shift));
      }
    }
  }
}

template <class Columns>
std::size_t NeighbourLists<Columns>::segment_of(std::int32_t i, std::int32_t j, std::uint8_t shift) const {
  const std::size_t images = shift == kNoImage<D> ? 0 : 1;
  if (chunks_ == 1) return images;
  const int ci = chunk_of(i), cj = chunk_of(j);
  const int group = ci == cj                   ? ci
                    : cj == (ci + 1) % chunks_ ? chunks_ + ci
                    : ci == (cj + 1) % chunks_ ? chunks_ + cj
                                               : 2 * chunks_;
  return 2 * static_cast<std::size_t>(group) + images;
}

template <class Columns>
void NeighbourLists<Columns>::filter_inner(const Bodies& bodies, const std::vector<Pair>& kept) {
  ++inner_rebuilds_;
  inner_travel_ = 0;
  inner_position_.resize(bodies_);
  for (std::size_t k = 0; k < bodies_; ++k) inner_position_[k] = bodies.position(k);

  // Which outer pairs are near, counted by segment.
  const std::size_t segments = chunks_ == 1 ? 2 : 2 * (2 * static_cast<std::size_t>(chunks_) + 1);
  std::vector<std::size_t> count(segments, 0);
  std::vector<std::uint32_t> near;
  std::vector<std::uint16_t> segment;
  near.resize(outer_i_.size()), segment.reserve(2 * bodies_);
  std::array<Vec<D>, kImages<D>> offsets{};
  for (std::uint8_t c = 0; c < kImages<D> && inner_cell_; ++c) offsets[c] = inner_cell_->offset(image_shift<D>(c));
  const double reach_beyond = range_ + inner_skin_;
  std::size_t found = 0;
  for (std::size_t k = 0; k < outer_i_.size(); ++k) {
    const auto i = static_cast<std::size_t>(outer_i_[k]), j = static_cast<std::size_t>(outer_j_[k]);
    const Vec<D> d = inner_position_[j] + offsets[outer_shift_[k]] - inner_position_[i];
    const double reach = bodies.radius(i) + bodies.radius(j) + reach_beyond;
    near[found] = static_cast<std::uint32_t>(k);  // counts if it is
    found += !(dot(d, d) > reach * reach);
  }
  near.resize(found);
  for (const std::uint32_t k : near) {
    segment.push_back(static_cast<std::uint16_t>(segment_of(outer_i_[k], outer_j_[k], outer_shift_[k])));
    ++count[segment.back()];
  }

  std::vector<std::size_t> begin(segments + 1, 0);
  for (std::size_t s = 0; s < segments; ++s)
    begin[s + 1] = begin[s] + (count[s] + kPairBatch - 1) / kPairBatch * kPairBatch;
  i_.resize(begin.back()), j_.resize(begin.back()), shift_.assign(begin.back(), kNoImage<D>);
  for (std::size_t s = 0; s < segments; ++s) {
    const std::size_t pad = Bodies::pad(bodies_, s / 2 % static_cast<std::size_t>(chunks_));
    std::fill(i_.begin() + static_cast<std::ptrdiff_t>(begin[s]),
              i_.begin() + static_cast<std::ptrdiff_t>(begin[s + 1]), offset_of(pad));
    std::fill(j_.begin() + static_cast<std::ptrdiff_t>(begin[s]),
              j_.begin() + static_cast<std::ptrdiff_t>(begin[s + 1]), offset_of(pad + 1));
  }
  columns_.resize(begin.back());

  // Histories by their body i, to be claimed by the pairs. Those of an image further than the nearest ones (a link of a
  // foreign packing that does not touch) have none to claim them.
  std::vector<std::int32_t> history_begin(bodies_ + 1, 0);
  auto has_code = [](const ImageShift<D>& shift) {
    return std::all_of(shift.begin(), shift.end(), [](int s) { return std::abs(s) <= 1; });
  };
  for (const Pair& h : kept) history_begin[static_cast<std::size_t>(h.i) + 1] += has_code(h.shift);
  std::partial_sum(history_begin.begin(), history_begin.end(), history_begin.begin());
  std::vector<Claimable> history(kept.size());
  {
    std::vector<std::int32_t> fill(history_begin.begin(), history_begin.end() - 1);
    for (const Pair& h : kept)
      if (has_code(h.shift))
        history[static_cast<std::size_t>(fill[static_cast<std::size_t>(h.i)]++)] = {h.j, image_code(h.shift),
                                                                                    h.history};
  }

  const bool deal = bodies_ <= lists::kMostDealt;
  std::vector<std::size_t> fill(begin.begin(), begin.end() - 1);
  for (std::size_t m = 0; m < near.size(); ++m) {
    const std::size_t k = near[m], s = segment[m], place = fill[s]++ - begin[s];
    const std::size_t to = begin[s] + (deal ? lists::dealt(place, (begin[s + 1] - begin[s]) / kPairBatch) : place);
    const auto i = static_cast<std::size_t>(outer_i_[k]), j = static_cast<std::size_t>(outer_j_[k]);
    i_[to] = offset_of(i), j_[to] = offset_of(j), shift_[to] = outer_shift_[k];
    columns_.fill(to, bodies, i, j);
    for (auto h = static_cast<std::size_t>(history_begin[i]); h < static_cast<std::size_t>(history_begin[i + 1]); ++h)
      if (history[h].j == outer_j_[k] && history[h].shift == outer_shift_[k]) columns_.remember(to, history[h].history);
  }

  for (auto& p : phases_) p.clear();
  for (std::size_t s = 0; s < segments; s += 2) {
    if (begin[s] == begin[s + 2]) continue;
    const auto group = static_cast<int>(s / 2);
    const int phase = group < chunks_ ? 0 : group < 2 * chunks_ ? 1 + (group - chunks_) % 2 : 3;
    phases_[phase].push_back({begin[s], begin[s + 1], begin[s + 2]});
  }
}

template <class Columns>
auto NeighbourLists<Columns>::histories() const -> std::vector<Pair> {
  std::vector<Pair> kept;
  for_each([&](std::size_t k, std::int32_t i, std::int32_t j, std::uint8_t shift) {
    const History h = columns_.history(k);
    if (h != History{}) kept.push_back({i, j, image_shift<D>(shift), h});
  });
  return kept;
}

template <class Columns>
void NeighbourLists<Columns>::remember(ListMemory<D>& m, std::vector<Pair>& pairs) const {
  const auto length = [](const Cell& cell) { return cell ? cell->length : Vec<D>{}; };
  pairs = histories();
  m.outer_position = outer_position_, m.inner_position = inner_position_;
  m.outer_length = length(outer_cell_), m.inner_length = length(inner_cell_);
  m.outer_tilt = outer_cell_ ? outer_cell_->tilt : 0, m.inner_tilt = inner_cell_ ? inner_cell_->tilt : 0;
  m.outer_skin = outer_skin_, m.inner_skin = inner_skin_;
  m.outer_travel = outer_travel_, m.inner_travel = inner_travel_;
}

template <class Columns>
void NeighbourLists<Columns>::restore(const Bodies& bodies, const ListMemory<D>& m, const std::vector<Pair>& pairs) {
  measure(bodies);
  if (bodies_ == 0) return;
  Bodies then = bodies;
  for (std::size_t k = 0; k < bodies_; ++k) then.place(k, m.outer_position[k]);
  outer_cell_ = listed_cell(m.outer_length, m.outer_tilt), outer_skin_ = m.outer_skin;
  find_outer(then);
  for (std::size_t k = 0; k < bodies_; ++k) then.place(k, m.inner_position[k]);
  inner_cell_ = listed_cell(m.inner_length, m.inner_tilt), inner_skin_ = m.inner_skin;
  filter_inner(then, pairs);
  outer_travel_ = m.outer_travel, inner_travel_ = m.inner_travel;
}

}  // namespace isostat
