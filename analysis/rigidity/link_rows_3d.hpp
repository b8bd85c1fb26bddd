// Which rows of G a link of two spheres has. The rational form is that of DESIGN, "Exactness in 3D": a contact with
// friction has the three Cartesian components of the velocity at the contact point (kind `tangential`, axes 0 to 2), of
// which n . v_c is a combination, so that no row needs a root; a link without friction has its normal row alone;
// rolling resistance adds the three components of w_j - w_i: it resists rolling and twisting.
#pragma once
#include <array>
#include <cstdint>

#include "analysis/rigidity/link_rows.hpp"
#include "analysis/sphere_network.hpp"
#include "dem/state/link_3d.hpp"

namespace isostat {

struct SphereRow {
  RowKind kind = RowKind::normal;
  int axis = 0;
};

struct SphereRows {
  bool normal = false, contact = false, rolling = false;  // one row, or three each
  constexpr int count() const { return normal + 3 * contact + 3 * rolling; }
  constexpr SphereRow at(int k) const {  // 0 <= k < count()
    const int first = normal ? 1 : 3;
    if (k >= first) return {RowKind::rolling, k - first};
    return {normal ? RowKind::normal : RowKind::tangential, normal ? 0 : k};
  }
};

//            c        s      r     sr   d       C: three contact rows, in place of N
// frictionless N        N      N     N    N
// friction     C        N      C     N    N
// rolling      C M      N M    C     N    N
constexpr SphereRows sphere_rows(LinkKind kind, NetworkLaw law) {
  const LinkRows plane = rows_of(kind, law);
  return {!plane.tangential, plane.tangential, plane.rolling};
}

inline SphereRows rows_of(const SphereNetwork& network, std::size_t link, NetworkLaw law) {
  return sphere_rows(network.packing.links[link].kind, law);
}

// A row is the load of a unit link force, in doubles and, times a positive factor, for exact fields (link_3d.hpp).
template <class Real>
LinkLoad3<Real> unit_load(const SphereRow& row, const LinkFrame3<Real>& frame) {
  Real3<Real> unit{};
  unit[static_cast<std::size_t>(row.axis)] = Real(1);
  switch (row.kind) {
    case RowKind::normal:
      return link_load<Real>(frame, Real(1), {}, {});
    case RowKind::tangential:
      return link_load<Real>(frame, Real{}, unit, {});
    case RowKind::rolling:
      break;
  }
  return link_load<Real>(frame, Real{}, {}, unit);
}
template <class F>
LinkLoad3<F> rational_load(const SphereRow& row, const Real3<F>& branch, F radius_i, F radius_j) {
  switch (row.kind) {
    case RowKind::normal:
      return rational_normal(branch);
    case RowKind::tangential:
      return rational_contact(static_cast<std::size_t>(row.axis), branch, radius_i, radius_j);
    case RowKind::rolling:
      break;
  }
  return rational_rolling<F>(static_cast<std::size_t>(row.axis));
}

// Columns of G: body i has columns [i * per_body, (i + 1) * per_body): v and, with friction, w; a free cell adds the
// three strain rates at the end.
inline DofLayout dof_layout(const SphereNetwork& network, NetworkLaw law, bool cell_free) {
  return {law == NetworkLaw::frictionless ? 3 : 6, network.free, cell_free ? 3 : 0};
}

inline std::int64_t row_count(const SphereNetwork& network, NetworkLaw law) {
  std::int64_t m = 0;
  for (const Link<3>& link : network.packing.links) m += sphere_rows(link.kind, law).count();
  return m;
}

}  // namespace isostat
