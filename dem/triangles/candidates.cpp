#include "dem/triangles/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "dem/solver/neighbours_impl.hpp"
#include "dem/triangles/at_rest.hpp"
#include "dem/triangles/kernel/rows.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

template class NeighbourLists<GrainPairs>;

namespace {

// Pairs of grains sorted by their number of rows together: full packs, local memory.
constexpr std::size_t kWindow = 128;
// Pairs of triangles of two grains that are looked at one and all: loops of one length are cheaper than few checks.
constexpr std::size_t kFew = 24;
constexpr std::size_t kCached = 8192;  // slots that a second-level cache holds: nothing has to be asked for in advance

// Pairs of grains with rows in the order of the list, those of a window by falling number of rows.
std::vector<std::uint32_t> by_rows(const std::vector<std::uint32_t>& rows) {
  std::vector<std::uint32_t> with_rows(rows.size());
  std::size_t count = 0;
  for (std::uint32_t n = 0; n < rows.size(); ++n) with_rows[count] = n, count += rows[n] > 0;
  with_rows.resize(count);
  std::vector<std::uint32_t> order(count), begin;
  for (std::size_t first = 0; first < count; first += kWindow) {
    const std::size_t last = std::min(first + kWindow, count);
    std::uint32_t most = 0;
    for (std::size_t k = first; k < last; ++k) most = std::max(most, rows[with_rows[k]]);
    begin.assign(most + 1, 0);
    for (std::size_t k = first; k < last; ++k) ++begin[rows[with_rows[k]] - 1];
    for (std::size_t r = most; r-- > 0;) begin[r] += begin[r + 1];  // those with more rows
    for (std::size_t k = last; k-- > first;) order[first + --begin[rows[with_rows[k]] - 1]] = with_rows[k];
  }
  return order;
}

}  // namespace

void Candidates::draw_circles(const GrainStore& store) {
  const auto &x = store[GrainStore::x], &y = store[GrainStore::y], &reach = store[GrainStore::reach];
  circles_.clear(), circles_begin_.assign(1, 0);
  std::size_t most = 0;
  for (std::size_t g = 0; g < store.grains(); ++g) {
    for (std::size_t t = 0; t < store.triangles(g); ++t) {
      const std::size_t k = store.slot(g, t);
      circles_.push_back({x[k], y[k], reach[k]});
    }
    circles_begin_.push_back(static_cast<std::uint32_t>(circles_.size()));
    most = std::max(most, store.triangles(g));
  }
  facing_i_.resize(most + 1), facing_j_.resize(most + 1);  // one more: see facing()
  every_.resize(most);
  std::iota(every_.begin(), every_.end(), 0u);
}

// Here and in look() a find is written down before it is known to be one, and counted if it is: whether circles are
// near is a coin toss, which no processor foresees.
std::size_t Candidates::facing(std::size_t g, const Vec2& point, double radius,
                               std::vector<std::uint32_t>& found) const {
  std::size_t count = 0;
  const std::uint32_t begin = circles_begin_[g], triangles = circles_begin_[g + 1] - begin;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const Circle& c = circles_[begin + t];
    const double dx = c.x - point[0], dy = c.y - point[1], most = c.reach + radius;
    found[count] = t;
    count += dx * dx + dy * dy <= most * most;
  }
  return count;
}

// The pairs of triangles whose circles are within the skin. False: there are none.
bool Candidates::look(const GrainStore& store, Near near, const Vec2& offset, double skin) {
  const Vec2 ri = store.position(near.i), rj = store.position(near.j) + offset, apart = rj - ri;
  const double hold = store.tight(near.i) + store.tight(near.j) + skin;
  const bool wall = near.place == kNowhere;
  if (!wall && dot(apart, apart) > hold * hold) return false;
  const std::uint32_t *of_i = every_.data(), *of_j = every_.data();
  std::size_t count_i = store.triangles(near.i), count_j = store.triangles(near.j);
  if (count_i * count_j > kFew) {  // only triangles that reach the circle of the other grain
    count_i = facing(near.i, rj, wall ? 1e100 : store.tight(near.j) + skin, facing_i_), of_i = facing_i_.data();
    count_j = facing(near.j, ri - offset, store.tight(near.i) + skin, facing_j_), of_j = facing_j_.data();
  }
  make_room(count_i * count_j);
  const Circle *circles_i = &circles_[circles_begin_[near.i]], *circles_j = &circles_[circles_begin_[near.j]];
  const auto slot_i = static_cast<std::uint32_t>(store.slot(near.i, 0));
  const auto slot_j = static_cast<std::uint32_t>(store.slot(near.j, 0));
  std::size_t maybes = maybes_;
  for (std::size_t m = 0; m < count_i; ++m) {
    const Circle& a = circles_i[of_i[m]];
    for (std::size_t n = 0; n < count_j; ++n) {
      const Circle& b = circles_j[of_j[n]];
      const double dx = b.x + offset[0] - a.x, dy = b.y + offset[1] - a.y, most = a.reach + b.reach + skin;
      maybe_a_[maybes] = slot_i + GrainStore::kStride * of_i[m];
      maybe_b_[maybes] = slot_j + GrainStore::kStride * of_j[n];
      maybe_x_[maybes] = offset[0], maybe_y_[maybes] = offset[1];
      maybes += dx * dx + dy * dy <= most * most;
    }
  }
  near.begin = static_cast<std::uint32_t>(maybes_), near.count = static_cast<std::uint32_t>(maybes - maybes_);
  maybes_ = maybes;
  if (near.count > 0) near_.push_back(near);
  return near.count > 0;
}

