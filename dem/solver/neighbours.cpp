#include "dem/solver/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace isostat {
namespace {

// Tuning, in the regime of METHODS.md "The disk engine"; none of these enters a result.
constexpr double kOuterSkin = 0.35;          // [mean diameter]
constexpr double kInnerSteps = 100;          // steps that the inner skin should last
constexpr double kSmallestInnerSkin = 5e-4;  // [smallest diameter]
constexpr double kLargestInnerSkin = 0.3;    // [outer skin]
constexpr std::size_t kBodiesPerChunk = 4096;
constexpr int kMostChunks = BodiesStore::kPads;

struct Grid {
  int n[2];
  double inverse[2];
  Grid(const PeriodicCell<2>& cell, double cutoff) {
    for (int k = 0; k < 2; ++k) {
      if (!(cell.length[k] >= cutoff))
        throw std::runtime_error("the cell, L" + std::to_string(k + 1) + " = " + std::to_string(cell.length[k]) +
                                 " a, is smaller than the largest interaction distance " + std::to_string(cutoff) +
                                 " a: a grain would touch itself");
      n[k] = static_cast<int>(std::min(cell.length[k] / cutoff, 30000.0));
      inverse[k] = n[k] / cell.length[k];
    }
  }
  int column(double x, int k) const { return std::clamp(static_cast<int>(x * inverse[k]), 0, n[k] - 1); }
  int index(const Vec2& r) const { return column(r[1], 1) * n[0] + column(r[0], 0); }
  std::size_t size() const { return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]); }
};

struct Wrapped {
  int cell, shift;
};
Wrapped wrap_index(int c, int n) { return c < 0 ? Wrapped{c + n, -1} : c >= n ? Wrapped{c - n, 1} : Wrapped{c, 0}; }

// Place of the n-th pair in a segment of so many batches. Pairs come sorted by body i. Dealt out like cards, one to
// each lane of kDeck batches before the next, those of one body come to stand batches apart; side by side, each would
// wait for the load of that body to come back from the store before it (5 to 20 % of the step,
// docs/measured/benchmarks.md). In samples beyond the caches the prefetcher wants the sorted order instead.
constexpr std::size_t kDeck = 16;          // batches
constexpr std::size_t kMostDealt = 32768;  // bodies: 3 MB of rows and loads
std::size_t dealt(std::size_t n, std::size_t batches) {
  const std::size_t first = n / (kDeck * kPairBatch) * kDeck, rows = std::min(kDeck, batches - first);
  const std::size_t card = n - first * kPairBatch;
  return (first + card % rows) * kPairBatch + card / rows;
}

}  // namespace

int NeighbourLists::chunk_count(std::size_t bodies) {
  const int chunks = static_cast<int>(std::min<std::size_t>(bodies / kBodiesPerChunk, kMostChunks));
  return chunks < 2 ? 1 : chunks - chunks % 2;  // even: segments between chunks alternate between two phases
}

NeighbourLists::NeighbourLists(std::size_t bodies, double range, double damping, double stiffness)
    : bodies_(bodies), chunks_(chunk_count(bodies)), range_(range), damping_(damping), stiffness_(stiffness) {}

std::size_t NeighbourLists::chunk_begin(int chunk) const {
  return bodies_ * static_cast<std::size_t>(chunk) / static_cast<std::size_t>(chunks_);
}

int NeighbourLists::chunk_of(std::int32_t body) const {
  if (chunks_ == 1) return 0;
  int c = static_cast<int>(static_cast<std::size_t>(body) * static_cast<std::size_t>(chunks_) / bodies_);
  while (static_cast<std::size_t>(body) < chunk_begin(c)) --c;
  while (static_cast<std::size_t>(body) >= chunk_begin(c + 1)) ++c;
  return c;
}

// No pair may be listed through its second image: in a tiny cell the skin is what the cell leaves.
double NeighbourLists::outer_skin_for(const PeriodicCell<2>& cell) const {
  return std::min(kOuterSkin * mean_diameter_, std::min(cell.length[0], cell.length[1]) - largest_diameter_ - range_);
}

