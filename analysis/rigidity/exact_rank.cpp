#include "analysis/rigidity/exact_rank.hpp"

#include <algorithm>
#include <numeric>

#include "analysis/rigidity/reduced_problem.hpp"
#include "dem/input_error.hpp"
#include "dem/solver/clocks.hpp"
#include "geometry/base/index.hpp"
#include "geometry/union_find.hpp"

namespace isostat {
namespace {

constexpr std::uint64_t kWeightSeed = 0x150574A7;

// Dimension of the null space of the reduced rows, with pruned and free bodies counted back in.
template <class G, class Network>
std::int64_t null_dimension(const ReducedProblem<FirstField, Network>& problem,
                            const Rows<G, kMostDofs<Network>>& rows) {
  const std::int64_t unknowns = static_cast<std::int64_t>(problem.bodies.count) * problem.per_body +
                                (problem.strain_node() >= 0 ? kDimension<Network> : 0);
  for (std::uint64_t attempt = 0;; ++attempt) {
    try {
      const ModularLdlt<G> ldlt(problem.tree, problem.dofs, problem.node_rows(rows), kWeightSeed + attempt, false);
      return unknowns - problem.network.pruned_rank - ldlt.rank();
    } catch (const RandomizationFailed&) {
      if (attempt == 3) throw;  // chance below 1e-40
    }
  }
}

// Of triangles: rigid motions of the whole, where no wall hinders them, and of whatever beams hold together (a grain,
// as a rule) that no overlap touches.
void count_null_spaces_of_triangles(const LinkNetwork& network, ExactRank& r) {
  UnionFind joined(network.packing.bodies.size());
  for (const Link<2>& l : network.packing.links) joined.join(idx(l.i), idx(l.j));
  std::vector<char> touched(network.packing.bodies.size(), 0);
  for (std::size_t b = idx(network.free); b < touched.size(); ++b) touched[joined.find(b)] = 1;
  for (const AreaLink& a : network.areas)
    for (const AreaPair& pair : a.pairs) touched[joined.find(idx(pair.i))] = touched[joined.find(idx(pair.j))] = 1;
  std::int64_t pieces = 0, rattlers = 0;
  for (std::size_t b = 0; b < touched.size(); ++b)
    if (joined.find(b) == b) ++pieces, rattlers += !touched[b];
  r.trivial = network.any_held() ? 0 : network.packing.cell ? 2 : 3;
  r.rattler_modes = rattlers == pieces ? 3 * pieces - r.trivial : 3 * rattlers;
  r.mechanisms = r.floppy - r.trivial - r.rattler_modes;
}

void count_null_spaces(const LinkNetwork& network, NetworkLaw law, ExactRank& r) {
  if (network.of_triangles()) return count_null_spaces_of_triangles(network, r);
  const Packing<2>& packing = network.packing;
  std::vector<char> linked(packing.bodies.size(), 0);
  for (const Link<2>& link : packing.links)
    linked[static_cast<std::size_t>(link.i)] = linked[static_cast<std::size_t>(link.j)] = 1;
  const std::int64_t n = network.free;
  const std::int64_t rattlers = n - std::count(linked.begin(), linked.begin() + n, 1);
  const std::int64_t per_body = dof_layout(network, law, false).per_body;
  // Isolated: two translations and a rotation; of one point: the translations. None where walls stand.
  r.trivial = network.any_held() ? 0 : packing.cell ? 2 : std::min<std::int64_t>(3, n * per_body);
  r.rattler_modes = rattlers == n ? n * per_body - r.trivial : rattlers * per_body;
  r.mechanisms = r.floppy - r.trivial - r.rattler_modes;
}

// Points with links (of a network without any: all) on one line turn about it without moving.
bool collinear(const SphereNetwork& network, const std::vector<char>& linked) {
  using F = FirstField;
  const SphereGeometry<F> g = exact_geometry<F>(network);
  const auto first = static_cast<std::size_t>(std::find(linked.begin(), linked.end(), 1) - linked.begin());
  const bool all = first == linked.size();
  const Real3<F>& origin = g.position[all ? 0 : first];
  Real3<F> line{};
  for (std::size_t k = 0; k < g.position.size(); ++k) {
    if (!all && !linked[k]) continue;
    const Real3<F> arm = difference_3d<F>(g.position[k], origin);
    if (line == Real3<F>{})
      line = arm;
    else if (cross_3d<F>(arm, line) != Real3<F>{})
      return false;
  }
  return true;
}

void count_null_spaces(const SphereNetwork& network, NetworkLaw law, ExactRank& r) {
  const std::int64_t n = network.free, per_body = dof_layout(network, law, false).per_body;
  std::vector<char> linked(network.packing.bodies.size(), 0);
  for (const Link<3>& link : network.packing.links) linked[idx(link.i)] = linked[idx(link.j)] = 1;
  const std::int64_t rattlers = n - std::count(linked.begin(), linked.begin() + n, 1);
  if (network.any_held() || n == 0)
    r.trivial = 0;
  else if (network.packing.cell)
    r.trivial = 3;
  else if (law != NetworkLaw::frictionless)
    r.trivial = 6;
  else
    r.trivial = n == 1 ? 3 : collinear(network, linked) ? 5 : 6;
  r.rattler_modes = rattlers == n ? n * per_body - r.trivial : rattlers * per_body;
  r.mechanisms = r.floppy - r.trivial - r.rattler_modes;
}

template <class Network>
ExactRank rank_of(const Network& network, NetworkLaw law, bool cell_free) {
  if (cell_free && !network.packing.cell)
    throw InputError("command line", 0, "--cell", "free", "the input has no cell");
  ExactRank r;
  r.dofs = dof_layout(network, law, cell_free).size();
  r.rows = row_count(network, law);

  const auto problem = reduce_problem<FirstField>(network, law, cell_free);
  r.bodies = problem.bodies.count;
  for (std::int8_t d : problem.dofs) r.eliminated_columns += d;
  r.timings.contraction = problem.contraction_seconds;
  r.timings.assembly = problem.assembly_seconds;
  r.timings.ordering = problem.ordering_seconds;

  const double start = wall_seconds();
  r.floppy = null_dimension(problem, problem.rows);
  r.primes = {FirstField::kPrime};
  r.floppy_generic = null_dimension(
      problem, body_rows(network, law, cell_free, problem.bodies, random_geometry<SecondField>(network, kWeightSeed)));
  r.bounds_meet = r.floppy_generic == r.floppy;
  r.certified = r.bounds_meet;
  if (!r.bounds_meet) {
    const std::int64_t second = null_dimension(
        problem, body_rows(network, law, cell_free, problem.bodies, exact_geometry<SecondField>(network)));
    r.certified = second == r.floppy && r.floppy_generic <= r.floppy;
    if (second == r.floppy)
      r.primes.push_back(SecondField::kPrime);
    else if (second < r.floppy)
      r.floppy = second, r.primes = {SecondField::kPrime};  // the smaller K is nearer
  }
  r.timings.elimination = wall_seconds() - start;

  r.rank = r.dofs - r.floppy;
  r.hyperstatic = r.rows - r.rank;
  count_null_spaces(network, law, r);
  r.gear_modes = static_cast<std::int64_t>(gear_components(network, law).size()) * (kDimension<Network> == 2 ? 1 : 3);
  return r;
}

template <class Network>
std::vector<std::vector<std::int32_t>> gears_of(const Network& network, NetworkLaw law) {
  const auto& packing = network.packing;
  // Union-find with parity: side[i] is the colour of i relative to its root.
  const std::size_t n = packing.bodies.size();
  std::vector<std::int32_t> parent(n);
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<char> side(n, 0), spoiled(n, 0), loop(n, 0);
  std::fill(spoiled.begin() + network.free, spoiled.end(), char{1});  // walls do not turn
  const auto find = [&](std::int32_t i) {
    std::int32_t root = i;
    char parity = 0;
    while (parent[static_cast<std::size_t>(root)] != root)
      parity ^= side[static_cast<std::size_t>(root)], root = parent[static_cast<std::size_t>(root)];
    char rest = parity;
    while (parent[static_cast<std::size_t>(i)] != root && i != root) {
      const std::int32_t next = parent[static_cast<std::size_t>(i)];
      const char step = side[static_cast<std::size_t>(i)];
      parent[static_cast<std::size_t>(i)] = root, side[static_cast<std::size_t>(i)] = rest;
      rest ^= step;
      i = next;
    }
    return std::pair{static_cast<std::size_t>(root), parity};
  };
  for (const auto& link : packing.links) {
    const LinkRows rows = rows_of(link.kind, law);
    if (!rows.tangential && !rows.rolling) continue;
    const auto [a, side_a] = find(link.i);
    const auto [b, side_b] = find(link.j);
    if (a == b) {
      loop[a] = 1;
      if (side_a == side_b) spoiled[a] = 1;
    } else {
      parent[b] = static_cast<std::int32_t>(a);
      side[b] = static_cast<char>(side_a ^ side_b ^ 1);
      spoiled[a] = spoiled[a] | spoiled[b];
      loop[a] = loop[a] | loop[b];
    }
    if (rows.rolling) spoiled[find(link.i).first] = 1;
  }
  std::vector<std::vector<std::int32_t>> components;
  std::vector<std::int32_t> index(n, -1);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t root = find(static_cast<std::int32_t>(i)).first;
    if (spoiled[root] || !loop[root]) continue;
    if (index[root] < 0) index[root] = static_cast<std::int32_t>(components.size()), components.emplace_back();
    components[static_cast<std::size_t>(index[root])].push_back(static_cast<std::int32_t>(i));
  }
  return components;
}

}  // namespace

ExactRank exact_rank(const LinkNetwork& network, NetworkLaw law, bool cell_free) {
  return rank_of(network, law, cell_free);
}
ExactRank exact_rank(const SphereNetwork& network, NetworkLaw law, bool cell_free) {
  return rank_of(network, law, cell_free);
}
std::vector<std::vector<std::int32_t>> gear_components(const LinkNetwork& network, NetworkLaw law) {
  return gears_of(network, law);
}
std::vector<std::vector<std::int32_t>> gear_components(const SphereNetwork& network, NetworkLaw law) {
  return gears_of(network, law);
}

}  // namespace isostat