// For so many more, and what rounds them up to lanes.
void Candidates::make_room(std::size_t more) {
  const std::size_t least = maybes_ + more + kernel::kLanes;
  if (maybe_a_.size() >= least) return;
  maybe_a_.resize(2 * least), maybe_b_.resize(2 * least), maybe_x_.resize(2 * least), maybe_y_.resize(2 * least);
}

void Candidates::pack(const GrainStore& store, SeparationKernel separation, double skin, std::size_t group) {
  const std::uint32_t pad = store.pad_slot(group);
  make_room(0);
  std::size_t padded = maybes_;
  for (; padded % kernel::kLanes != 0; ++padded)
    maybe_a_[padded] = pad, maybe_b_[padded] = pad + 1, maybe_x_[padded] = maybe_y_[padded] = 0;
  flag_.resize(padded);
  separation({padded, maybe_a_.data(), maybe_b_.data(), maybe_x_.data(), maybe_y_.data(), store.rows.data(), skin,
              flag_.data()});
  // What is near moves up.
  std::vector<std::uint32_t> rows(near_.size());
  std::size_t kept = 0;
  for (std::size_t n = 0; n < near_.size(); ++n) {
    Near& near = near_[n];
    const std::size_t begin = kept, end = near.begin + near.count;
    for (std::size_t k = near.begin; k < end; ++k) {
      maybe_a_[kept] = maybe_a_[k], maybe_b_[kept] = maybe_b_[k];
      maybe_x_[kept] = maybe_x_[k], maybe_y_[kept] = maybe_y_[k];
      kept += flag_[k];
    }
    near.begin = static_cast<std::uint32_t>(begin);
    near.count = rows[n] = static_cast<std::uint32_t>(kept - begin);
  }
  pairs_ += kept;
  const std::vector<std::uint32_t> order = by_rows(rows);
  ++groups_;
  std::size_t seen = seen_.size();
  const bool far = slots_ > kCached;
  seen_.resize(seen + (far ? 2 * kept : 0));
  const auto see = [&](std::uint32_t slot) {
    seen_[seen] = slot, seen += seen_by_[slot] != groups_, seen_by_[slot] = groups_;
  };
  for (std::size_t first = 0; first < order.size(); first += kernel::kLanes) {
    const OverlapPack pack{static_cast<std::uint32_t>(a_.size()), rows[order[first]], static_cast<std::uint32_t>(seen)};
    a_.resize(a_.size() + kernel::kLanes * pack.rows, pad), b_.resize(a_.size(), pad + 1);
    for (std::size_t l = 0; l < kernel::kLanes; ++l) {
      if (first + l >= order.size()) {
        of_lane_.push_back({0, 0, kNoImage<2>, kNowhere, 0, 0});
        stiffness_.push_back(0), offset_x_.push_back(0), offset_y_.push_back(0), spring_.push_back(0);
        continue;
      }
      const std::size_t n = order[first + l];
      const Near& near = near_[n];
      for (std::size_t r = 0; r < near.count; ++r) {
        const std::size_t at = pack.first + kernel::kLanes * r + l;
        a_[at] = maybe_a_[near.begin + r], b_[at] = maybe_b_[near.begin + r];
        if (far) see(a_[at]), see(b_[at]);
      }
      of_lane_.push_back(near);
      stiffness_.push_back(stiffness_of_[n]), spring_.push_back(spring_of_[n]);
      offset_x_.push_back(maybe_x_[near.begin]), offset_y_.push_back(maybe_y_[near.begin]);
    }
    packs_.push_back(pack);
    most_rows_ = std::max<std::size_t>(most_rows_, pack.rows);
  }
  seen_.resize(seen);
  near_.clear(), stiffness_of_.clear(), spring_of_.clear();
  maybes_ = 0;
}

