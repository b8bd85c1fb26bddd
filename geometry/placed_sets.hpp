// Union-find on a torus: sets whose members know in which image each lies, and loops that wind around the cell.
#pragma once
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "geometry/base/index.hpp"
#include "geometry/periodic_cell.hpp"

namespace isostat {

template <int D>
class PlacedSets {
 public:
  using Image = ImageShift<D>;
  explicit PlacedSets(std::size_t n) : parent_(n), image_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  static Image sum(Image a, const Image& b) {
    for (std::size_t k = 0; k < D; ++k) a[k] += b[k];
    return a;
  }
  static Image difference(Image a, const Image& b) {
    for (std::size_t k = 0; k < D; ++k) a[k] -= b[k];
    return a;
  }

  struct Place {
    std::int32_t root;
    Image image;  // in which the member lies when the root lies in image 0
  };
  Place find(std::int32_t member) {
    std::int32_t root = member;
    Image total{};
    while (parent_[idx(root)] != root) total = sum(total, image_[idx(root)]), root = parent_[idx(root)];
    const Place place{root, total};
    while (parent_[idx(member)] != member) {  // shorten the way for the next time
      const std::int32_t up = parent_[idx(member)];
      const Image rest = difference(total, image_[idx(member)]);
      parent_[idx(member)] = root, image_[idx(member)] = total;
      member = up, total = rest;
    }
    return place;
  }

  // Root b joins root a, in this image when a lies in image 0.
  void absorb(std::int32_t a, std::int32_t b, const Image& image) { parent_[idx(b)] = a, image_[idx(b)] = image; }

  // Member b lies in image `relative` when member a lies in image 0. Of two sets one is made, whose root is that of a;
  // in one set a loop is closed, and what is given back is how it winds around the cell [cells].
  std::optional<Image> join(std::int32_t a, std::int32_t b, const Image& relative) {
    const Place pa = find(a), pb = find(b);
    const Image image = difference(sum(pa.image, relative), pb.image);  // of root b against root a
    if (pa.root == pb.root) return image;
    absorb(pa.root, pb.root, image);
    return std::nullopt;
  }

 private:
  std::vector<std::int32_t> parent_;
  std::vector<Image> image_;
};

}  // namespace isostat
