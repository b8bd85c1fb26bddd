#include "analysis/stiffness/soft_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/stiffness/lowest_modes.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"

namespace isostat {
namespace {

constexpr double kSoftestSquare = 1e-13;  // of |G^T G|: to 3e-7 of the largest singular value

// Of the force on a body: a unit pressure acts on a length.
double largest_square(const RigidityMatrix& g, std::size_t row) {
  double largest = 0;
  for (auto e = static_cast<std::size_t>(g.row_start[row]); e + 1 < static_cast<std::size_t>(g.row_start[row + 1]); ++e)
    if (g.column[e] % 3 == 0 && g.column[e] < g.layout.strain_column(0))
      largest = std::max(largest, g.value[e] * g.value[e] + g.value[e + 1] * g.value[e + 1]);
  return largest > 0 ? largest : 1;
}

double area_weight(const LinkNetwork& network, const RigidityMatrix& g, std::size_t row) {
  return network.is_area(static_cast<std::size_t>(g.link_of_row[row])) ? 1 / largest_square(g, row) : 1;
}
double area_weight(const SphereNetwork&, const RigidityMatrix&, std::size_t) { return 1; }

template <class Network>
std::vector<double> singular_values(const Network& network, NetworkLaw law, bool cell_free, int count) {
  const auto& packing = network.packing;
  constexpr std::size_t kSpace = std::is_same_v<Network, SphereNetwork> ? 3 : 2;
  const RigidityMatrix g = rigidity_matrix(network, law, cell_free);
  const auto& radius = packing.bodies.radius;
  const double mean_radius = std::accumulate(radius.begin(), radius.begin() + network.free, 0.0) / network.free;
  std::vector<double> weight(static_cast<std::size_t>(g.rows()), 1.0), scale;
  for (std::size_t r = 0; r < weight.size(); ++r)
    weight[r] = g.kind[r] == RowKind::rolling ? mean_radius * mean_radius : area_weight(network, g, r);
  for (std::size_t b = 0; b < static_cast<std::size_t>(network.free); ++b) {
    const double r = radius[b];
    scale.insert(scale.end(), kSpace, 1.0);
    scale.insert(scale.end(), static_cast<std::size_t>(g.layout.per_body) - kSpace, r * r);
  }
  for (int a = 0; a < g.layout.strains; ++a) scale.push_back(packing.cell->length[a] * packing.cell->length[a]);
  const LowestModes modes = lowest_modes(weighted_normal_matrix(g, weight), dependent_columns(network, law, cell_free),
                                         scale, count, true, false, kSoftestSquare);
  std::vector<double> sigma;
  for (double lambda : modes.value) sigma.push_back(std::sqrt(std::max(lambda, 0.0)));
  return sigma;
}

}  // namespace

std::vector<double> smallest_singular_values(const LinkNetwork& network, NetworkLaw law, bool cell_free, int count) {
  return singular_values(network, law, cell_free, count);
}
std::vector<double> smallest_singular_values(const SphereNetwork& network, NetworkLaw law, bool cell_free, int count) {
  return singular_values(network, law, cell_free, count);
}

}  // namespace isostat
