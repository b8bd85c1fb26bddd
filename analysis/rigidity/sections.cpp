#include "analysis/rigidity/sections.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <type_traits>

#include "analysis/network/coordination.hpp"
#include "analysis/plain_number.hpp"
#include "analysis/rigidity/clusters.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/part_of_packing.hpp"
#include "analysis/stiffness/soft_modes.hpp"
#include "analysis/stiffness/sparse_cholesky.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

// Soft modes cost more than the integers; above this size they are for those who ask for them.
constexpr std::int64_t kNearNullDofs = 20000;
constexpr int kNearNullValues = 6;

// Null modes that vanish when the rattlers and their links are taken away (rattlers of a cohesionless state may touch).
template <class Network>
std::int64_t rattler_modes(const AnalysisInput& input, const Network& network, NetworkLaw law, bool cell_free,
                           const ExactRank& whole) {
  if (input.triangles) return whole.rattler_modes;
  const auto& packing = network.packing;
  const Coordination c = coordination(packing, read_forces(input));
  bool linked = false;
  for (const auto& l : packing.links) linked = linked || c.rattler[idx(l.i)] || c.rattler[idx(l.j)];
  if (!linked) return whole.rattler_modes;
  std::vector<std::int32_t> grains, links;
  const auto stays = [&](std::int32_t grain) { return !c.rattler[idx(grain)]; };
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(packing.bodies.size()); ++i)
    if (stays(i)) grains.push_back(i);
  for (std::size_t l = 0; l < packing.links.size(); ++l)
    if (stays(packing.links[l].i) && stays(packing.links[l].j)) links.push_back(static_cast<std::int32_t>(l));
  if (std::none_of(grains.begin(), grains.end(), [&](std::int32_t g) { return is_free(packing.part, idx(g)); }))
    return whole.floppy - whole.trivial;
  const auto backbone = part_of(network, grains, links);
  return whole.floppy - exact_rank(backbone.view(), law, cell_free).floppy;
}

template <class Network>
Json near_null(const Network& network, NetworkLaw law, const AnalysisOptions& options, const ExactRank& rank) {
  if (rank.dofs > kNearNullDofs && !options.near_null)
    return Json{
        {"values", nullptr},
        {"reason", "above " + std::to_string(kNearNullDofs) + " degrees of freedom they are left to --near-null"}};
  try {
    return Json{{"values", smallest_singular_values(network, law, options.cell_free, kNearNullValues)}};
  } catch (const FactorisationFailed& e) {
    return Json{{"values", nullptr}, {"reason", std::string("double precision does not resolve them: ") + e.what()}};
  }
}

template <class Network>
Json rigidity_of(const Network& network, const AnalysisInput& input, const AnalysisOptions& options) {
  const auto& packing = network.packing;
  const NetworkLaw law = input.network_law(options);
  ExactRank r = exact_rank(network, law, options.cell_free);
  r.rattler_modes = rattler_modes(input, network, law, options.cell_free, r);
  r.mechanisms = r.floppy - r.trivial - r.rattler_modes;

  Json gears = Json::array();
  for (const auto& component : gear_components(network, law)) {
    Json ids = Json::array();
    for (std::size_t k = 0; k < component.size() && k < 20; ++k)
      ids.push_back(packing.bodies.id[static_cast<std::size_t>(component[k])]);
    gears.push_back({{"grains", component.size()}, {"first_ids", ids}});
  }
  Json primes = Json::array();
  for (std::uint64_t p : r.primes) primes.push_back(p);
  const std::string verdict = r.bounds_meet ? "proved: the bound for generic positions equals the rank modulo a prime"
                              : r.certified
                                  ? "special positions: two primes agree, above the bound for generic positions"
                                  : "NOT certified: two primes disagree";
  const std::string contacts = input.triangles ? "the overlaps as they lie"
                               : input.touching_tolerance
                                   ? "found by touching: every gap up to " + plain_number(*input.touching_tolerance)
                                   : "those of the file";
  return Json{{"law", name_of(law)},
              {"cell", options.cell_free ? "free" : "fixed"},
              {"N_f", r.dofs},
              {"M", r.rows},
              {"rank", r.rank},
              {"H", r.hyperstatic},
              {"K", r.floppy},
              {"trivial", r.trivial},
              {"rattler_modes", r.rattler_modes},
              {"mechanisms", r.mechanisms},
              {"method", "exact contraction to rigid bodies, then rank of G^T W G modulo primes"},
              {"certificate",
               {{"certified", r.certified},
                {"verdict", verdict},
                {"contacts", contacts},
                {"primes", primes},
                {"K_upper", r.floppy},
                {"K_lower_generic", r.floppy_generic},
                {"error_chance", 1e-12},
                {"rigid_bodies", r.bodies},
                {"gear_components", gears},
                {"near_null_singular_values", near_null(network, law, options, r)}}}};
}

