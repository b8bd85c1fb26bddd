// Disks at smooth walls. A disk that is near one makes a pair with a foot, a row of the bodies' store that stands at
// its foot point and moves as the wall does there: the force kernel takes it for one more pair. Each pair carries its
// springs as pairs of disks do.
#pragma once
#include <cstdint>
#include <vector>

#include "dem/disks/kernel/pair_force.hpp"
#include "dem/disks/pairs.hpp"
#include "dem/state/smooth_walls.hpp"

namespace isostat {

// Where a container stands and how it moved into this place: springs are stretched by half-step velocities.
struct ContainerStep {
  ContainerPlacement now, half;
};

class WallContacts {
 public:
  // Springs of a disk, by id, and a wall, by number.
  struct Spring {
    std::int64_t disk = 0;
    std::int32_t wall = 0;
    DiskHistory history;
  };

  WallContacts(std::vector<SmoothWall> built, bool open, const DiskLaw& law);

  bool any() const { return !built_.empty(); }  // walls
  std::size_t size() const { return i_.size(); }

  // The pairs of disks and walls within `reach` beyond contact, sorted by disks and walls, with these springs.
  void list(BodiesStore& bodies, const ContainerStep& container, double reach, std::vector<Spring> springs);
  std::vector<Spring> springs() const;

  // Feet to where the disks stand now, without load.
  void place(BodiesStore& bodies, const ContainerStep& container);
  // Largest speed of a wall's end in this step [a/T0].
  double largest_speed(const ContainerStep& container) const;

  PairArrays arrays();
  DiskPairs& columns() { return columns_; }
  const DiskPairs& columns() const { return columns_; }

  std::int64_t disk(std::size_t k) const { return disk_[k]; }  // its id
  std::int32_t wall(std::size_t k) const { return wall_[k]; }
  GrainPart part(std::size_t k) const { return built_[static_cast<std::size_t>(wall_[k])].part; }
  double turning(std::size_t k) const { return turning_[k]; }
  std::int32_t walls() const { return static_cast<std::int32_t>(built_.size()); }

  template <class Visit>  // visit(place, disk, foot)
  void for_each(Visit&& visit) const {
    for (std::size_t k = 0; k < i_.size(); ++k)
      visit(k, static_cast<std::int32_t>(i_[k] / DiskPairs::kStride),
            static_cast<std::int32_t>(j_[k] / DiskPairs::kStride));
  }

 private:
  bool stands(std::size_t wall) const { return !open_ || built_[wall].part != GrainPart::lid; }

  std::vector<SmoothWall> built_;
  bool open_;
  std::vector<std::uint32_t> i_, j_;  // row offsets, as the kernels want them
  std::vector<std::int32_t> wall_;
  std::vector<std::int64_t> disk_;  // ids
  std::vector<double> turning_;
  DiskPairs columns_;
};

}  // namespace isostat
