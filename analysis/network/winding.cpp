#include "analysis/network/winding.hpp"

#include <numeric>
#include <utility>

#include "geometry/base/index.hpp"

namespace isostat {
namespace {

template <int D>
ImageShift<D> sum(const ImageShift<D>& a, const ImageShift<D>& b, int sign = 1) {
  ImageShift<D> s{};
  for (std::size_t k = 0; k < D; ++k) s[k] = a[k] + sign * b[k];
  return s;
}
}  // namespace

template <int D>
WindingClusters<D>::WindingClusters(std::size_t bodies) : parent_(bodies), size_(bodies, 1), offset_(bodies) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

template <int D>
std::int32_t WindingClusters<D>::find(std::int32_t body, ImageShift<D>& shift) {
  path_.clear();
  std::int32_t top = body;
  while (parent_[idx(top)] != top) path_.push_back(top), top = parent_[idx(top)];
  ImageShift<D> from_top{};
  for (auto k = path_.rbegin(); k != path_.rend(); ++k) {
    from_top = sum<D>(from_top, offset_[idx(*k)]);
    offset_[idx(*k)] = from_top;
    parent_[idx(*k)] = top;
  }
  shift = from_top;
  return top;
}

template <int D>
std::int32_t WindingClusters<D>::root(std::int32_t body) {
  ImageShift<D> ignored{};
  return find(body, ignored);
}

template <int D>
ImageShift<D> WindingClusters<D>::join(std::int32_t i, std::int32_t j, const ImageShift<D>& shift) {
  ImageShift<D> of_i{}, of_j{};
  std::int32_t a = find(i, of_i), b = find(j, of_j);
  // In the copies of the link, root a sits at -of_i and root b at shift - of_j.
  ImageShift<D> a_to_b = sum<D>(sum<D>(of_i, shift), of_j, -1);
  if (a == b) return a_to_b;
  if (size_[idx(a)] < size_[idx(b)]) std::swap(a, b), a_to_b = sum<D>(ImageShift<D>{}, a_to_b, -1);
  parent_[idx(b)] = a;
  offset_[idx(b)] = a_to_b;
  size_[idx(a)] += size_[idx(b)];
  return {};
}

template class WindingClusters<2>;
template class WindingClusters<3>;

}  // namespace isostat
