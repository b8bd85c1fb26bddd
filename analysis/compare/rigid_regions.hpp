// Regions that moved as rigid bodies between two states (Gilabert, Roux and Castellanos 2008: plastic events move dense
// regions rigidly).
#pragma once
#include <cstdint>
#include <vector>

#include "analysis/compare/link_changes.hpp"

namespace isostat {

inline constexpr double kRigidTolerance = 0.01;  // [rad], and of lengths

// Contacts that were kept, with their length to the tolerance, are joined where two of them share a grain and enclose
// the same angle as before to the tolerance; a region is a connected set of three grains at least. A grain at which two
// regions turned against each other (a hinge) is in both, and is counted for the larger. In space the angle says
// nothing of the twist about a chain, so regions there are upper bounds.
struct RigidRegion {
  std::vector<std::int32_t> grains;  // matched ones, ascending
  double misfit = 0;  // [a] root mean square distance from the best rigid motion: what the tolerance let add up
};
struct RigidRegions {
  std::vector<RigidRegion> regions;        // the largest first
  std::vector<std::int32_t> of_grain;      // region of each matched grain, or -1
  std::vector<std::int32_t> of_kept_link;  // region of each kept contact, or -1
  std::size_t grains_in_regions() const;
  double mean_size_weighted() const;  // of the region of a grain that is in one
};

template <int D>
RigidRegions rigid_regions(const Packing<D>& before, const Packing<D>& after, const Matching& grains,
                           const LinkChanges& contacts, double tolerance);

}  // namespace isostat
