// Union-find on a torus: sets of faces that know whether they wind around the cell.
#pragma once
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "geometry/base/index.hpp"
#include "geometry/periodic_cell.hpp"

namespace isostat {

inline ImageShift<2> plus(const ImageShift<2>& a, const ImageShift<2>& b) { return {a[0] + b[0], a[1] + b[1]}; }
inline ImageShift<2> minus(const ImageShift<2>& a, const ImageShift<2>& b) { return {a[0] - b[0], a[1] - b[1]}; }

// Union-find of faces that also knows in which image each face lies relative to its root. Joining two faces of one set
// by a way that ends in another image shows that the set winds around the cell.
class WindingSets {
 public:
  explicit WindingSets(std::size_t n) : parent_(n), offset_(n), along_(n) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  struct Place {
    std::int32_t root;
    ImageShift<2> offset;  // image of the face when the root is in image 0
  };
  Place find(std::int32_t f) {
    std::int32_t root = f;
    ImageShift<2> total{};
    while (parent_[idx(root)] != root) total = plus(total, offset_[idx(root)]), root = parent_[idx(root)];
    const Place place{root, total};
    while (parent_[idx(f)] != f) {
      const auto up = parent_[idx(f)];
      const auto rest = minus(total, offset_[idx(f)]);
      parent_[idx(f)] = root, offset_[idx(f)] = total;
      f = up, total = rest;
    }
    return place;
  }
  // Face b is to lie in image `relative` when face a lies in image 0.
  void join(std::int32_t a, std::int32_t b, const ImageShift<2>& relative) {
    const auto pa = find(a), pb = find(b);
    const auto shift = minus(plus(pa.offset, relative), pb.offset);  // of root b against root a
    if (pa.root == pb.root) {
      for (std::size_t k = 0; k < 2; ++k) along_[idx(pa.root)][k] |= shift[k] != 0;
      return;
    }
    parent_[idx(pb.root)] = pa.root, offset_[idx(pb.root)] = shift;
    for (std::size_t k = 0; k < 2; ++k) along_[idx(pa.root)][k] |= along_[idx(pb.root)][k];
  }
  std::array<bool, 2> along(std::int32_t root) const { return along_[idx(root)]; }

 private:
  std::vector<std::int32_t> parent_;
  std::vector<ImageShift<2>> offset_;
  std::vector<std::array<bool, 2>> along_;
};

}  // namespace isostat
