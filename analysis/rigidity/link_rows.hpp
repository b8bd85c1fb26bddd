// Which rows of G a link has, and where the degrees of freedom of a body stand. One table for G, for exact rank and
// for stiffness. Gilabert 2007, Appendix A: relative motions that a force or moment is conjugate to.
#pragma once
#include <array>
#include <cstdint>

#include "analysis/input.hpp"
#include "dem/state/link.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

// What a row of G measures, and which link force is conjugate to it.
enum class RowKind : std::int8_t { normal, tangential, rolling };
inline constexpr std::array kRowKinds = {RowKind::normal, RowKind::tangential, RowKind::rolling};  // as within a link

// One value for each kind of row.
template <class T>
struct ByRow {
  T normal{}, tangential{}, rolling{};
  constexpr const T& operator[](RowKind kind) const {
    return kind == RowKind::normal ? normal : kind == RowKind::tangential ? tangential : rolling;
  }
  constexpr T& operator[](RowKind kind) {
    return kind == RowKind::normal ? normal : kind == RowKind::tangential ? tangential : rolling;
  }
};

struct LinkRows : ByRow<bool> {
  constexpr int count() const { return normal + tangential + rolling; }
};

//            c        s      r     sr   d    b (beam)
// frictionless N        N      N     N    N    N T M
// friction     N T      N      N T   N    N    N T M
// rolling      N T M    N M    N T   N    N    N T M
constexpr LinkRows rows_of(LinkKind kind, NetworkLaw law) {
  LinkRows rows{{true, false, false}};
  if (kind == LinkKind::beam) return {{true, true, true}};
  if (law == NetworkLaw::frictionless || kind == LinkKind::distant || kind == LinkKind::both_yielded) return rows;
  rows.tangential = kind != LinkKind::sliding;
  rows.rolling = law == NetworkLaw::rolling && kind != LinkKind::rolling_yielded;
  return rows;
}

// A row of G is the load of a unit link force: in doubles, and for exact fields times a positive factor (link.hpp).
template <class Real>
LinkLoad<Real> unit_load(RowKind kind, const LinkFrame<Real>& frame) {
  const auto one = [&](RowKind of) { return Real(kind == of); };
  return link_load(frame, one(RowKind::normal), one(RowKind::tangential), one(RowKind::rolling));
}
template <class F>
LinkLoad<F> rational_load(RowKind kind, const std::array<F, 2>& branch, F radius_i, F radius_j) {
  switch (kind) {
    case RowKind::normal:
      return rational_normal(branch[0], branch[1]);
    case RowKind::tangential:
      return rational_tangential(branch[0], branch[1], radius_i, radius_j);
    case RowKind::rolling:
      break;
  }
  return rational_rolling<F>();
}

// Columns of G: body i has columns [i * per_body, (i + 1) * per_body): vx, vy and, with friction or where there are
// beams, the spin; a free cell adds the two strain rates e_1, e_2 (compression positive) at the end. Velocities are
// peculiar (Eq. A1). Held bodies come last and have no columns.
struct DofLayout {
  int per_body = 3;
  std::int64_t bodies = 0;  // that are free
  int strains = 0;
  std::int64_t size() const { return per_body * bodies + strains; }
  std::int64_t strain_column(int axis) const { return per_body * bodies + axis; }
};

inline DofLayout dof_layout(const LinkNetwork& network, NetworkLaw law, bool cell_free) {
  const bool points = law == NetworkLaw::frictionless && network.packing.beams.empty() && !network.of_triangles();
  return {points ? 2 : 3, network.free, cell_free ? 2 : 0};
}

// An overlap has a normal row, its area, and with friction a tangential one.
constexpr LinkRows rows_of_area(NetworkLaw law) { return {{true, law != NetworkLaw::frictionless, false}}; }
inline LinkRows rows_of(const LinkNetwork& network, std::size_t link, NetworkLaw law) {
  return network.is_area(link) ? rows_of_area(law) : rows_of(network.packing.links[link].kind, law);
}

inline std::int64_t row_count(const LinkNetwork& network, NetworkLaw law) {
  std::int64_t m = 0;
  for (std::size_t l = 0; l < network.links(); ++l) m += rows_of(network, l, law).count();
  return m;
}

}  // namespace isostat
