// The rigidity matrix G of a packing (Gilabert 2007, Eqs. A1-A3): body velocities to link velocities, with the sign
// convention of dem/state/link.hpp; its transpose takes link forces to body forces (Eq. A5).
#pragma once
#include <cstdint>
#include <vector>

#include "analysis/rigidity/link_rows.hpp"
#include "analysis/sphere_network.hpp"

namespace isostat {

// Compressed rows. Row order: links in storage order, then overlaps, and within a link N, T, M as far as kept. The
// normal row of an overlap is the rate at which its area shrinks, conjugate to the pressure.
struct RigidityMatrix {
  DofLayout layout;
  std::vector<std::int64_t> row_start;    // size rows() + 1
  std::vector<std::int64_t> column;       // ascending within a row; equal columns are already summed
  std::vector<double> value;              // [-] normal, tangential in velocities; [a] at spins; strains [a]
  std::vector<std::int32_t> link_of_row;  // LinkNetwork::links()
  std::vector<RowKind> kind;
  std::vector<std::int8_t> axis;  // in space: Cartesian, see link_rows_3d.hpp; empty in the plane

  std::int64_t rows() const { return static_cast<std::int64_t>(row_start.size()) - 1; }
  std::int64_t columns() const { return layout.size(); }

  // Link velocities G U (size rows) and body forces G^T f (size columns; at a strain: the work-conjugate, area times
  // stress).
  std::vector<double> link_velocities(const std::vector<double>& body_velocities) const;
  std::vector<double> body_forces(const std::vector<double>& link_forces) const;
};

// Throws InputError if cell_free is asked for without a cell.
RigidityMatrix rigidity_matrix(const LinkNetwork& network, NetworkLaw law, bool cell_free);
RigidityMatrix rigidity_matrix(const SphereNetwork& network, NetworkLaw law, bool cell_free);

// The same with the three rows of each contact turned into its frame: n . v_c and v_c along two tangents (kinds normal,
// tangential, tangential), where stiffness is diagonal. The rotation is orthogonal: null spaces and singular values
// stay.
RigidityMatrix in_contact_frames(const SphereNetwork& network, const RigidityMatrix& g);
// The direction of such a row: n, or one of the two tangents.
Vec3 axis_in_frame(const SphereNetwork& network, const RigidityMatrix& in_frames, std::size_t row);

// Body velocities of a packing in the order of the columns, strain rates appended (a free cell only).
std::vector<double> body_velocities(const Packing<2>& packing, const DofLayout& layout, const Vec2& strain_rate);
std::vector<double> body_velocities(const Packing<3>& packing, const DofLayout& layout, const Vec3& strain_rate);

// Forces of a network's links (N, T, M as stored; pressure and friction of an overlap) in the order of the rows.
std::vector<double> link_forces(const LinkNetwork& network, const RigidityMatrix& matrix);
// In Cartesian rows N n + T and M, where there is a normal row alone N.
std::vector<double> link_forces(const SphereNetwork& network, const RigidityMatrix& matrix);

// Per link, from numbers by Cartesian row: N, T and M, zero where there is no row.
struct SphereForces {
  std::vector<double> normal;
  std::vector<Vec3> tangential, moment;
};
SphereForces by_link(const SphereNetwork& network, const RigidityMatrix& matrix, const std::vector<double>& of_row);

}  // namespace isostat
