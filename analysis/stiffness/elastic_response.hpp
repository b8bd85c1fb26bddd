// How a network answers a strain of its cell: moduli, the affine estimate that they would have if no grain left the
// affine motion, and where the elastic energy sits.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/stiffness/pseudo_inverse.hpp"

namespace isostat {

template <std::size_t N>
using ModuliTensor = std::array<std::array<double, N>, N>;

// N strains: 3 in the plane (11, 22, gamma12), 6 in space.
template <std::size_t N>
struct ElasticResponse {
  RigidityMatrix g;                             // in which stiffness is diagonal
  std::vector<double> k;                        // of each row
  ModuliTensor<N> tensor{};                     // dsigma_a / de_b, every grain relaxed
  ModuliTensor<N> affine{};                     // the same with the grains held: Voigt's estimate, an upper bound
  std::array<std::vector<double>, N> velocity;  // of each row, of unit strains, relaxed
};

// inverse: of G^T k G; strain: row velocities of unit strains with the grains held; volume: of the cell.
template <std::size_t N>
ElasticResponse<N> elastic_response(RigidityMatrix g, std::vector<double> k, const PseudoInverse& inverse,
                                    const std::array<std::vector<double>, N>& strain, double volume);

// Shares of the elastic energy 1/2 k v^2 of a strain. Distant pairs have a negative stiffness, so the rest may
// exceed 1.
struct EnergyShares {
  double normal = 0, tangential = 0, rolling = 0, distant = 0;
  double participation = 0;  // (sum e)^2 / (n sum e^2) over the n contacts: 1 if all bear alike, 1/n if one bears all
};

// Of one strain, a combination of the unit strains, or the energies of several added. contact: of each link of the
// network, whether it is one.
template <std::size_t N>
EnergyShares energy_shares(const ElasticResponse<N>& response, const std::vector<bool>& contact,
                           const std::vector<std::array<double, N>>& strains);

}  // namespace isostat
