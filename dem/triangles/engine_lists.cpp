// Lists of grains and candidates of triangles: made, made anew, and made as they were after a restart.
#include <cmath>

#include "dem/run_error.hpp"
#include "dem/solver/neighbours_impl.hpp"
#include "dem/triangles/engine.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

using Store = GrainStore;

// Springs by grains in storage order; those at smooth walls, which the lists do not know, go by ids.
void TriangleEngine::take_wall_springs(std::vector<PairMemory<GrainHistory>>& springs) {
  wall_springs_.clear();
  std::erase_if(springs, [&](const PairMemory<GrainHistory>& s) {
    if (idx(s.j) < store_.size()) return false;
    wall_springs_.push_back({store_.id[idx(s.i)], store_.id[idx(s.j)], s.history.tangential_force});
    return true;
  });
}

void TriangleEngine::build_lists(const Cell& cell, std::vector<PairMemory<GrainHistory>> springs) {
  take_wall_springs(springs);
  try {
    lists_->build(store_, cell, std::move(springs));
  } catch (const ListFailure& e) {
    throw RunError(-1, -1, e.what(), "use more grains (grains.count) or a larger cell (grains.solid_fraction)");
  }
  cut_chunks();
  mark_built();
  build_candidates(store_, cell);
}

// As they were when the memory was taken: candidates from where the triangles stood then.
void TriangleEngine::restore_lists(const State<TriangleGrains>& state) {
  std::vector<PairMemory<GrainHistory>> springs = state.memory.pairs;
  take_wall_springs(springs);
  lists_->restore(store_, state.memory.lists, springs);
  GrainStore then = store_;
  then[Store::x] = store_[Store::built_x], then[Store::y] = store_[Store::built_y];
  then[Store::angle] = store_[Store::built_angle];
  kernels_.corners(0, then.slots(), then.arrays());
  then.measure_circles();
  build_candidates(then, listed_cell(state.memory.lists.inner_length, state.memory.lists.inner_tilt));
  candidates_.set_offsets(cell_);
}

// Rows are a function of positions and angles alone, whatever wrapping did to them: a restart has no others.
void TriangleEngine::mark_built() {
  kernels_.corners(0, store_.slots(), store_.arrays());
  store_[Store::built_x] = store_[Store::x], store_[Store::built_y] = store_[Store::y];
  store_[Store::built_angle] = store_[Store::angle];
}

void TriangleEngine::build_candidates(const GrainStore& store, const Cell& cell) {
  candidates_.build(store, *lists_, cell, law_, kernels_.separation, lists_->inner_skin(), wall_springs_);
}

void TriangleEngine::update_lists(const Cell& cell, double displacement) {
  if (!lists_->outgrown(displacement)) {
    lists_->update(store_, cell, displacement);
    return;
  }
  candidates_.store_springs(*lists_);
  wall_springs_ = candidates_.wall_springs(store_);
  store_.measure_circles();
  if (store_.grow_circles()) {
    lists_->update(store_, cell, displacement);
    if (!std::isfinite(displacement)) throw ListFailure("a velocity is not a number");
    cut_chunks();
    mark_built();
    build_candidates(store_, cell);
  } else {  // A circle has grown: everything anew.
    const std::vector<PairMemory<GrainHistory>> kept = candidates_.springs();
    lists_.emplace(store_.size(), 0.0, GrainPairs{});
    build_lists(cell, kept);
  }
}

}  // namespace isostat
