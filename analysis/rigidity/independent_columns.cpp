#include "analysis/rigidity/independent_columns.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/rigidity/area_rows.hpp"
#include "analysis/rigidity/reduced_problem.hpp"
#include "dem/input_error.hpp"
#include "dem/state/link_ends.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using F = FirstField;

// One row of a pruned body about its first grain: velocity of that grain and its spin. In the field, and in double
// precision with the arm in units of the radius: there it only says which pivot is large.
template <int Most>
struct PrunedRow {
  std::array<F, Most> exact{};
  std::array<double, Most> size{};
};

template <class Network>
class PrunedRows;

template <>
class PrunedRows<LinkNetwork> {
 public:
  using Geometry = FieldGeometry<F>;
  PrunedRows(const LinkNetwork& network, const ReducedProblem<F>& problem, const FieldGeometry<F>& geometry)
      : network_(network), packing_(network.packing), problem_(problem), geometry_(geometry) {}

  PrunedRow<3> about(std::size_t grain, std::int32_t body, std::size_t at) const {
    PrunedRow<3> result;
    result.exact = problem_.rows.at(at, body);
    const Rows<F>::Row& row = problem_.rows.rows[at];
    const FieldVec<F> x = geometry_.placed(grain, problem_.bodies.placement[grain]);
    // V = v - w z x x, velocity at the origin from that of the grain.
    result.exact[2] = result.exact[2] + result.exact[0] * x[1] - result.exact[1] * x[0];
    if (row.kind == RowKind::rolling) {
      result.size = {0, 0, 1 / packing_.bodies.radius[grain]};
      return result;
    }
    if (network_.is_area(idx(row.link))) {
      result.size = area_size(row, grain, body);
      return result;
    }
    const Link<2>& link = packing_.links[idx(row.link)];
    const auto i = idx(link.i), j = idx(link.j);
    const bool first = problem_.bodies.body_of[i] == body;
    const Vec2 from = placed(i), back = offset(problem_.bodies.image(link));
    const Vec2 branch = packing_.bodies.position[j] + offset(link.shift) - packing_.bodies.position[i];
    const LinkEnds<2> at_ends = ends(packing_, link);
    const double share = at_ends.radius_i / (at_ends.radius_i + at_ends.radius_j);
    const Vec2 arm = from + share * branch - (first ? Vec2{} : back) - placed(grain);
    const Vec2 n = (1 / norm(branch)) * branch, e = row.kind == RowKind::normal ? n : Vec2{{-n[1], n[0]}};
    result.size = {e[0], e[1], (arm[0] * e[1] - arm[1] * e[0]) / packing_.bodies.radius[grain]};
    return result;
  }

 private:
  // As a link's: the largest force on a triangle is the unit.
  std::array<double, 3> area_size(const Rows<F>::Row& row, std::size_t grain, std::int32_t body) const {
    std::array<double, 3> sum{};
    double largest = 0;
    for (const auto& [triangle, shift, at] :
         area_loads(network_, network_.area(idx(row.link)), row.kind == RowKind::tangential)) {
      largest = std::max(largest, std::hypot(at[0], at[1]));
      if (problem_.bodies.body_of[idx(triangle)] != body) continue;
      const Vec2 arm = placed(idx(triangle)) - placed(grain);
      sum = {sum[0] + at[0], sum[1] + at[1], sum[2] + at[2] + arm[0] * at[1] - arm[1] * at[0]};
    }
    return {sum[0] / largest, sum[1] / largest, sum[2] / largest / packing_.bodies.radius[grain]};
  }
  Vec2 offset(const ImageShift<2>& s) const { return packing_.cell ? packing_.cell->offset(s) : Vec2{}; }
  Vec2 placed(std::size_t grain) const {
    return packing_.bodies.position[grain] + offset(problem_.bodies.placement[grain]);
  }
  const LinkNetwork& network_;
  const Packing<2>& packing_;
  const ReducedProblem<F>& problem_;
  const FieldGeometry<F>& geometry_;
};

template <>
class PrunedRows<SphereNetwork> {
 public:
  using Geometry = SphereGeometry<F>;
  PrunedRows(const SphereNetwork& network, const ReducedProblem<F, SphereNetwork>& problem, const Geometry& geometry)
      : packing_(network.packing), problem_(problem), geometry_(geometry) {}

  PrunedRow<kSphereDofs> about(std::size_t grain, std::int32_t body, std::size_t at) const {
    PrunedRow<kSphereDofs> result;
    result.exact = problem_.rows.at(at, body);
    const Real3<F> force{result.exact[0], result.exact[1], result.exact[2]},
        turn = cross_3d<F>(geometry_.placed(grain, problem_.bodies.placement[grain]), force);
    for (std::size_t k = 0; k < 3; ++k) result.exact[3 + k] = result.exact[3 + k] - turn[k];

    const auto& row = problem_.rows.rows[at];
    const Link<3>& link = packing_.links[idx(row.link)];
    const LinkLoad3<double> load = unit_load<double>(SphereRow{row.kind, row.axis}, frame(ends(packing_, link)));
    const auto add = [&](std::int32_t end, double sign, const Real3<double>& moment) {
      if (problem_.bodies.body_of[idx(end)] != body) return;
      const Real3<double> on{sign * load.force[0], sign * load.force[1], sign * load.force[2]},
          turned = cross_3d<double>((placed(idx(end)) - placed(grain)).c, on);
      for (std::size_t k = 0; k < 3; ++k) {
        result.size[k] += on[k];
        result.size[3 + k] += (moment[k] + turned[k]) / packing_.bodies.radius[grain];
      }
    };
    add(link.i, -1, load.moment_i), add(link.j, 1, load.moment_j);
    return result;
  }

