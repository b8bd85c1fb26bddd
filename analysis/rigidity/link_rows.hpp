// Which rows of G a link has, and where the degrees of freedom of a body stand. One table for G, for exact rank and
// for stiffness. Gilabert 2007, Appendix A: relative motions that a force or moment is conjugate to.
#pragma once
#include <cstdint>

#include "analysis/input.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

struct LinkRows {
  bool normal = true, tangential = false, moment = false;
  int count() const { return 1 + tangential + moment; }
};

//            c        s      r     sr   d
// frictionless: N in all
// friction     N T      N      N T   N    N
// rolling      N T M    N M    N T   N    N
constexpr LinkRows rows_of(LinkKind kind, NetworkLaw law) {
  if (law == NetworkLaw::frictionless || kind == LinkKind::distant || kind == LinkKind::both_yielded) return {};
  LinkRows rows;
  rows.tangential = kind != LinkKind::sliding;
  rows.moment = law == NetworkLaw::rolling && kind != LinkKind::rolling_yielded;
  return rows;
}

// Columns of G: body i has columns [i * per_body, (i + 1) * per_body): vx, vy and, with friction, the spin; a free cell
// adds the two strain rates e_1, e_2 (compression positive) at the end. Velocities are peculiar (Eq. A1).
struct DofLayout {
  int per_body = 3;
  std::int64_t bodies = 0;
  int strains = 0;
  std::int64_t size() const { return per_body * bodies + strains; }
  std::int64_t strain_column(int axis) const { return per_body * bodies + axis; }
};

inline DofLayout dof_layout(std::size_t bodies, NetworkLaw law, bool cell_free) {
  return {law == NetworkLaw::frictionless ? 2 : 3, static_cast<std::int64_t>(bodies), cell_free ? 2 : 0};
}

inline std::int64_t row_count(const Packing<2>& packing, NetworkLaw law) {
  std::int64_t m = 0;
  for (const Link<2>& link : packing.links) m += rows_of(link.kind, law).count();
  return m;
}

}  // namespace isostat
