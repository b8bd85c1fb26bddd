// Stiffness of packings of spheres: K = G^T k G with the stiffnesses of each link, which a law may make depend on its
// force (Hertz) or not; the geometric term of the normal forces; moduli and vibration modes that follow.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/stiffness/elastic_response.hpp"
#include "analysis/stiffness/sparse_cholesky.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "dem/spheres/spheres.hpp"

namespace isostat {

struct SphereStiffness {
  double normal = 0;      // -dN/dh [force/length]; of a distant link mostly negative
  double tangential = 0;  // the same in every direction of the tangent plane
  double rolling = 0;     // of rolling and twisting [force length]
  double prestress = 0;   // N, for the geometric term [force]
};

// The same for every contact, and for every distant link its own normal one.
struct UniformStiffness {
  double normal = 1, tangential = 1, rolling = 1e-4, distant = -1e-2;
};
// Of a network that brings no law: unit stiffness, unless K_N, K_T, K_R are given; K_T = K_N and K_R = 1e-4 K_N d^2 by
// default, d the largest diameter, and -K_N/100 across a gap, the ratios of the default scene of disks.
UniformStiffness network_stiffness(const Packing<3>& packing, const std::vector<double>& given);
std::vector<SphereStiffness> by_link(const Packing<3>& packing, const UniformStiffness& stiffness);
// Of a state: the tangents of its law at the gaps of the links.
std::vector<SphereStiffness> by_link(const SpherePacking& packing, const SphereLaw& law);

// Of rows in contact frames.
std::vector<double> row_stiffness(const RigidityMatrix& in_frames, const std::vector<SphereStiffness>& stiffness);

// Lower triangle of K. geometric: adds what turning normals do to the normal forces, -N/|r| (1 - n n) between the
// centres, symmetric; tangential forces have no such term here.
SymmetricMatrix stiffness_matrix(const SphereNetwork& network, NetworkLaw law, bool cell_free,
                                 const std::vector<SphereStiffness>& stiffness, bool geometric = false);

// dsigma_a / de_b for the strains 11, 22, 33, 23, 13, 12 (the last three shear angles gamma), compression positive,
// every grain relaxed, at zero force. Throws FactorisationFailed if distant links make the rest singular. Needs a cell.
using SphereModuli = ModuliTensor<6>;
ElasticResponse<6> elastic_response(const SphereNetwork& network, NetworkLaw law,
                                    const std::vector<SphereStiffness>& stiffness);
inline SphereModuli elastic_moduli(const SphereNetwork& network, NetworkLaw law,
                                   const std::vector<SphereStiffness>& stiffness) {
  return elastic_response(network, law, stiffness).tensor;
}

// As of the plane: diagonal of M; fixed cell, the `count` of smallest |omega| > 0.
std::vector<double> dof_masses(const SphereNetwork& network, NetworkLaw law);
VibrationModes vibration_modes(const SphereNetwork& network, NetworkLaw law,
                               const std::vector<SphereStiffness>& stiffness, int count, bool displacements);

}  // namespace isostat
