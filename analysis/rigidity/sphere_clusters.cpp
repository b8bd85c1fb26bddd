// Rigid clusters of spheres.
#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "analysis/rigidity/clusters.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/null_motion.hpp"
#include "analysis/rigidity/part_of_packing.hpp"
#include "dem/input_error.hpp"
#include "geometry/base/index.hpp"
#include "geometry/placed_sets.hpp"
#include "geometry/union_find.hpp"

namespace isostat {
namespace {

using F = WideField;
using Point = Real3<F>;
using LinkSets = std::vector<std::vector<std::int32_t>>;

class Motions {
 public:
  Motions(const SphereNetwork& network, NetworkLaw law, bool cell_free)
      : problem_(reduce_problem<F>(network, law, cell_free)),
        motion_(random_null_motion(problem_)),
        geometry_(exact_geometry<F>(network)) {}

  const SphereGeometry<F>& geometry() const { return geometry_; }
  // The two ends of the link move as one rigid body.
  bool alike(const Link<3>& link) const {
    const Body a = of(link.i), b = of(link.j);
    const Point o = geometry_.offset(problem_.bodies.image(link)), turn = cross_3d<F>(b.spin, o);
    for (std::size_t k = 0; k < 3; ++k)  // the image of b: V_b - W_b x o - e o
      if (!(a.spin[k] == b.spin[k]) || !(a.velocity[k] == b.velocity[k] - turn[k] - motion_.back()[k] * o[k]))
        return false;
    return true;
  }
  // Of the centres, v_j - v_i.
  Point relative_velocity(const Link<3>& link) const {
    Point v = difference_3d<F>(of_centre(link.j), of_centre(link.i));
    const Point o = geometry_.offset(link.shift);
    for (std::size_t k = 0; k < 3; ++k) v[k] = v[k] - motion_.back()[k] * o[k];
    return v;
  }

 private:
  struct Body {
    Point velocity{}, spin{};
  };
  Body of(std::int32_t grain) const {
    const std::int32_t body = problem_.bodies.body_of[idx(grain)];
    if (body == RigidBodiesOf<3>::held) return {};
    const auto& m = motion_[idx(body)];
    return {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}};
  }
  Point of_centre(std::int32_t grain) const {  // peculiar: of the image in the cell
    const auto& at = problem_.bodies.placement[idx(grain)];
    const Body b = of(grain);
    const Point o = geometry_.offset(at), turn = cross_3d<F>(b.spin, geometry_.placed(idx(grain), at));
    Point v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = b.velocity[k] + turn[k] + motion_.back()[k] * o[k];
    return v;
  }

  ReducedProblem<F, SphereNetwork> problem_;
  NullMotion<SphereNetwork> motion_;
  SphereGeometry<F> geometry_;
};

LinkSets sets_with_friction(const SphereNetwork& network, const Motions& motions) {
  const auto& links = network.packing.links;
  UnionFind sets(network.packing.bodies.size());
  for (std::size_t b = idx(network.free); b + 1 < network.packing.bodies.size(); ++b) sets.join(b, b + 1);
  std::vector<char> together(links.size());
  for (std::size_t l = 0; l < links.size(); ++l)
    if ((together[l] = motions.alike(links[l]))) sets.join(idx(links[l].j), idx(links[l].i));
  std::map<std::size_t, std::vector<std::int32_t>> by_root;
  for (std::size_t l = 0; l < links.size(); ++l)
    if (together[l]) by_root[sets.find(idx(links[l].i))].push_back(static_cast<std::int32_t>(l));
  LinkSets all;
  for (auto& [root, list] : by_root) all.push_back(std::move(list));
  return all;
}

// Points: two links at a grain that are not in line turn alike if the grain and its two neighbours move rigidly, about
// one W: W x r = v for both. The turns of a grain's links are its joints; a link carries a joint of one end to those
// with the same W of the other. A link without such a partner is a set of its own.
LinkSets sets_of_points(const SphereNetwork& network, const Motions& motions) {
  const auto& links = network.packing.links;
  struct Arm {
    std::int32_t link = 0;
    Point r, v;  // from the grain to its neighbour
  };
  std::vector<std::vector<Arm>> arms(network.packing.bodies.size());
  for (std::size_t l = 0; l < links.size(); ++l) {
    const Point r = motions.geometry().branch(links[l]), v = motions.relative_velocity(links[l]);
    arms[idx(links[l].i)].push_back({static_cast<std::int32_t>(l), r, v});
    arms[idx(links[l].j)].push_back({static_cast<std::int32_t>(l), difference_3d<F>({}, r), difference_3d<F>({}, v)});
  }
  // Joints of all grains: a set of links with the same turn.
  using Turn = std::array<std::uint64_t, 3>;
  std::vector<std::vector<std::int32_t>> joint_links;
  std::map<std::pair<std::int32_t, Turn>, std::vector<std::size_t>> joints_of_link;
  for (const auto& at : arms) {
    std::map<Turn, std::vector<std::int32_t>> joints;
    for (std::size_t a = 0; a < at.size(); ++a)
      for (std::size_t b = a + 1; b < at.size(); ++b) {
        const Point normal = cross_3d<F>(at[a].r, at[b].r);
        if (normal == Point{}) continue;
        const Point apart = difference_3d<F>(at[b].r, at[a].r), drift = difference_3d<F>(at[b].v, at[a].v);
        if (!dot_3d<F>(apart, drift).is_zero()) continue;
        // W = (v_a x v_b) / (v_a . r_b) where that exists; in general from W . r and W x r: with m = r_a x r_b,
        // W m^2 = (v_b . m) r_a - (v_a . m) r_b + (v_a . r_b) m.
        const F square = dot_3d<F>(normal, normal);
        if (square.is_zero()) continue;
        const F inverse = square.inverse(), of_a = dot_3d<F>(at[b].v, normal) * inverse,
                of_b = dot_3d<F>(at[a].v, normal) * inverse, of_m = dot_3d<F>(at[a].v, at[b].r) * inverse;
        Turn turn;
        for (std::size_t k = 0; k < 3; ++k) turn[k] = (of_a * at[a].r[k] - of_b * at[b].r[k] + of_m * normal[k]).value;
        auto& list = joints[turn];
        list.push_back(at[a].link), list.push_back(at[b].link);
      }
    for (auto& [turn, list] : joints) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
      for (const std::int32_t l : list) joints_of_link[{l, turn}].push_back(joint_links.size());
      joint_links.push_back(std::move(list));
    }
  }
  UnionFind sets(joint_links.size());
  for (const auto& [key, list] : joints_of_link)
    for (std::size_t k = 1; k < list.size(); ++k) sets.join(list[0], list[k]);
  LinkSets all;
  std::vector<char> in_one(links.size(), 0);
  for (const auto& set : sets.sets()) {
    std::vector<std::int32_t> list;
    for (const std::size_t joint : set) list.insert(list.end(), joint_links[joint].begin(), joint_links[joint].end());
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    for (const std::int32_t l : list) in_one[idx(l)] = 1;
    all.push_back(std::move(list));
  }
  for (std::size_t l = 0; l < links.size(); ++l)
    if (!in_one[l]) all.push_back({static_cast<std::int32_t>(l)});
  return all;
}

