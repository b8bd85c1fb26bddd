#include "analysis/rigidity/rigid_spheres.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "analysis/rigidity/modular_ldlt.hpp"
#include "analysis/rigidity/sphere_rows.hpp"
#include "geometry/placed_sets.hpp"

namespace isostat {
namespace {

using F = FirstField;
using Point = Real3<F>;
using Shift = ImageShift<3>;
using Sets = PlacedSets<3>;

constexpr Shift kHome{};
constexpr std::uint64_t kWeightSeed = 0x9A7C4, kMotionSeed = 0x3D0717;

// A link between two bodies, which are named by the root of their set.
struct OuterLink {
  std::int32_t a = 0, b = 0;  // a < b
  Shift image{};              // of b, seen from a
  std::int32_t link = 0;
  bool turned = false;  // a is the body of the link's j
  auto pair() const { return std::tie(a, b, image); }
};

// The motions of some bodies in two random null vectors of the links among them, each placed in an image.
class Patch {
 public:
  struct Member {
    std::int32_t body = 0;
    Shift image{};
  };
  std::vector<Member> members;

  // rows: bodies by their place in members. Groups of members that move alike, each with at least two.
  std::vector<std::vector<std::int32_t>> alike(const SphereRowList<F>& rows) {
    const auto count = static_cast<std::int32_t>(members.size());
    std::vector<std::int32_t> selected(rows.size()), node(members.size() + 1);
    std::iota(selected.begin(), selected.end(), 0);
    std::iota(node.begin(), node.end(), 0);
    std::vector<std::pair<std::int32_t, std::int32_t>> edges;
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (const auto blocks = rows.of(r); edges.empty() || edges.back() != std::pair(blocks[0].body, blocks[1].body))
        edges.push_back({blocks[0].body, blocks[1].body});
    const EliminationTree tree = elimination_tree(count, edges);
    const std::vector<std::int8_t> dofs(members.size(), kSphereDofs);
    std::vector<std::vector<std::int32_t>> groups;
    try {
      const ModularLdlt<F> ldlt(tree, dofs, NodeRows<F, kSphereDofs>{rows, selected, node}, kWeightSeed, true);
      const std::vector<F> first = ldlt.random_null_vector(kMotionSeed),
                           second = ldlt.random_null_vector(kMotionSeed + 1);
      std::vector<std::int32_t> order(members.size());
      std::iota(order.begin(), order.end(), 0);
      const auto compare = [&](std::int32_t a, std::int32_t b) {  // <0, 0, >0
        for (std::size_t d = 0; d < kSphereDofs; ++d)
          for (const auto* x : {&first, &second}) {
            const auto u = (*x)[idx(ldlt.offset(a)) + d].value, v = (*x)[idx(ldlt.offset(b)) + d].value;
            if (u != v) return u < v ? -1 : 1;
          }
        return 0;
      };
      std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        const int c = compare(a, b);
        return c != 0 ? c < 0 : a < b;
      });
      for (std::size_t begin = 0, end; begin < order.size(); begin = end) {
        for (end = begin + 1; end < order.size() && compare(order[begin], order[end]) == 0;) ++end;
        if (end - begin > 1)
          groups.emplace_back(order.begin() + static_cast<std::ptrdiff_t>(begin),
                              order.begin() + static_cast<std::ptrdiff_t>(end));
      }
    } catch (const RandomizationFailed&) {  // nothing learnt: the elimination of the whole is left more
    }
    return groups;
  }
};

class Contraction {
 public:
  Contraction(const SphereNetwork& network, NetworkLaw law)
      : network_(network), packing_(network.packing), law_(law), sets_(packing_.bodies.size()) {
    for (std::size_t held = idx(network.free) + 1; held < packing_.bodies.size(); ++held)
      glue(static_cast<std::int32_t>(held) - 1, static_cast<std::int32_t>(held), kHome);
    if (law == NetworkLaw::frictionless) return;
    for (std::size_t l = 0; l < packing_.links.size(); ++l) {
      const Link<3>& link = packing_.links[l];
      if (const SphereRows rows = sphere_rows(link.kind, law); rows.contact && rows.rolling)
        glue(link.i, link.j, link.shift);
      outer_.push_back({0, 0, {}, static_cast<std::int32_t>(l)});
    }
    geometry_ = exact_geometry<F>(network);
    locate_contacts();
    grow();
  }