double NeighbourLists::inner_skin_for(double pair_displacement) const {
  return std::min(std::max(kInnerSteps * pair_displacement, kSmallestInnerSkin * smallest_diameter_),
                  kLargestInnerSkin * outer_skin_);
}

void NeighbourLists::build(BodiesStore& bodies, const PeriodicCell<2>& cell, std::vector<PairMemory> histories) {
  // In the order of size: the storage order, which changes in the run, must not show in the last bit after a restart.
  std::vector<double> radii;
  for (const BodyConstants& c : bodies.constants) radii.push_back(c.radius);
  std::sort(radii.begin(), radii.end());
  smallest_diameter_ = 2 * radii.front(), largest_diameter_ = 2 * radii.back();
  mean_diameter_ = 2 * std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(bodies_);
  sort_bodies(bodies, cell, histories);
  outer_skin_ = outer_skin_for(cell);
  inner_skin_ = inner_skin_for(0);
  find_outer(bodies);
  inner_cell_ = cell;
  filter_inner(bodies, histories);
}

void NeighbourLists::rebuild(BodiesStore& bodies, const PeriodicCell<2>& cell, double pair_displacement) {
  if (!std::isfinite(inner_travel_)) throw std::runtime_error("a velocity is not a number");
  std::vector<PairMemory> kept = histories();
  inner_skin_ = inner_skin_for(pair_displacement);
  // A pair now within the inner range had, when the outer list was made, at most this gap plus what it has moved.
  if (outer_travel_ + inner_skin_ > outer_skin_) {
    sort_bodies(bodies, cell, kept);
    outer_skin_ = outer_skin_for(cell);
    inner_skin_ = inner_skin_for(pair_displacement);
    find_outer(bodies);
  }
  inner_cell_ = cell;
  filter_inner(bodies, kept);
}

// Counting sort by grid cell, row by row, stable: the order is a function of the positions and the order before.
void NeighbourLists::sort_bodies(BodiesStore& bodies, const PeriodicCell<2>& cell, std::vector<PairMemory>& histories) {
  outer_cell_ = cell;
  std::vector<ImageShift<2>> wraps(bodies_);
  for (std::size_t k = 0; k < bodies_; ++k) {
    double* row = bodies.row(k);
    for (int a = 0; a < 2; ++a) {
      const double cells = std::floor(row[a] / cell.length[a]);
      if (!(std::abs(cells) < 1e6))
        throw std::runtime_error("grain " + std::to_string(bodies.id[k]) + " has left the cell");
      row[a] -= cells * cell.length[a];
      wraps[k][static_cast<std::size_t>(a)] = static_cast<int>(cells);
    }
  }
  const Grid grid(cell, largest_diameter_ + range_);
  std::vector<std::int32_t> count(grid.size() + 1, 0), to(bodies_);
  for (std::size_t k = 0; k < bodies_; ++k) ++count[static_cast<std::size_t>(grid.index(bodies.position(k))) + 1];
  std::partial_sum(count.begin(), count.end(), count.begin());
  for (std::size_t k = 0; k < bodies_; ++k) to[k] = count[static_cast<std::size_t>(grid.index(bodies.position(k)))]++;

  BodiesStore sorted;
  sorted.resize(bodies_);
  for (std::size_t k = 0; k < bodies_; ++k) {
    const auto t = static_cast<std::size_t>(to[k]);
    sorted.id[t] = bodies.id[k];
    sorted.constants[t] = bodies.constants[k];
    sorted.inertia[t] = bodies.inertia[k];
    std::copy_n(bodies.row(k), kernel::kRowWidth, sorted.row(t));
    std::copy_n(bodies.load(k), kernel::kLoadWidth, sorted.load(t));
  }
  bodies = std::move(sorted);

  // r_j + s L - r_i is unchanged when j is wrapped by w_j cells and i by w_i: s becomes s + w_j - w_i.
  for (PairMemory& h : histories) {
    for (std::size_t a = 0; a < 2; ++a)
      h.shift[a] += wraps[static_cast<std::size_t>(h.j)][a] - wraps[static_cast<std::size_t>(h.i)][a];
    h.i = to[static_cast<std::size_t>(h.i)];
    h.j = to[static_cast<std::size_t>(h.j)];
    if (h.i > h.j) {  // T is the same seen from either body, M changes sign
      std::swap(h.i, h.j);
      h.shift = {-h.shift[0], -h.shift[1]};
      h.moment = -h.moment;
    }
  }
  ++outer_rebuilds_;
}

