#include "dem/state/touching.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "dem/state/link_ends.hpp"

namespace isostat {
namespace {

// Uniform bins over the cell (or the bounding box); images of a bin are reached by indices outside [0, count).
template <int D>
struct Bins {
  Vec<D> origin{}, size{};
  std::array<int, D> count{}, reach{};  // reach: bins to either side that can hold a neighbour
  std::array<bool, D> periodic{};
  std::vector<int> start, grain;  // grains of bin b: grain[start[b] .. start[b+1])

  std::size_t flat(const std::array<int, D>& b) const {
    std::size_t f = 0;
    for (int k = D - 1; k >= 0; --k) {
      const auto u = static_cast<std::size_t>(k);
      f = f * static_cast<std::size_t>(count[u]) + static_cast<std::size_t>(b[u]);
    }
    return f;
  }
  std::array<int, D> bin_of(const Vec<D>& r) const {
    std::array<int, D> b{};
    for (int k = 0; k < D; ++k) {
      const auto u = static_cast<std::size_t>(k);
      b[u] = std::clamp(static_cast<int>(std::floor((r[k] - origin[k]) / size[k])), 0, count[u] - 1);
    }
    return b;
  }
};

template <int D>
Bins<D> make_bins(const std::vector<Vec<D>>& position, const std::optional<PeriodicCell<D>>& cell, double cutoff) {
  Bins<D> bins;
  const double per_side = std::ceil(std::pow(static_cast<double>(position.size()), 1.0 / D)) + 1;
  for (int k = 0; k < D; ++k) {
    const auto u = static_cast<std::size_t>(k);
    double edge;
    if (cell) {
      edge = cell->length[k];
    } else {
      const auto [low, high] = std::minmax_element(position.begin(), position.end(),
                                                   [k](const Vec<D>& a, const Vec<D>& b) { return a[k] < b[k]; });
      bins.origin[k] = (*low)[k];
      edge = std::max((*high)[k] - (*low)[k], cutoff);
    }
    bins.periodic[u] = cell.has_value();
    bins.count[u] = static_cast<int>(std::clamp(std::floor(edge / cutoff), 1.0, 2 * per_side));
    bins.size[k] = edge / bins.count[u];
    bins.reach[u] = static_cast<int>(std::ceil(cutoff / bins.size[k]));
  }
  std::size_t total = 1;
  for (int c : bins.count) total *= static_cast<std::size_t>(c);
  bins.start.assign(total + 1, 0);
  std::vector<std::size_t> bin(position.size());
  for (std::size_t i = 0; i < position.size(); ++i) ++bins.start[(bin[i] = bins.flat(bins.bin_of(position[i]))) + 1];
  std::partial_sum(bins.start.begin(), bins.start.end(), bins.start.begin());
  bins.grain.resize(position.size());
  std::vector<int> next(bins.start.begin(), bins.start.end() - 1);
  for (std::size_t i = 0; i < position.size(); ++i)
    bins.grain[static_cast<std::size_t>(next[bin[i]]++)] = static_cast<int>(i);
  return bins;
}

}  // namespace

template <int D>
double default_gap_tolerance(const Bodies<D>& bodies) {
  return bodies.radius.empty() ? 0.0
                               : kTouchingTolerance * *std::max_element(bodies.radius.begin(), bodies.radius.end());
}

template <int D>
std::vector<Link<D>> touching_links(const Packing<D>& packing, double gap_tolerance) {
  const Bodies<D>& bodies = packing.bodies;
  std::vector<Link<D>> links;
  if (bodies.size() == 0) return links;

  // Work with the images inside the cell; wrapped[i] = r_i - home[i] * L.
  std::vector<Vec<D>> wrapped = bodies.position;
  std::vector<ImageShift<D>> home(bodies.size(), ImageShift<D>{});
  if (packing.cell) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (int k = 0; k < D; ++k)
        home[i][static_cast<std::size_t>(k)] = static_cast<int>(std::floor(wrapped[i][k] / packing.cell->length[k]));
      wrapped[i] -= packing.cell->offset(home[i]);
    }
  }
  const double largest = *std::max_element(bodies.radius.begin(), bodies.radius.end());
  // The margin covers the rounding of wrapped positions and of the bins they fall in.
  const double cutoff = (2 * largest + gap_tolerance) * (1 + 1e-6);
  const Bins<D> bins = make_bins<D>(wrapped, packing.cell, cutoff);

  const auto visit = [&](std::size_t i, std::size_t j, const ImageShift<D>& image) {
    ImageShift<D> shift = image;
    for (std::size_t k = 0; k < D; ++k) shift[k] += home[i][k] - home[j][k];
    if (j < i || (j == i && shift <= ImageShift<D>{})) return;
    const double gap = norm(branch(packing, i, j, shift)) - bodies.radius[i] - bodies.radius[j];
    if (!(gap <= gap_tolerance)) return;
    Link<D> link;
    link.i = static_cast<std::int32_t>(i), link.j = static_cast<std::int32_t>(j);
    link.shift = shift, link.gap = gap;
    links.push_back(link);
  };

  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::array<int, D> centre = bins.bin_of(wrapped[i]);
    std::array<int, D> offset;
    for (std::size_t k = 0; k < D; ++k) offset[k] = -bins.reach[k];
    for (bool more = true; more;) {
      std::array<int, D> b{};
      ImageShift<D> image{};
      bool inside = true;
      for (std::size_t k = 0; k < D; ++k) {
        const int at = centre[k] + offset[k], n = bins.count[k];
        image[k] = at >= 0 ? at / n : -((n - 1 - at) / n);
        b[k] = at - image[k] * n;
        inside = inside && (bins.periodic[k] || image[k] == 0);
      }
      if (inside) {
        const std::size_t f = bins.flat(b);
        for (int e = bins.start[f]; e < bins.start[f + 1]; ++e)
          visit(i, static_cast<std::size_t>(bins.grain[static_cast<std::size_t>(e)]), image);
      }
      more = false;
      for (std::size_t k = 0; k < D && !more; ++k) {
        if (++offset[k] <= bins.reach[k])
          more = true;
        else
          offset[k] = -bins.reach[k];
      }
    }
  }
  std::sort(links.begin(), links.end(), [](const Link<D>& a, const Link<D>& b) {
    return std::tie(a.i, a.j, a.shift) < std::tie(b.i, b.j, b.shift);
  });
  return links;
}

template std::vector<Link<2>> touching_links(const Packing<2>&, double);
template std::vector<Link<3>> touching_links(const Packing<3>&, double);
template <int D>
bool cell_fits(const Packing<D>& packing) {
  if (!packing.cell || packing.bodies.size() == 0) return true;
  const double largest = *std::max_element(packing.bodies.radius.begin(), packing.bodies.radius.end());
  for (int k = 0; k < D; ++k)
    if (packing.cell->length[k] < kSmallestCell * largest) return false;
  return true;
}

template bool cell_fits(const Packing<2>&);
template bool cell_fits(const Packing<3>&);
template double default_gap_tolerance(const Bodies<2>&);
template double default_gap_tolerance(const Bodies<3>&);

}  // namespace isostat