  RigidBodiesOf<3> result() {
    RigidBodiesOf<3> bodies;
    const std::size_t n = packing_.bodies.size();
    bodies.body_of.resize(n), bodies.placement.resize(n);
    constexpr std::int32_t fresh = -2;
    std::vector<std::int32_t> number(n, fresh);
    for (std::size_t i = idx(network_.free); i < n; ++i)
      number[idx(sets_.find(static_cast<std::int32_t>(i)).root)] = RigidBodiesOf<3>::held;
    for (std::size_t i = 0; i < n; ++i) {
      const auto [root, image] = sets_.find(static_cast<std::int32_t>(i));
      if (number[idx(root)] == fresh) number[idx(root)] = bodies.count++;
      bodies.body_of[i] = number[idx(root)];
      bodies.placement[i] = image;
    }
    return bodies;
  }

 private:
  static constexpr std::size_t kFirstPatch = 32, kLargestPatch = 256;
  static constexpr double kWorth = 0.02;  // of the bodies: a pass that glues fewer has shown what its patches can

  void grow() {
    std::size_t size = kFirstPatch;
    for (std::uint64_t pass = 0; size <= kLargestPatch; ++pass) {
      share_three_contacts();
      if (outer_.empty()) return;
      const std::size_t glued = glue_patches(size, pass);
      if (static_cast<double>(glued) < kWorth * static_cast<double>(roots_.size())) size *= 2;
    }
    share_three_contacts();
  }

  // Member j lies in image `relative` when member i lies in image 0. False: it did before.
  bool glue(std::int32_t i, std::int32_t j, const Shift& relative) {
    const auto [a, image_a] = sets_.find(i);
    const auto [b, image_b] = sets_.find(j);
    if (a == b) return false;  // perhaps another image of itself, which is left to the rows
    sets_.absorb(a, b, Sets::difference(Sets::sum(image_a, relative), image_b));
    return true;
  }

  // Contact points r_i + r_ij R_i / (R_i + R_j), all inverses by one (running products).
  void locate_contacts() {
    const std::size_t n = packing_.links.size();
    point_.resize(n);
    std::vector<F> before(n);
    F product(1);
    const auto sum = [&](std::size_t l) {
      const Link<3>& link = packing_.links[l];
      return geometry_.radius[idx(link.i)] + geometry_.radius[idx(link.j)];
    };
    for (std::size_t l = 0; l < n; ++l) {
      before[l] = product;
      if (const F s = sum(l); !s.is_zero()) product = product * s;
    }
    F inverse = product.inverse();
    for (std::size_t l = n; l-- > 0;) {
      const F s = sum(l);
      const Link<3>& link = packing_.links[l];
      if (s.is_zero()) continue;  // p divides the sum: pins() leaves it out
      const F ratio = geometry_.radius[idx(link.i)] * inverse * before[l];
      inverse = inverse * s;
      const Point r = geometry_.branch(link);
      for (std::size_t k = 0; k < 3; ++k) point_[l][k] = geometry_.position[idx(link.i)][k] + r[k] * ratio;
    }
  }
  bool pins(std::size_t l) const {
    const Link<3>& link = packing_.links[l];
    return sphere_rows(link.kind, law_).contact &&
           !(geometry_.radius[idx(link.i)] + geometry_.radius[idx(link.j)]).is_zero();
  }
  // In the frame of o.a.
  Point contact_point(const OuterLink& o) const {
    const Link<3>& link = packing_.links[idx(o.link)];
    const Shift at = o.turned ? Sets::difference(place_[idx(link.j)], link.shift) : place_[idx(link.i)];
    return at == kHome ? point_[idx(o.link)] : sum_3d<F>(point_[idx(o.link)], geometry_.offset(at));
  }

  // Bodies, places and links between bodies as they are now; what is glued later does not change them.
  void freeze() {
    const std::size_t n = packing_.bodies.size();
    root_.resize(n), place_.resize(n);
    roots_.clear();
    for (std::size_t i = 0; i < n; ++i) {
      const auto [root, image] = sets_.find(static_cast<std::int32_t>(i));
      root_[i] = root, place_[i] = image;
      if (idx(root) == i) roots_.push_back(root);
    }
    std::size_t kept = 0;
    for (OuterLink o : outer_) {
      const Link<3>& link = packing_.links[idx(o.link)];
      const auto i = idx(link.i), j = idx(link.j);
      o.a = root_[i], o.b = root_[j], o.image = Sets::difference(Sets::sum(link.shift, place_[i]), place_[j]);
      if (o.a == o.b) continue;
      o.turned = o.a > o.b;
      if (o.turned) std::swap(o.a, o.b), o.image = Sets::difference(kHome, o.image);
      outer_[kept++] = o;
    }
    outer_.resize(kept);
    std::sort(outer_.begin(), outer_.end(), [](const OuterLink& x, const OuterLink& y) {
      return x.pair() != y.pair() ? x.pair() < y.pair() : x.link < y.link;
    });
  }

