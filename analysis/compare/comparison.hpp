// What changed between two states of the same grains: strain of the cell, contacts, displacements beyond the affine
// ones, regions that moved rigidly.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "analysis/compare/link_changes.hpp"
#include "analysis/compare/matching.hpp"
#include "analysis/compare/rigid_regions.hpp"

namespace isostat {

template <int D>
struct Comparison {
  Matching grains;
  LinkChanges contacts, distant;
  std::vector<Vec<D>> displacement;  // non-affine, one a matched grain [a]
  RigidRegions regions;
};

template <int D>
Comparison<D> compare(const Packing<D>& before, const Packing<D>& after, double tolerance);

// The keys are in docs/report.md, "isostat compare".
template <int D>
nlohmann::ordered_json comparison_json(const Packing<D>& before, const Packing<D>& after, const Comparison<D>& found,
                                       double tolerance);

// CSV: one line a matched grain; one a link that was lost, gained or kept.
template <int D>
std::string displacements_csv(const Packing<D>& after, const Comparison<D>& found);
template <int D>
std::string link_changes_csv(const Packing<D>& before, const Packing<D>& after, const Comparison<D>& found);

}  // namespace isostat
