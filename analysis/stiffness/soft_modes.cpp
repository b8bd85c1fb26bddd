#include "analysis/stiffness/soft_modes.hpp"

#include <cmath>
#include <numeric>

#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/stiffness/lowest_modes.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"

namespace isostat {
namespace {

constexpr double kSoftestSquare = 1e-13;  // of |G^T G|: to 3e-7 of the largest singular value

}  // namespace

std::vector<double> smallest_singular_values(const Packing<2>& packing, NetworkLaw law, bool cell_free, int count) {
  const RigidityMatrix g = rigidity_matrix(packing, law, cell_free);
  const auto& radius = packing.bodies.radius;
  const double mean_radius = std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
  std::vector<double> weight(static_cast<std::size_t>(g.rows()), 1.0), scale;
  for (std::size_t r = 0; r < weight.size(); ++r)
    if (g.kind[r] == RowKind::rolling) weight[r] = mean_radius * mean_radius;
  for (double r : radius) {
    scale.insert(scale.end(), {1.0, 1.0});
    if (g.layout.per_body == 3) scale.push_back(r * r);
  }
  for (int a = 0; a < g.layout.strains; ++a) scale.push_back(packing.cell->length[a] * packing.cell->length[a]);
  const LowestModes modes = lowest_modes(weighted_normal_matrix(g, weight), dependent_columns(packing, law, cell_free),
                                         scale, count, true, false, kSoftestSquare);
  std::vector<double> sigma;
  for (double lambda : modes.value) sigma.push_back(std::sqrt(std::max(lambda, 0.0)));
  return sigma;
}

}  // namespace isostat
