#include "analysis/stiffness/bases.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "analysis/rigidity/clusters.hpp"
#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/rigidity/link_rows_3d.hpp"
#include "analysis/rigidity/part_of_packing.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/stiffness/pseudo_inverse.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "analysis/vector_algebra.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Vector = std::vector<double>;

NullVector scaled(Vector v) {
  const double m = largest(v);
  if (m > 0)
    for (double& x : v) x /= m;
  return {std::move(v), 0};
}

template <class Network>
PseudoInverse normal_inverse(const Network& network, NetworkLaw law, bool cell_free, const RigidityMatrix& g) {
  return PseudoInverse(weighted_normal_matrix(g, Vector(idx(g.rows()), 1.0)),
                       dependent_columns(network, law, cell_free), SparseCholesky::Form::definite);
}

// f - G (G^T G)^+ G^T f, twice: the second pass removes what rounding left of the first.
Vector project_to_self_stress(const RigidityMatrix& g, const PseudoInverse& inverse, Vector f) {
  for (int pass = 0; pass < 2; ++pass) {
    const Vector balanced = g.link_velocities(inverse.solve(g.body_forces(f)));
    for (std::size_t r = 0; r < f.size(); ++r) f[r] -= balanced[r];
  }
  return f;
}

// Orthonormal states of `packing`, up to `wanted`, orthogonal to those in `known`: unit forces projected, kept when a
// share of their length survives. The number to be found is exact, the share only picks which unit forces are used.
template <class Network>
std::vector<Vector> independent_states(const Network& network, NetworkLaw law, bool cell_free, std::size_t wanted,
                                       std::vector<Vector> known) {
  constexpr double kShare[] = {0.1, 1e-3, 1e-6};
  const RigidityMatrix g = rigidity_matrix(network, law, cell_free);
  const PseudoInverse inverse = normal_inverse(network, law, cell_free, g);
  std::vector<Vector> found;
  for (const double share : kShare)
    for (std::size_t r = 0; r < idx(g.rows()) && found.size() < wanted; ++r) {
      Vector f(idx(g.rows()), 0.0);
      f[r] = 1;
      f = project_to_self_stress(g, inverse, std::move(f));
      for (int pass = 0; pass < 2; ++pass)
        for (const auto* list : {&known, &found})
          for (const Vector& q : *list) {
            const double c = dot(q, f);
            for (std::size_t k = 0; k < f.size(); ++k) f[k] -= c * q[k];
          }
      const double length = std::sqrt(dot(f, f));
      if (length < share) continue;
      for (double& x : f) x /= length;
      found.push_back(std::move(f));
    }
  return found;
}

// Clusters of points can share a link: takes the part along `known` away. False if nothing is left.
bool stands_alone(Vector& f, const std::vector<Vector>& known) {
  constexpr double kLeft = 1e-6;  // of its length, which was 1
  for (int pass = 0; pass < 2; ++pass)
    for (const Vector& q : known)
      if (const double c = dot(q, f); c != 0)
        for (std::size_t k = 0; k < f.size(); ++k) f[k] -= c * q[k];
  const double length = std::sqrt(dot(f, f));
  if (length < kLeft) return false;
  for (double& x : f) x /= length;
  return true;
}

template <class Network>
std::vector<NullVector> floppy_modes_of(const Network& network, NetworkLaw law, bool cell_free, std::size_t most) {
  const RigidityMatrix g = rigidity_matrix(network, law, cell_free);
  const std::vector<char> dependent = dependent_columns(network, law, cell_free);
  const PseudoInverse inverse = normal_inverse(network, law, cell_free, g);
  std::vector<NullVector> modes;
  for (std::size_t c = 0; c < dependent.size() && modes.size() < most; ++c) {
    if (!dependent[c]) continue;
    modes.push_back(scaled(inverse.null_vector(c)));
    modes.back().residual = largest(g.link_velocities(modes.back().value));
  }
  return modes;
}