 private:
  Vec3 placed(std::size_t grain) const {
    const Vec3& r = packing_.bodies.position[grain];
    return packing_.cell ? r + packing_.cell->offset(problem_.bodies.placement[grain]) : r;
  }
  const Packing<3>& packing_;
  const ReducedProblem<F, SphereNetwork>& problem_;
  const Geometry& geometry_;
};

// Columns left without a pivot when the rows are eliminated, largest entry first, nonzero in the field.
template <std::size_t Most>
std::array<bool, Most> without_pivot(std::array<PrunedRow<static_cast<int>(Most)>, Most> a, std::size_t count,
                                     std::size_t dofs) {
  std::array<bool, Most> none;
  none.fill(true);
  for (std::size_t done = 0; done < count; ++done) {
    std::size_t p = count, pivot = dofs;
    for (std::size_t k = done; k < count; ++k)
      for (std::size_t d = 0; d < dofs; ++d)
        if (none[d] && !a[k].exact[d].is_zero() && (p == count || std::abs(a[k].size[d]) > std::abs(a[p].size[pivot])))
          p = k, pivot = d;
    if (p == count) throw std::logic_error("rows of a pruned body depend on each other");
    none[pivot] = false;
    std::swap(a[p], a[done]);
    for (std::size_t k = done + 1; k < count; ++k) {
      const F factor = a[k].exact[pivot], scale = a[done].exact[pivot];  // fraction-free
      const double ratio = a[done].size[pivot] != 0 ? a[k].size[pivot] / a[done].size[pivot] : 0;
      for (std::size_t d = 0; d < dofs; ++d) {
        a[k].exact[d] = scale * a[k].exact[d] - factor * a[done].exact[d];
        a[k].size[d] -= ratio * a[done].size[d];
      }
    }
  }
  return none;
}

// A null vector of G is a motion of the contracted bodies, so the columns of one grain in each body are enough. The
// unknowns of body_rows are V at the origin of the frame and W, those of G the velocity of the centre and w: column w
// of G is column W plus columns V of the same body, eliminated just before. Likewise peculiar and absolute velocities
// differ by columns V in the strain columns, which come last. So the same columns depend on earlier ones. Pruned
// bodies stand first in the order, in the order of their removal, each with its columns sorted by its pivots.
template <class Network>
std::vector<char> dependent_of(const Network& network, NetworkLaw law, bool cell_free) {
  const auto& packing = network.packing;
  constexpr int kMost = kMostDofs<Network>;
  if (cell_free && !packing.cell) throw InputError("command line", 0, "--cell", "free", "the input has no cell");
  const auto problem = reduce_problem<F>(network, law, cell_free);
  const DofLayout layout = dof_layout(network, law, cell_free);
  std::vector<char> dependent(idx(layout.size()), 0);
  std::vector<std::size_t> column_of_body(idx(problem.bodies.count));
  for (std::size_t i = idx(network.free); i-- > 0;)
    if (problem.bodies.body_of[i] != RigidBodies::held)
      column_of_body[idx(problem.bodies.body_of[i])] = i * idx(layout.per_body);

  const auto per_body = idx(layout.per_body);
  const typename PrunedRows<Network>::Geometry geometry = exact_geometry<F>(network);
  const PrunedRows<Network> rows_about(network, problem, geometry);
  for (const PrunedBody<kMost>& pruned : problem.network.pruned) {
    const std::size_t column = column_of_body[idx(pruned.body)];
    std::array<PrunedRow<kMost>, kMost> mine;
    for (std::size_t k = 0; k < idx(pruned.count); ++k)
      mine[k] = rows_about.about(column / per_body, pruned.body, idx(pruned.rows[k]));
    const auto none = without_pivot<kMost>(mine, idx(pruned.count), per_body);
    for (std::size_t d = 0; d < per_body; ++d) dependent[column + d] = none[d];
  }
  for (std::int32_t b : problem.network.bodies)  // without rows: free
    if (problem.node_of_body[idx(b)] < 0)
      for (std::size_t d = 0; d < per_body; ++d) dependent[column_of_body[idx(b)] + d] = 1;

  for (std::uint64_t attempt = 0;; ++attempt) {
    try {
      const ModularLdlt<F> ldlt(problem.tree, problem.dofs, problem.node_rows(problem.rows), 77 + attempt, false);
      for (std::size_t n = 0; n < problem.body_of_node.size(); ++n) {
        const std::int32_t body = problem.body_of_node[n];
        const std::size_t column =
            body == problem.bodies.count ? idx(layout.strain_column(0)) : column_of_body[idx(body)];
        const auto entry = static_cast<std::size_t>(ldlt.offset(static_cast<std::int32_t>(n)));
        for (std::size_t d = 0; d < idx(problem.dofs[n]); ++d) dependent[column + d] = ldlt.dependent()[entry + d];
      }
      return dependent;
    } catch (const RandomizationFailed&) {
      if (attempt == 3) throw;
    }
  }
}

}  // namespace

std::vector<char> dependent_columns(const LinkNetwork& network, NetworkLaw law, bool cell_free) {
  return dependent_of(network, law, cell_free);
}
std::vector<char> dependent_columns(const SphereNetwork& network, NetworkLaw law, bool cell_free) {
  return dependent_of(network, law, cell_free);
}

}  // namespace isostat
