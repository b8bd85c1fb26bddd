// Connected clusters of a periodic network, and whether they wrap around the cell: union-find whose links to the parent
// carry image shifts.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/periodic_cell.hpp"

namespace isostat {

template <int D>
class WindingClusters {
 public:
  explicit WindingClusters(std::size_t bodies);

  // Joins i with the image of j displaced by shift. Returns the winding vector of the loop that the link closes in
  // cells: zero for a link that joins two clusters or closes a loop that does not wrap.
  ImageShift<D> join(std::int32_t i, std::int32_t j, const ImageShift<D>& shift);

  std::int32_t root(std::int32_t body);
  std::int32_t size(std::int32_t body) { return size_[static_cast<std::size_t>(root(body))]; }

 private:
  // Representative and the shift of the cluster's copy in which `body` lies, relative to the representative.
  std::int32_t find(std::int32_t body, ImageShift<D>& shift);
  std::vector<std::int32_t> parent_, size_;
  std::vector<ImageShift<D>> offset_;  // from the parent to this body
  std::vector<std::int32_t> path_;
};

}  // namespace isostat
