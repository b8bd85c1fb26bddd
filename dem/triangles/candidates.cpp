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

constexpr std::size_t kWindow =
    128;  // pairs of grains sorted by their number of rows together: full packs, local memory

}  // namespace

// The pairs of triangles whose circles are within the skin.
void Candidates::look(const GrainStore& store, const Near& near, const Vec2& offset, double skin) {
  const auto &x = store[GrainStore::x], &y = store[GrainStore::y], &reach = store[GrainStore::reach];
  const Vec2 apart = store.position(near.j) + offset - store.position(near.i);
  const double hold = store.tight(near.i) + store.tight(near.j) + skin;
  if (near.place != kNowhere && dot(apart, apart) > hold * hold) return;
  Near found = near;
  found.begin = static_cast<std::uint32_t>(maybe_a_.size());
  // Only triangles that reach the circle of the other grain.
  const auto facing = [&](std::size_t g, const Vec2& centre, double radius, std::vector<std::uint32_t>& slots) {
    slots.clear();
    for (std::size_t t = 0; t < store.triangles(g); ++t) {
      const std::size_t k = store.slot(g, t);
      const double dx = x[k] - centre[0], dy = y[k] - centre[1], most = reach[k] + radius + skin;
      if (dx * dx + dy * dy <= most * most) slots.push_back(static_cast<std::uint32_t>(k));
    }
  };
  const bool wall = near.place == kNowhere;
  facing(near.i, store.position(near.j) + offset, wall ? 1e100 : store.tight(near.j), facing_i_);
  facing(near.j, store.position(near.i) - offset, store.tight(near.i), facing_j_);
  for (const std::uint32_t a : facing_i_)
    for (const std::uint32_t b : facing_j_) {
      const double dx = x[b] + offset[0] - x[a], dy = y[b] + offset[1] - y[a], most = reach[a] + reach[b] + skin;
      if (dx * dx + dy * dy > most * most) continue;
      maybe_a_.push_back(a), maybe_b_.push_back(b);
      maybe_x_.push_back(offset[0]), maybe_y_.push_back(offset[1]);
    }
  found.count = static_cast<std::uint32_t>(maybe_a_.size()) - found.begin;
  if (found.count > 0) near_.push_back(found);
}

void Candidates::pack(const GrainStore& store, SeparationKernel separation, double skin, std::size_t group) {
  const std::uint32_t pad = store.pad_slot(group);
  while (maybe_a_.size() % kernel::kLanes != 0)
    maybe_a_.push_back(pad), maybe_b_.push_back(pad + 1), maybe_x_.push_back(0), maybe_y_.push_back(0);
  flag_.resize(maybe_a_.size());
  separation({maybe_a_.size(), maybe_a_.data(), maybe_b_.data(), maybe_x_.data(), maybe_y_.data(), store.rows.data(),
              skin, flag_.data()});
  std::vector<std::uint32_t> rows(near_.size());
  std::vector<std::size_t> order;
  for (std::size_t n = 0; n < near_.size(); ++n) {
    for (std::size_t k = near_[n].begin; k < near_[n].begin + near_[n].count; ++k) rows[n] += flag_[k];
    if (rows[n] > 0) order.push_back(n);
    pairs_ += rows[n];
  }
  for (std::size_t begin = 0; begin < order.size(); begin += kWindow)
    std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(begin),
                     order.begin() + static_cast<std::ptrdiff_t>(std::min(begin + kWindow, order.size())),
                     [&](std::size_t m, std::size_t n) { return rows[m] > rows[n]; });
  for (std::size_t first = 0; first < order.size(); first += kernel::kLanes) {
    OverlapPack pack;
    pack.first = static_cast<std::uint32_t>(a_.size());
    for (std::size_t l = 0; l < kernel::kLanes && first + l < order.size(); ++l)
      pack.rows = std::max(pack.rows, rows[order[first + l]]);
    a_.resize(a_.size() + kernel::kLanes * pack.rows, pad), b_.resize(a_.size(), pad + 1);
    for (std::size_t l = 0; l < kernel::kLanes; ++l) {
      if (first + l >= order.size()) {
        of_lane_.push_back({0, 0, kNoImage<2>, kNowhere, 0, 0});
        stiffness_.push_back(0), offset_x_.push_back(0), offset_y_.push_back(0), spring_.push_back(0);
        continue;
      }
      const std::size_t n = order[first + l];
      const Near& near = near_[n];
      std::size_t at = pack.first + l;
      for (std::size_t k = near.begin; k < near.begin + near.count; ++k)
        if (flag_[k]) a_[at] = maybe_a_[k], b_[at] = maybe_b_[k], at += kernel::kLanes;
      of_lane_.push_back(near);
      stiffness_.push_back(stiffness_of_[n]), spring_.push_back(spring_of_[n]);
      offset_x_.push_back(maybe_x_[near.begin]), offset_y_.push_back(maybe_y_[near.begin]);
    }
    packs_.push_back(pack);
    most_rows_ = std::max<std::size_t>(most_rows_, pack.rows);
  }
  near_.clear(), maybe_a_.clear(), maybe_b_.clear(), maybe_x_.clear(), maybe_y_.clear();
  stiffness_of_.clear(), spring_of_.clear();
}

void Candidates::build(const GrainStore& store, const Lists& lists, const Cell& cell, const TriangleLaw& law,
                       SeparationKernel separation, double skin, const std::vector<WallSpring>& walls) {
  packs_.clear(), a_.clear(), b_.clear(), of_lane_.clear();
  stiffness_.clear(), offset_x_.clear(), offset_y_.clear(), spring_.clear();
  most_rows_ = pairs_ = 0, slots_ = store.slots();
  const auto add = [&](const Near& near, const Vec2& offset, double spring) {
    const std::size_t before = near_.size();
    look(store, near, offset, skin);
    if (near_.size() == before) return;
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
}

void Candidates::show(OverlapInput& in) {
  in.packs = packs_.data(), in.a = a_.data(), in.b = b_.data();
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