RigidCluster describe(const SphereNetwork& network, NetworkLaw law, bool cell_free,
                      const std::vector<std::int32_t>& links) {
  const OwnedSpheres owned = part_of(network, {}, links);
  const SphereNetwork part = owned.view();
  RigidCluster c;
  c.grains = part.free;
  c.links = static_cast<std::int64_t>(links.size());
  c.rows = row_count(part, law);
  PlacedSets<3> places(owned.packing.bodies.size());
  if (owned.packing.cell)
    for (const Link<3>& link : owned.packing.links)
      if (const auto winding = places.join(link.i, link.j, link.shift))
        for (std::size_t k = 0; k < 3; ++k) c.spans[k] = c.spans[k] || (*winding)[k] != 0;
  const bool tree = !part.any_held() && c.links < c.grains;  // without loops rows do not depend on each other
  c.hyperstatic = tree ? 0 : exact_rank(part, law, cell_free).hyperstatic;
  return c;
}

}  // namespace

RigidClusters rigid_clusters(const SphereNetwork& network, NetworkLaw law, bool cell_free) {
  if (cell_free && !network.packing.cell)
    throw InputError("command line", 0, "--cell", "free", "the input has no cell");
  LinkSets sets;
  {
    const Motions motions(network, law, cell_free);
    sets = law == NetworkLaw::frictionless ? sets_of_points(network, motions) : sets_with_friction(network, motions);
  }
  std::erase_if(sets, [&](const auto& links) {  // a grain and its own image are one grain
    const auto& all = network.packing.links;
    return std::all_of(links.begin(), links.end(), [&](std::int32_t l) {
      return all[idx(l)].i == all[idx(links[0])].i && all[idx(l)].j == all[idx(links[0])].i;
    });
  });
  RigidClusters result;
  for (const auto& links : sets) result.clusters.push_back(describe(network, law, cell_free, links));
  std::vector<std::size_t> order(sets.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return result.clusters[a].grains != result.clusters[b].grains
               ? result.clusters[a].grains > result.clusters[b].grains
               : sets[a] < sets[b];
  });
  RigidClusters sorted;
  sorted.cluster_of_link.assign(network.links(), -1);
  sorted.cluster_of_grain.assign(network.packing.bodies.size(), -1);
  for (const std::size_t k : order) {
    const auto index = static_cast<std::int32_t>(sorted.clusters.size());
    sorted.clusters.push_back(result.clusters[k]);
    for (const std::int32_t l : sets[k]) {
      if (sorted.cluster_of_link[idx(l)] < 0) sorted.cluster_of_link[idx(l)] = index;
      for (const std::int32_t g : {network.packing.links[idx(l)].i, network.packing.links[idx(l)].j})
        if (sorted.cluster_of_grain[idx(g)] < 0) sorted.cluster_of_grain[idx(g)] = index;
    }
    sorted.links.push_back(std::move(sets[k]));
  }
  return sorted;
}

}  // namespace isostat