void Candidates::build(const GrainStore& store, const Lists& lists, const Cell& cell, const TriangleLaw& law,
                       SeparationKernel separation, double skin, const std::vector<WallSpring>& walls) {
  packs_.clear(), a_.clear(), b_.clear(), of_lane_.clear();
  stiffness_.clear(), offset_x_.clear(), offset_y_.clear(), spring_.clear();
  most_rows_ = pairs_ = 0, slots_ = store.slots();
  seen_.clear(), seen_by_.assign(slots_, 0), groups_ = 0;
  draw_circles(store);
  const auto add = [&](const Near& near, const Vec2& offset, double spring) {
    if (!look(store, near, offset, skin)) return;
    stiffness_of_.push_back(overlap_stiffness(law, store.inverse_length(near.i), store.inverse_length(near.j)));
    spring_of_.push_back(spring);
  };
  const auto finish = [&](int phase, std::size_t group) {
    const std::size_t begin = packs_.size();
    pack(store, separation, skin, group);
    if (packs_.size() > begin) phases_[phase].push_back({begin, packs_.size()});
  };
  for (int p = 0; p < Lists::kPhases; ++p) {
    phases_[p].clear();
    std::size_t group = 0;
    for (const PairGroup& g : lists.phase(p)) {
      for (std::size_t k = g.begin; k < g.end; ++k) {
        const std::uint32_t i = lists.i()[k], j = lists.j()[k];
        if (i >= store.size() || (store.driven(i) && store.driven(j))) continue;
        const std::uint8_t shift = lists.shift()[k];
        add({i, j, shift, static_cast<std::uint32_t>(k), 0, 0}, cell ? cell->offset(image_shift<2>(shift)) : Vec2{},
            lists.columns().history(k).tangential_force);
      }
      finish(p, group++);
    }
  }
  phases_[Lists::kPhases].clear();
  std::map<std::pair<std::int64_t, std::int64_t>, double> known;
  for (const WallSpring& w : walls) known[{w.grain, w.wall}] = w.tangential_force;
  for (std::size_t w = store.size(); w < store.grains(); ++w) {
    // Against the box of the wall: its circle would hold everything.
    Vec2 low{{INFINITY, INFINITY}}, high{{-INFINITY, -INFINITY}};
    for (std::size_t t = 0; t < store.triangles(w); ++t)
      for (int c = 0; c < 3; ++c)
        for (int a = 0; a < 2; ++a) {
          const double at = store.rows[store.slot(w, t) * kernel::kCornerRow + static_cast<std::size_t>(2 * c + a)];
          low[a] = std::min(low[a], at), high[a] = std::max(high[a], at);
        }
    for (std::size_t g = 0; g < store.size(); ++g) {
      const Vec2 r = store.position(g);
      const double reach = store.radius(g) + skin;
      if (store.driven(g) || r[0] + reach < low[0] || r[0] - reach > high[0] || r[1] + reach < low[1] ||
          r[1] - reach > high[1])
        continue;
      const auto spring = known.find({store.id[g], store.id[w]});
      add({static_cast<std::uint32_t>(g), static_cast<std::uint32_t>(w), kNoImage<2>, kNowhere, 0, 0}, {},
          spring == known.end() ? 0.0 : spring->second);
    }
  }
  finish(Lists::kPhases, 0);
  packs_.push_back({static_cast<std::uint32_t>(a_.size()), 0, static_cast<std::uint32_t>(seen_.size())});
}

void Candidates::show(OverlapInput& in) {
  in.packs = packs_.data(), in.a = a_.data(), in.b = b_.data(), in.seen = seen_.data();
  in.stiffness = stiffness_.data(), in.offset_x = offset_x_.data(), in.offset_y = offset_y_.data();
  in.spring = spring_.data();
}

void Candidates::set_offsets(const Cell& cell) {
  if (!cell) return;
  for (std::size_t l = 0; l < of_lane_.size(); ++l) {
    const Vec2 offset = cell->offset(image_shift<2>(of_lane_[l].shift));
    offset_x_[l] = offset[0], offset_y_[l] = offset[1];
  }
}

void Candidates::store_springs(Lists& lists) const {
  for (std::size_t l = 0; l < of_lane_.size(); ++l)
    if (of_lane_[l].place != kNowhere) lists.columns().remember(of_lane_[l].place, {spring_[l]});
}

auto Candidates::wall_springs(const GrainStore& store) const -> std::vector<WallSpring> {
  std::vector<WallSpring> springs;
  for (std::size_t l = 0; l < of_lane_.size(); ++l) {
    const Near& n = of_lane_[l];
    if (n.i != n.j && n.place == kNowhere && spring_[l] != 0)
      springs.push_back({store.id[n.i], store.id[n.j], spring_[l]});
  }
  return springs;
}

auto Candidates::springs() const -> std::vector<PairMemory<GrainHistory>> {
  std::vector<PairMemory<GrainHistory>> springs;
  for (std::size_t l = 0; l < of_lane_.size(); ++l) {
    const Near& n = of_lane_[l];
    if (n.i != n.j && spring_[l] != 0)
      springs.push_back(
          {static_cast<std::int32_t>(n.i), static_cast<std::int32_t>(n.j), image_shift<2>(n.shift), {spring_[l]}});
  }
  return springs;
}

}  // namespace isostat