  void share_three_contacts() {
    for (bool again = true; again;) {
      again = false;
      freeze();
      for (std::size_t first = 0, last; first < outer_.size(); first = last) {
        for (last = first + 1; last < outer_.size() && outer_[last].pair() == outer_[first].pair();) ++last;
        if (last - first >= 3 && span_a_plane(first, last))
          again = glue(outer_[first].a, outer_[first].b, outer_[first].image) || again;
      }
    }
  }
  bool span_a_plane(std::size_t first, std::size_t last) const {
    const OuterLink *one = nullptr, *two = nullptr;
    Point origin, line;
    for (std::size_t k = first; k < last; ++k) {
      if (!pins(idx(outer_[k].link))) continue;
      const Point p = contact_point(outer_[k]);
      if (one == nullptr) {
        one = &outer_[k], origin = p;
        continue;
      }
      const Point arm = difference_3d<F>(p, origin);
      if (arm == Point{}) continue;
      if (two == nullptr)
        two = &outer_[k], line = arm;
      else if (cross_3d<F>(arm, line) != Point{})
        return true;
    }
    return false;
  }

  // Patches of up to `size` bodies, grown breadth first through the links, next to those before. A body with many more
  // links than others belongs to every patch that it touches. Number of bodies glued.
  std::size_t glue_patches(std::size_t size, std::uint64_t pass) {
    list_neighbours();
    const std::size_t n = packing_.bodies.size();
    std::vector<char> taken(n, 0);
    std::vector<std::int32_t> local(n, -1), frontier;
    std::size_t glued = 0, next_frontier = 0;
    const std::size_t begin = static_cast<std::size_t>(F::random(kWeightSeed, pass).value) % roots_.size();
    const auto grow_from = [&](std::int32_t seed) {
      if (taken[idx(seed)] || is_big(seed)) return;
      Patch patch;
      const auto take = [&](std::int32_t body, const Shift& image) {
        local[idx(body)] = static_cast<std::int32_t>(patch.members.size());
        patch.members.push_back({body, image});
      };
      std::size_t small = 1;
      take(seed, kHome), taken[idx(seed)] = 1;
      for (std::size_t k = 0; k < patch.members.size(); ++k) {
        const auto [body, image] = patch.members[k];
        if (is_big(body)) continue;
        each_neighbour(body, [&](std::int32_t other, const Shift& seen, const OuterLink&) {
          if (local[idx(other)] >= 0) return;
          if (is_big(other))
            take(other, Sets::sum(image, seen));
          else if (!taken[idx(other)]) {
            if (small < size)
              take(other, Sets::sum(image, seen)), taken[idx(other)] = 1, ++small;
            else
              frontier.push_back(other);
          }
        });
      }
      for (const Patch::Member& m : patch.members) local[idx(m.body)] = -1;
      if (small >= kLeastPatch || small < patch.members.size()) glued += glue_alike(patch, local);
    };
    for (std::size_t k = 0; k < roots_.size(); ++k) {
      grow_from(roots_[(begin + k) % roots_.size()]);
      while (next_frontier < frontier.size()) grow_from(frontier[next_frontier++]);
    }
    return glued;
  }

