#include "dem/state/touching.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "dem/state/link_ends.hpp"
#include "geometry/cell_grid.hpp"

namespace isostat {

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
      const Vec<D> fractions = packing.cell->fractions(wrapped[i]);
      for (int k = 0; k < D; ++k) home[i][static_cast<std::size_t>(k)] = static_cast<int>(std::floor(fractions[k]));
      wrapped[i] -= packing.cell->offset(home[i]);
    }
  }
  const double largest = *std::max_element(bodies.radius.begin(), bodies.radius.end());
  // The margin covers the rounding of wrapped positions and of the bins they fall in.
  const double cutoff = (2 * largest + gap_tolerance) * (1 + 1e-6);
  const CellGrid<D> grid(frame_of(packing.cell, wrapped), cutoff, bodies.size());
  const GridMembers<D> members(grid, wrapped);
  std::array<int, D> reach;  // cells to either side that can hold a neighbour: more than one in a tiny periodic cell
  for (std::size_t k = 0; k < D; ++k)
    reach[k] = packing.cell ? static_cast<int>(std::ceil(cutoff / grid.width(static_cast<int>(k)))) : 1;

  const auto visit = [&](std::size_t i, std::size_t j, const ImageShift<D>& image) {
    ImageShift<D> shift = image;
    for (std::size_t k = 0; k < D; ++k) shift[k] += home[i][k] - home[j][k];
    if (j < i || (j == i && shift <= ImageShift<D>{})) return;
    if (!is_free(packing.part, i) && !is_free(packing.part, j)) return;
    const double gap = norm(branch(packing, i, j, shift)) - bodies.radius[i] - bodies.radius[j];
    if (!(gap <= gap_tolerance)) return;
    Link<D> link;
    link.i = static_cast<std::int32_t>(i), link.j = static_cast<std::int32_t>(j);
    link.shift = shift, link.gap = gap;
    links.push_back(link);
  };

  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::array<int, D> centre = grid.columns(wrapped[i]);
    std::array<int, D> offset;
    for (std::size_t k = 0; k < D; ++k) offset[k] = -reach[k];
    for (bool more = true; more;) {
      std::array<int, D> b{};
      ImageShift<D> image{};
      bool inside = true;
      for (std::size_t k = 0; k < D; ++k) {
        const int at = centre[k] + offset[k], n = grid.count(static_cast<int>(k));
        image[k] = at >= 0 ? at / n : -((n - 1 - at) / n);
        b[k] = at - image[k] * n;
        inside = inside && (packing.cell || image[k] == 0);
      }
      if (inside) {
        const std::size_t c = grid.index(b);
        for (auto m = static_cast<std::size_t>(members.begin[c]); m < static_cast<std::size_t>(members.begin[c + 1]);
             ++m)
          visit(i, static_cast<std::size_t>(members.member[m]), image);
      }
      more = false;
      for (std::size_t k = 0; k < D && !more; ++k) {
        if (++offset[k] <= reach[k])
          more = true;
        else
          offset[k] = -reach[k];
      }
    }
  }
  std::sort(links.begin(), links.end(), [](const Link<D>& a, const Link<D>& b) {
    return std::tie(a.i, a.j, a.shift) < std::tie(b.i, b.j, b.shift);
  });
  return links;
}

template <int D>
void find_contacts(Packing<D>& packing, double gap_tolerance) {
  std::erase_if(packing.links, [](const Link<D>& l) { return l.kind != LinkKind::beam; });
  std::set<std::tuple<std::int32_t, std::int32_t, ImageShift<D>>> joined;
  for (const Link<D>& l : packing.links) {
    ImageShift<D> back{};
    for (std::size_t k = 0; k < D; ++k) back[k] = -l.shift[k];
    joined.insert({l.i, l.j, l.shift}), joined.insert({l.j, l.i, back});
  }
  for (const Link<D>& l : touching_links(packing, gap_tolerance))
    if (!joined.contains({l.i, l.j, l.shift})) packing.links.push_back(l);
}

template void find_contacts(Packing<2>&, double);
template void find_contacts(Packing<3>&, double);
template std::vector<Link<2>> touching_links(const Packing<2>&, double);
template std::vector<Link<3>> touching_links(const Packing<3>&, double);
template double default_gap_tolerance(const Bodies<2>&);
template double default_gap_tolerance(const Bodies<3>&);

}  // namespace isostat
