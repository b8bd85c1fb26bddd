// What one link does when its two bodies and the cell move by an infinitesimal amount: stiffness, and the geometric
// (prestress) term: its forces turn with its frame and its lever arms stretch. A contact without a tangential row
// (sliding) keeps the tangential force that it has; a beam keeps T L.
#pragma once
#include <array>

#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/stiffness/unsymmetric_lu.hpp"
#include "dem/scene/scene.hpp"
#include "dem/state/link.hpp"

namespace isostat {

struct LinkTangent {
  LinkFrame<double> f;
  Vec2 branch;  // [a] r_ij
  double radius_i, radius_j;
  double normal, tangential, moment;  // forces now
  bool is_beam = false;
  double turns_over =
      0;  // [a] way of j along the tangent over the angle by which it turns the frame: |r| of two bodies
  ByRow<double> stiffness{};

  struct Response {
    double fx, fy, moment_i, moment_j;  // change of the force on j (opposite on i) and of the moments
  };
  // Relative motion of the centres j - i, spins of both.
  Response operator()(double dx, double dy, double spin_i, double spin_j) const;

  // -d(body forces)/d(...) of a response, in the order x_i, y_i, spin_i, x_j, y_j, spin_j.
  static std::array<double, 6> resistance(const Response& q) {
    return {q.fx, q.fy, -q.moment_i, -q.fx, -q.fy, -q.moment_j};
  }
  // Response to the unit motion of dof d in that order.
  Response to_dof(int d) const;
};

// One for each link of the packing, overlaps left out (area_tangent.hpp). Throws InputError as row_stiffness does.
std::vector<LinkTangent> link_tangents(const LinkNetwork& network, NetworkLaw network_law, const DiskLaw& law);

// -d(body forces)/d(positions and angles) of the grains in a fixed cell, columns and rows as those of G.
UnsymmetricMatrix tangent_stiffness(const LinkNetwork& network, NetworkLaw network_law, const DiskLaw& law);

}  // namespace isostat