  // Members with too few rows to hold others together leave the patch first: a tree of them bears nothing.
  std::size_t glue_alike(Patch& patch, std::vector<std::int32_t>& local) {
    struct Inner {
      std::int32_t a, b;
      const OuterLink* outer;
    };
    std::vector<Inner> links;
    for (std::size_t k = 0; k < patch.members.size(); ++k)
      local[idx(patch.members[k].body)] = static_cast<std::int32_t>(k);
    std::vector<int> rows(patch.members.size(), 0);
    const auto count_of = [&](const Inner& l) {
      return sphere_rows(packing_.links[idx(l.outer->link)].kind, law_).count();
    };
    // A big body's own list is long and not read: its links are in those of its neighbours, and two big ones are left.
    for (std::size_t k = 0; k < patch.members.size(); ++k) {
      const auto [body, image] = patch.members[k];
      if (is_big(body)) continue;
      each_neighbour(body, [&](std::int32_t other, const Shift& seen, const OuterLink& o) {
        const std::int32_t at = local[idx(other)];
        if (at < 0) return;
        if (!is_big(other) && at < static_cast<std::int32_t>(k)) return;
        if (Sets::sum(image, seen) != patch.members[idx(at)].image) return;
        links.push_back({static_cast<std::int32_t>(k), at, &o});
        rows[k] += count_of(links.back()), rows[idx(at)] += count_of(links.back());
      });
    }
    for (const Patch::Member& m : patch.members) local[idx(m.body)] = -1;

    std::vector<char> gone(patch.members.size(), 0);
    for (bool again = true; again;) {
      again = false;
      for (std::size_t k = 0; k < gone.size(); ++k)
        if (!gone[k] && rows[k] < kSphereDofs) gone[k] = 1, again = true;
      std::erase_if(links, [&](const Inner& l) {
        if (!gone[idx(l.a)] && !gone[idx(l.b)]) return false;
        rows[idx(l.a)] -= count_of(l), rows[idx(l.b)] -= count_of(l);
        return true;
      });
    }
    std::vector<std::int32_t> renumbered(gone.size(), -1);
    Patch core;
    for (std::size_t k = 0; k < gone.size(); ++k)
      if (!gone[k])
        renumbered[k] = static_cast<std::int32_t>(core.members.size()), core.members.push_back(patch.members[k]);
    if (core.members.size() < 2) return 0;

    SphereRowList<F> list;
    for (const Inner& inner : links) {
      const Link<3>& link = packing_.links[idx(inner.outer->link)];
      const auto i = idx(link.i), j = idx(link.j);
      std::int32_t at_i = renumbered[idx(inner.a)], at_j = renumbered[idx(inner.b)];
      if (core.members[idx(at_i)].body != root_[i]) std::swap(at_i, at_j);
      const Point r = geometry_.branch(link),
                  x_i = geometry_.placed(i, Sets::sum(place_[i], core.members[idx(at_i)].image)),
                  x_j = geometry_.placed(j, Sets::sum(place_[j], core.members[idx(at_j)].image));
      const SphereRows kept = sphere_rows(link.kind, law_);
      for (int k = 0; k < kept.count(); ++k) {
        const SphereRow row = kept.at(k);
        const auto on =
            pair_blocks<F>(rational_load<F>(row, r, geometry_.radius[i], geometry_.radius[j]), x_i, x_j, true);
        list.begin_row(inner.outer->link, row.kind, row.axis);
        list.blocks.push_back({at_i, on.i}), list.blocks.push_back({at_j, on.j});
      }
    }
    std::size_t glued = 0;
    for (const auto& group : core.alike(list))
      for (std::size_t k = 1; k < group.size(); ++k) {
        const auto &a = core.members[idx(group[0])], &b = core.members[idx(group[k])];
        glued += glue(a.body, b.body, Sets::difference(b.image, a.image));
      }
    return glued;
  }

  void list_neighbours() {
    const std::size_t n = packing_.bodies.size();
    start_.assign(n + 1, 0);
    for (const OuterLink& o : outer_) ++start_[idx(o.a) + 1], ++start_[idx(o.b) + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    incident_.resize(idx(start_.back()));
    std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t k = 0; k < outer_.size(); ++k)
      for (const std::int32_t end : {outer_[k].a, outer_[k].b})
        incident_[idx(next[idx(end)]++)] = static_cast<std::int32_t>(k);
  }
  // f(neighbour, its image seen from the frame of body, the link).
  template <class Function>
  void each_neighbour(std::int32_t body, Function&& f) const {
    for (std::int32_t e = start_[idx(body)]; e < start_[idx(body) + 1]; ++e) {
      const OuterLink& o = outer_[idx(incident_[idx(e)])];
      if (o.a == body)
        f(o.b, o.image, o);
      else
        f(o.a, Sets::difference(kHome, o.image), o);
    }
  }

  static constexpr std::size_t kManyLinks = 8, kLeastPatch = 4;

  bool is_big(std::int32_t body) const {
    return idx(start_[idx(body) + 1] - start_[idx(body)]) * roots_.size() > kManyLinks * incident_.size();
  }

  const SphereNetwork& network_;
  const Packing<3>& packing_;
  NetworkLaw law_;
  SphereGeometry<F> geometry_;
  Sets sets_;
  std::vector<Point> point_;        // of contact, by link, in the raw frame of its i
  std::vector<OuterLink> outer_;    // sorted by pair
  std::vector<std::int32_t> root_;  // by grain, with place_ as frozen
  std::vector<Shift> place_;
  std::vector<std::int32_t> roots_;
  std::vector<std::int32_t> start_, incident_;  // indices into outer_, by root
};

}  // namespace

RigidBodiesOf<3> contract_rigid_bodies(const SphereNetwork& network, NetworkLaw law) {
  return Contraction(network, law).result();
}

}  // namespace isostat