void NeighbourLists::find_outer(const BodiesStore& bodies) {
  outer_travel_ = 0;
  outer_position_.resize(bodies_);
  for (std::size_t k = 0; k < bodies_; ++k) outer_position_[k] = bodies.position(k);
  outer_i_.clear(), outer_j_.clear(), outer_shift_.clear();

  const Grid grid(outer_cell_, largest_diameter_ + range_ + outer_skin_);
  std::vector<std::int32_t> begin(grid.size() + 1, 0), member(bodies_);
  for (const Vec2& r : outer_position_) ++begin[static_cast<std::size_t>(grid.index(r)) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::int32_t> fill(begin.begin(), begin.end() - 1);
  for (std::size_t k = 0; k < bodies_; ++k)
    member[static_cast<std::size_t>(fill[static_cast<std::size_t>(grid.index(outer_position_[k]))]++)] =
        static_cast<std::int32_t>(k);

  for (std::size_t i = 0; i < bodies_; ++i) {
    const Vec2 ri = outer_position_[i];
    const double reach_i = bodies.constants[i].radius + range_ + outer_skin_;
    const int cx = grid.column(ri[0], 0), cy = grid.column(ri[1], 1);
    for (int oy = -1; oy <= 1; ++oy) {
      const Wrapped wy = wrap_index(cy + oy, grid.n[1]);
      for (int ox = -1; ox <= 1; ++ox) {
        const Wrapped wx = wrap_index(cx + ox, grid.n[0]);
        const ImageShift<2> shift{wx.shift, wy.shift};
        const Vec2 offset = outer_cell_.offset(shift);
        const int c = wy.cell * grid.n[0] + wx.cell;
        for (auto m = static_cast<std::size_t>(begin[c]); m < static_cast<std::size_t>(begin[c + 1]); ++m) {
          const auto j = static_cast<std::size_t>(member[m]);
          if (j <= i) continue;
          const double dx = outer_position_[j][0] + offset[0] - ri[0], dy = outer_position_[j][1] + offset[1] - ri[1];
          const double reach = reach_i + bodies.constants[j].radius;
          if (dx * dx + dy * dy > reach * reach) continue;
          outer_i_.push_back(static_cast<std::int32_t>(i));
          outer_j_.push_back(static_cast<std::int32_t>(j));
          outer_shift_.push_back(image_code(shift));
        }
      }
    }
  }
}

std::size_t NeighbourLists::segment_of(std::int32_t i, std::int32_t j, std::uint8_t shift) const {
  const std::size_t images = shift == kNoImage ? 0 : 1;
  if (chunks_ == 1) return images;
  const int ci = chunk_of(i), cj = chunk_of(j);
  const int group = ci == cj                   ? ci
                    : cj == (ci + 1) % chunks_ ? chunks_ + ci
                    : ci == (cj + 1) % chunks_ ? chunks_ + cj
                                               : 2 * chunks_;
  return 2 * static_cast<std::size_t>(group) + images;
}

void NeighbourLists::filter_inner(const BodiesStore& bodies, const std::vector<PairMemory>& kept) {
  ++inner_rebuilds_;
  inner_travel_ = 0;
  inner_position_.resize(bodies_);
  for (std::size_t k = 0; k < bodies_; ++k) inner_position_[k] = bodies.position(k);

  // Which outer pairs are near, counted by segment.
  const std::size_t segments = chunks_ == 1 ? 2 : 2 * (2 * static_cast<std::size_t>(chunks_) + 1);
  std::vector<std::size_t> count(segments, 0);
  std::vector<std::uint32_t> near;
  std::vector<std::uint16_t> segment;
  near.reserve(2 * bodies_), segment.reserve(2 * bodies_);
  double offsets[9][2];
  for (std::uint8_t c = 0; c < 9; ++c) {
    const Vec2 o = inner_cell_.offset(image_shift(c));
    offsets[c][0] = o[0], offsets[c][1] = o[1];
  }
  const double reach_beyond = range_ + inner_skin_;
  for (std::size_t k = 0; k < outer_i_.size(); ++k) {
    const auto i = static_cast<std::size_t>(outer_i_[k]), j = static_cast<std::size_t>(outer_j_[k]);
    const double* o = offsets[outer_shift_[k]];
    const double dx = inner_position_[j][0] + o[0] - inner_position_[i][0];
    const double dy = inner_position_[j][1] + o[1] - inner_position_[i][1];
    const double reach = bodies.constants[i].radius + bodies.constants[j].radius + reach_beyond;
    if (dx * dx + dy * dy > reach * reach) continue;
    near.push_back(static_cast<std::uint32_t>(k));
    segment.push_back(static_cast<std::uint16_t>(segment_of(outer_i_[k], outer_j_[k], outer_shift_[k])));
    ++count[segment.back()];
  }

  std::vector<std::size_t> begin(segments + 1, 0);
  for (std::size_t s = 0; s < segments; ++s)
    begin[s + 1] = begin[s] + (count[s] + kPairBatch - 1) / kPairBatch * kPairBatch;
  i_.resize(begin.back()), j_.resize(begin.back()), shift_.assign(begin.back(), kNoImage);
  for (std::size_t s = 0; s < segments; ++s) {
    const std::size_t pad = BodiesStore::pad(bodies_, s / 2 % static_cast<std::size_t>(chunks_));
    std::fill(i_.begin() + static_cast<std::ptrdiff_t>(begin[s]),
              i_.begin() + static_cast<std::ptrdiff_t>(begin[s + 1]), row_offset(pad));
    std::fill(j_.begin() + static_cast<std::ptrdiff_t>(begin[s]),
              j_.begin() + static_cast<std::ptrdiff_t>(begin[s + 1]), row_offset(pad + 1));
  }
  damping_coefficient_.assign(begin.back(), 0.0), radius_sum_.assign(begin.back(), 1.0);
  tangential_.assign(begin.back(), 0.0), moment_.assign(begin.back(), 0.0);

  // Histories by their body i, to be claimed by the pairs. Those of an image further than the nearest ones (a link of a
  // foreign packing that does not touch) have none to claim them.
  std::vector<std::int32_t> history_begin(bodies_ + 1, 0);
  auto has_code = [](const ImageShift<2>& s) { return std::abs(s[0]) <= 1 && std::abs(s[1]) <= 1; };
  for (const PairMemory& h : kept) history_begin[static_cast<std::size_t>(h.i) + 1] += has_code(h.shift);
  std::partial_sum(history_begin.begin(), history_begin.end(), history_begin.begin());
  std::vector<History> history(kept.size());
  {
    std::vector<std::int32_t> fill(history_begin.begin(), history_begin.end() - 1);
    for (const PairMemory& h : kept)
      if (has_code(h.shift))
        history[static_cast<std::size_t>(fill[static_cast<std::size_t>(h.i)]++)] = {h.j, image_code(h.shift),
                                                                                    h.tangential_force, h.moment};
  }

  const bool deal = bodies_ <= kMostDealt;
  std::vector<std::size_t> fill(begin.begin(), begin.end() - 1);
  for (std::size_t m = 0; m < near.size(); ++m) {
    const std::size_t k = near[m], s = segment[m], place = fill[s]++ - begin[s];
    const std::size_t to = begin[s] + (deal ? dealt(place, (begin[s + 1] - begin[s]) / kPairBatch) : place);
    const auto i = static_cast<std::size_t>(outer_i_[k]), j = static_cast<std::size_t>(outer_j_[k]);
    const BodyConstants &a = bodies.constants[i], &b = bodies.constants[j];
    i_[to] = row_offset(i), j_[to] = row_offset(j), shift_[to] = outer_shift_[k];
    radius_sum_[to] = a.radius + b.radius;
    damping_coefficient_[to] = damping_of(a, b);
    for (auto h = static_cast<std::size_t>(history_begin[i]); h < static_cast<std::size_t>(history_begin[i + 1]); ++h)
      if (history[h].j == outer_j_[k] && history[h].shift == outer_shift_[k])
        tangential_[to] = history[h].tangential, moment_[to] = history[h].moment;
  }

  for (auto& p : phases_) p.clear();
  for (std::size_t s = 0; s < segments; s += 2) {
    if (begin[s] == begin[s + 2]) continue;
    const auto group = static_cast<int>(s / 2);
    const int phase = group < chunks_ ? 0 : group < 2 * chunks_ ? 1 + (group - chunks_) % 2 : 3;
    phases_[phase].push_back({begin[s], begin[s + 1], begin[s + 2]});
  }
}

// zeta times the critical damping of the pair (Gilabert 2007, Eq. 6)
double NeighbourLists::damping_of(const BodyConstants& a, const BodyConstants& b) const {
  return damping_ * std::sqrt(4 * stiffness_ / (a.inverse_mass + b.inverse_mass));
}

void NeighbourLists::set_stiffness(double stiffness, const BodiesStore& bodies) {
  stiffness_ = stiffness;
  for (std::size_t k = 0; k < i_.size(); ++k) {
    const auto i = static_cast<std::size_t>(body_at(i_[k])), j = static_cast<std::size_t>(body_at(j_[k]));
    if (i < bodies_) damping_coefficient_[k] = damping_of(bodies.constants[i], bodies.constants[j]);
  }
}

void NeighbourLists::scale_springs(double tangential, double moment) {
  for (double& t : tangential_) t *= tangential;
  for (double& m : moment_) m *= moment;
}

PairArrays NeighbourLists::arrays() {
  return {i_.data(),          j_.data(),          shift_.data(), damping_coefficient_.data(),
          radius_sum_.data(), tangential_.data(), moment_.data()};
}

std::vector<PairMemory> NeighbourLists::histories() const {
  std::vector<PairMemory> kept;
  for_each([&](std::int32_t i, std::int32_t j, std::uint8_t shift, double tangential, double moment) {
    if (tangential != 0 || moment != 0) kept.push_back({i, j, image_shift(shift), tangential, moment});
  });
  return kept;
}

void NeighbourLists::remember(SolverMemory& m) const {
  m.pairs = histories();
  m.outer_position = outer_position_, m.inner_position = inner_position_;
  m.outer_length = outer_cell_.length, m.inner_length = inner_cell_.length;
  m.outer_skin = outer_skin_, m.inner_skin = inner_skin_;
  m.outer_travel = outer_travel_, m.inner_travel = inner_travel_;
}

void NeighbourLists::restore(const BodiesStore& bodies, const SolverMemory& m) {
  BodiesStore then = bodies;
  build(then, PeriodicCell<2>{m.outer_length}, {});  // diameters; the rest is overwritten
  for (std::size_t k = 0; k < bodies_; ++k) {
    then.id[k] = bodies.id[k];
    then.constants[k] = bodies.constants[k];
    std::copy_n(m.outer_position[k].c.data(), 2, then.row(k));
  }
  outer_cell_.length = m.outer_length, outer_skin_ = m.outer_skin;
  find_outer(then);
  for (std::size_t k = 0; k < bodies_; ++k) std::copy_n(m.inner_position[k].c.data(), 2, then.row(k));
  inner_cell_.length = m.inner_length, inner_skin_ = m.inner_skin;
  filter_inner(then, m.pairs);
  outer_travel_ = m.outer_travel, inner_travel_ = m.inner_travel;
}

}  // namespace isostat
