// Stiffness matrix K = G^T k G (Gilabert 2007, Eq. A6): forces per displacement, k the diagonal of contact stiffnesses.
#pragma once
#include <vector>

#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/stiffness/sparse_cholesky.hpp"
#include "dem/scene/scene.hpp"

namespace isostat {

// Stiffness of the rows of a link [F0/a, moments F0 a]: K_N, K_T, K_r of a contact, -F0/D0 for the normal row of a
// distant link, a beam's own (dem/state/beam.hpp). Throws InputError if a link is distant and the law has no
// attraction.
ByRow<double> link_stiffness(const Packing<2>& packing, const Link<2>& link, const DiskLaw& law);
// Of a network; an overlap has Y/L_c and, with friction, its spring. The law is that of contacts between disks.
std::vector<double> row_stiffness(const LinkNetwork& network, const RigidityMatrix& g, const DiskLaw& law);

// The law of a network that brings none: the default scene's (K_N = K_T = 1e5 F0/a, K_r = 1e-4 a^2 K_N, D0 = 1e-3 a).
DiskLaw default_network_law();

// Lower triangle of G^T diag(weight) G.
SymmetricMatrix weighted_normal_matrix(const RigidityMatrix& g, const std::vector<double>& weight);

}  // namespace isostat