template <class Network>
std::vector<NullVector> self_stress_states_of(const Network& network, NetworkLaw law, bool cell_free,
                                              std::size_t most) {
  const auto total = idx(exact_rank(network, law, cell_free).hyperstatic);
  const std::size_t wanted = std::min(most, total);
  const RigidityMatrix g = rigidity_matrix(network, law, cell_free);
  std::vector<std::size_t> first_row(network.links() + 1, idx(g.rows()));
  for (std::size_t r = idx(g.rows()); r-- > 0;) first_row[idx(g.link_of_row[r])] = r;

  const RigidClusters clusters = rigid_clusters(network, law, cell_free);
  std::vector<Vector> states;
  for (std::size_t c = 0; c < clusters.clusters.size() && states.size() < wanted; ++c) {
    if (clusters.clusters[c].hyperstatic <= 0) continue;
    const std::vector<std::int32_t>& links = clusters.links[c];
    std::vector<std::size_t> row_of;  // row of the part -> row of the whole
    for (const std::int32_t l : links)
      for (int k = 0; k < rows_of(network, idx(l), law).count(); ++k) row_of.push_back(first_row[idx(l)] + idx(k));
    const auto part = part_of(network, {}, links);
    const auto here = std::min(wanted - states.size(), idx(clusters.clusters[c].hyperstatic));
    for (const Vector& f : independent_states(part.view(), law, cell_free, here, {})) {
      Vector whole(idx(g.rows()), 0.0);
      for (std::size_t r = 0; r < f.size(); ++r) whole[row_of[r]] = f[r];
      if (std::is_same_v<Network, LinkNetwork> || stands_alone(whole, states)) states.push_back(std::move(whole));
    }
  }
  if (states.size() < wanted)
    for (Vector& f : independent_states(network, law, cell_free, wanted - states.size(), states))
      states.push_back(std::move(f));

  std::vector<NullVector> result;
  for (Vector& f : states) {
    result.push_back(scaled(std::move(f)));
    result.back().residual = largest(g.body_forces(result.back().value));
  }
  return result;
}

template <class Network>
ForceSplit split_forces_of(const Network& network, NetworkLaw law, bool cell_free, const std::vector<double>& forces) {
  const RigidityMatrix g = rigidity_matrix(network, law, cell_free);
  const PseudoInverse inverse = normal_inverse(network, law, cell_free, g);
  ForceSplit split;
  split.self_stress = project_to_self_stress(g, inverse, forces);
  split.balancing = forces;
  for (std::size_t r = 0; r < forces.size(); ++r) split.balancing[r] -= split.self_stress[r];
  split.residual = largest(g.body_forces(split.self_stress));
  return split;
}

}  // namespace

std::vector<NullVector> floppy_modes(const LinkNetwork& network, NetworkLaw law, bool cell_free, std::size_t most) {
  return floppy_modes_of(network, law, cell_free, most);
}
std::vector<NullVector> floppy_modes(const SphereNetwork& network, NetworkLaw law, bool cell_free, std::size_t most) {
  return floppy_modes_of(network, law, cell_free, most);
}
std::vector<NullVector> self_stress_states(const LinkNetwork& network, NetworkLaw law, bool cell_free,
                                           std::size_t most) {
  return self_stress_states_of(network, law, cell_free, most);
}
std::vector<NullVector> self_stress_states(const SphereNetwork& network, NetworkLaw law, bool cell_free,
                                           std::size_t most) {
  return self_stress_states_of(network, law, cell_free, most);
}
ForceSplit split_forces(const LinkNetwork& network, NetworkLaw law, bool cell_free, const std::vector<double>& forces) {
  return split_forces_of(network, law, cell_free, forces);
}
ForceSplit split_forces(const SphereNetwork& network, NetworkLaw law, bool cell_free,
                        const std::vector<double>& forces) {
  return split_forces_of(network, law, cell_free, forces);
}

}  // namespace isostat
