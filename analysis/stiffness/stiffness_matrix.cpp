#include "analysis/stiffness/stiffness_matrix.hpp"

#include <algorithm>
#include <limits>
#include <new>

#include "dem/disks/at_rest.hpp"
#include "dem/input_error.hpp"
#include "dem/state/beam.hpp"
#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

DiskLaw default_network_law() { return resolve(LawScene{}); }

ByRow<double> link_stiffness(const Packing<2>& packing, const Link<2>& link, const DiskLaw& law) {
  if (link.kind == LinkKind::beam) {
    const Beam& beam = packing.beams[idx(link.beam)];
    const BeamStiffness k = beam_stiffness(beam, norm(ends(packing, link).branch));
    return {k.normal, k.tangential, k.rolling};
  }
  if (link.kind != LinkKind::distant)
    return {contact(law, link.gap).stiffness, law.tangential_stiffness, law.rolling_stiffness};
  if (!(law.attraction_range > 0))
    throw InputError("network", 0, "contact.TYPE", "d",
                     "a distant link has a stiffness only under a law with attraction");
  return {distant(law, link.gap).stiffness, 0, 0};
}

std::vector<double> row_stiffness(const LinkNetwork& network, const RigidityMatrix& g, const DiskLaw& law) {
  std::vector<double> k(idx(g.rows()));
  for (std::size_t r = 0; r < k.size(); ++r) {
    const auto l = idx(g.link_of_row[r]);
    if (network.is_area(l))
      k[r] = ByRow<double>{network.area(l).stiffness, network.area(l).tangential_stiffness, 0}[g.kind[r]];
    else
      k[r] = link_stiffness(network.packing, network.packing.links[l], law)[g.kind[r]];
  }
  return k;
}

SymmetricMatrix weighted_normal_matrix(const RigidityMatrix& g, const std::vector<double>& weight) {
  SymmetricMatrix a;
  const auto n = idx(g.columns());
  if (n > idx(std::numeric_limits<std::int32_t>::max())) throw std::bad_alloc();
  a.size = static_cast<std::int32_t>(n);

  // Entries bucketed by column, then sorted and summed within each: every row of G is a small dense block.
  std::vector<std::int64_t> start(n + 1, 0);
  for (std::size_t r = 0; r < weight.size(); ++r)
    for (std::int64_t e = g.row_start[r]; e < g.row_start[r + 1]; ++e)
      start[idx(g.column[idx(e)]) + 1] += g.row_start[r + 1] - e;
  for (std::size_t c = 0; c < n; ++c) start[c + 1] += start[c];
  std::vector<std::pair<std::int32_t, double>> entries(idx(start[n]));
  std::vector<std::int64_t> next(start.begin(), start.end() - 1);
  for (std::size_t r = 0; r < weight.size(); ++r)
    for (std::int64_t e = g.row_start[r]; e < g.row_start[r + 1]; ++e) {
      const auto c = idx(g.column[idx(e)]);
      const double w = weight[r] * g.value[idx(e)];
      for (std::int64_t f = e; f < g.row_start[r + 1]; ++f)  // columns ascend within a row
        entries[idx(next[c]++)] = {static_cast<std::int32_t>(g.column[idx(f)]), w * g.value[idx(f)]};
    }
  a.start.push_back(0);
  for (std::size_t c = 0; c < n; ++c) {
    const auto first = entries.begin() + start[c], last = entries.begin() + start[c + 1];
    std::stable_sort(first, last, [](const auto& x, const auto& y) { return x.first < y.first; });
    for (auto e = first; e != last; ++e) {
      if (!a.row.empty() && static_cast<std::int32_t>(a.row.size()) > a.start.back() && a.row.back() == e->first)
        a.value.back() += e->second;
      else
        a.row.push_back(e->first), a.value.push_back(e->second);
    }
    a.start.push_back(static_cast<std::int32_t>(a.row.size()));
  }
  return a;
}

}  // namespace isostat
