#include "analysis/stiffness/stiffness_matrix.hpp"

#include <algorithm>
#include <limits>
#include <new>

#include "dem/input_error.hpp"

namespace isostat {

DiskLaw default_network_law() { return resolve(LawScene{}); }

std::vector<double> row_stiffness(const Packing<2>& packing, const RigidityMatrix& g, const DiskLaw& law) {
  const ByRow<double> contact = {law.normal_stiffness, law.tangential_stiffness, law.rolling_stiffness};
  std::vector<double> k(static_cast<std::size_t>(g.rows()));
  for (std::size_t r = 0; r < k.size(); ++r) {
    const bool distant = packing.links[static_cast<std::size_t>(g.link_of_row[r])].kind == LinkKind::distant;
    if (distant && !(law.attraction_range > 0))
      throw InputError("network", 0, "contact.TYPE", "d",
                       "a distant link has a stiffness only under a law with attraction");
    k[r] = distant ? -law.attraction / law.attraction_range : contact[g.kind[r]];
  }
  return k;
}

SymmetricMatrix weighted_normal_matrix(const RigidityMatrix& g, const std::vector<double>& weight) {
  SymmetricMatrix a;
  const auto n = static_cast<std::size_t>(g.columns());
  if (n > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) throw std::bad_alloc();
  a.size = static_cast<std::int32_t>(n);

  // Entries bucketed by column, then sorted and summed within each: every row of G is a small dense block.
  std::vector<std::int64_t> start(n + 1, 0);
  for (std::size_t r = 0; r < weight.size(); ++r)
    for (std::int64_t e = g.row_start[r]; e < g.row_start[r + 1]; ++e)
      start[static_cast<std::size_t>(g.column[static_cast<std::size_t>(e)]) + 1] += g.row_start[r + 1] - e;
  for (std::size_t c = 0; c < n; ++c) start[c + 1] += start[c];
  std::vector<std::pair<std::int32_t, double>> entries(static_cast<std::size_t>(start[n]));
  std::vector<std::int64_t> next(start.begin(), start.end() - 1);
  for (std::size_t r = 0; r < weight.size(); ++r)
    for (std::int64_t e = g.row_start[r]; e < g.row_start[r + 1]; ++e) {
      const auto c = static_cast<std::size_t>(g.column[static_cast<std::size_t>(e)]);
      const double w = weight[r] * g.value[static_cast<std::size_t>(e)];
      for (std::int64_t f = e; f < g.row_start[r + 1]; ++f)  // columns ascend within a row
        entries[static_cast<std::size_t>(next[c]++)] = {
            static_cast<std::int32_t>(g.column[static_cast<std::size_t>(f)]), w * g.value[static_cast<std::size_t>(f)]};
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
