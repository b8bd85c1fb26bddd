#include "analysis/network/two_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "analysis/network/force_scale.hpp"
#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

double tangential_of(const Link<2>& link) { return std::abs(link.tangential_force); }
double tangential_of(const Link<3>& link) { return norm(link.tangential_force); }

// A loaded link of a grain: its other end and in which image that lies.
template <int D>
struct Loaded {
  std::int32_t link, neighbour;
  ImageShift<D> shift;
};

template <int D>
ImageShift<D> opposite(ImageShift<D> shift) {
  for (int& s : shift) s = -s;
  return shift;
}

}  // namespace

template <int D>
std::vector<TwoContact> two_contacts(const Packing<D>& packing, double loaded) {
  std::vector<std::vector<Loaded<D>>> at(packing.bodies.size());
  std::set<std::tuple<std::int32_t, std::int32_t, ImageShift<D>>> touching;
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const Link<D>& link = packing.links[l];
    const auto number = static_cast<std::int32_t>(l);
    if (is_contact(link.kind))
      touching.insert({link.i, link.j, link.shift}), touching.insert({link.j, link.i, opposite<D>(link.shift)});
    if (link.kind == LinkKind::beam || !(force_magnitude(link) > loaded)) continue;
    at[idx(link.i)].push_back({number, link.j, link.shift});
    at[idx(link.j)].push_back({number, link.i, opposite<D>(link.shift)});
  }
  std::vector<TwoContact> found;
  for (std::size_t g = 0; g < at.size(); ++g) {
    if (at[g].size() != 2 || !is_free(packing.part, g)) continue;
    const auto &a = at[g][0], &b = at[g][1];
    const auto grain = static_cast<std::int32_t>(g);
    const auto usable = [&](const Loaded<D>& e) {
      return is_contact(packing.links[idx(e.link)].kind) && is_free(packing.part, idx(e.neighbour)) &&
             e.neighbour != grain;
    };
    if (!usable(a) || !usable(b) || (a.neighbour == b.neighbour && a.shift == b.shift)) continue;
    ImageShift<D> between = b.shift;  // of b against a
    for (std::size_t k = 0; k < D; ++k) between[k] -= a.shift[k];
    const bool touch = touching.contains({a.neighbour, b.neighbour, between});
    const double r = packing.bodies.radius[g], r1 = packing.bodies.radius[idx(a.neighbour)],
                 r2 = packing.bodies.radius[idx(b.neighbour)];
    const Vec<D> to_a = branch(packing, g, idx(a.neighbour), a.shift),
                 to_b = branch(packing, g, idx(b.neighbour), b.shift);
    const Vec<D> ua = to_a / norm(to_a), ub = to_b / norm(to_b);
    // cot(gamma/2) of two unit vectors: |a + b| / |a - b|.
    const double predicted = touch ? std::sqrt(r * (r1 + r2 + r) / (r1 * r2)) : norm(ua + ub) / norm(ua - ub);
    for (const auto& [here, other] : {std::pair{a, b}, std::pair{b, a}}) {
      const Link<D>& link = packing.links[idx(here.link)];
      found.push_back({grain, here.neighbour, other.neighbour, here.link, touch,
                       tangential_of(link) / std::abs(link.normal_force), predicted});
    }
  }
  return found;
}

template std::vector<TwoContact> two_contacts(const Packing<2>&, double);
template std::vector<TwoContact> two_contacts(const Packing<3>&, double);

}  // namespace isostat