template <class Network>
Json clusters_of(const Network& network, const AnalysisInput& input, const AnalysisOptions& options) {
  constexpr std::size_t kAxes = std::is_same_v<Network, SphereNetwork> ? 3 : 2;
  const RigidClusters found = rigid_clusters(network, input.network_law(options), options.cell_free);
  Json sizes = Json::array(), list = Json::array();
  std::int64_t hyperstatic = 0, spanning = 0;
  for (const RigidCluster& c : found.clusters) {
    sizes.push_back(c.grains);
    hyperstatic += c.hyperstatic > 0;
    spanning += c.spans[0] || c.spans[1] || c.spans[2];
    Json spans = Json::array();
    for (std::size_t k = 0; k < kAxes; ++k) spans.push_back(c.spans[k]);
    list.push_back({{"grains", c.grains}, {"links", c.links}, {"H", c.hyperstatic}, {"spans", spans}});
  }
  std::int64_t alone = 0;
  if (input.triangles) {
    std::set<std::int32_t> members, all;
    const OwnedNetwork& n = input.triangle_links;
    for (std::size_t b = 0; b < idx(n.free); ++b) {
      all.insert(n.grain[b]);
      if (found.cluster_of_grain[b] >= 0) members.insert(n.grain[b]);
    }
    alone = static_cast<std::int64_t>(all.size() - members.size());
  } else {
    for (std::size_t i = 0; i < idx(network.free); ++i) alone += found.cluster_of_grain[i] < 0;
  }
  return Json{{"sizes", sizes},
              {"hyperstatic", hyperstatic},
              {"largest", found.clusters.empty() ? 0 : found.clusters[0].grains},
              {"spanning", spanning},
              {"single_grains", alone},
              {"list", list}};
}

template <class Network>
std::vector<Table> clusters_tables_of(const Network& network, const AnalysisInput& input,
                                      const AnalysisOptions& options) {
  constexpr std::size_t kAxes = std::is_same_v<Network, SphereNetwork> ? 3 : 2;
  const auto& packing = network.packing;
  const RigidClusters found = rigid_clusters(network, input.network_law(options), options.cell_free);
  Table grains{"clusters.grains", {"id", "cluster"}, {}};
  for (std::size_t i = 0; i < idx(network.free); ++i)
    grains.rows.push_back({static_cast<double>(packing.bodies.id[i]), static_cast<double>(found.cluster_of_grain[i])});
  Table links{"clusters.links", {"i", "j", "s1", "s2", "cluster"}, {}};
  if (kAxes == 3) links.columns.insert(links.columns.end() - 1, "s3");
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const auto& link = packing.links[l];
    std::vector<double> line{static_cast<double>(packing.bodies.id[static_cast<std::size_t>(link.i)]),
                             static_cast<double>(packing.bodies.id[static_cast<std::size_t>(link.j)])};
    for (std::size_t k = 0; k < kAxes; ++k) line.push_back(link.shift[k]);
    line.push_back(found.cluster_of_link[l]);
    links.rows.push_back(std::move(line));
  }
  if (!input.triangles) return {grains, links};
  Table overlaps{"clusters.overlaps", {"grain_i", "grain_j", "s1", "s2", "cluster"}, {}};
  const auto& id = input.triangles->packing.grains.id;
  for (std::size_t a = 0; a < input.triangle_links.areas.size(); ++a) {
    const AreaLink& area = input.triangle_links.areas[a];
    overlaps.rows.push_back({static_cast<double>(id[idx(area.grain_i)]), static_cast<double>(id[idx(area.grain_j)]),
                             static_cast<double>(area.shift[0]), static_cast<double>(area.shift[1]),
                             static_cast<double>(found.cluster_of_link[packing.links.size() + a])});
  }
  return {grains, links, overlaps};
}

}  // namespace

Json rigidity_section(const AnalysisInput& input, const AnalysisOptions& options) {
  return input.packing_3d ? rigidity_of(input.spheres(), input, options) : rigidity_of(input.network(), input, options);
}
Json clusters_section(const AnalysisInput& input, const AnalysisOptions& options) {
  return input.packing_3d ? clusters_of(input.spheres(), input, options) : clusters_of(input.network(), input, options);
}
std::vector<Table> clusters_tables(const AnalysisInput& input, const AnalysisOptions& options) {
  return input.packing_3d ? clusters_tables_of(input.spheres(), input, options)
                          : clusters_tables_of(input.network(), input, options);
}

}  // namespace isostat
