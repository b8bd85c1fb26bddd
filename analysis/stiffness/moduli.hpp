// Elastic moduli of a periodic cell: stress response to the strains e11, e22, gamma12 (compression positive for the
// first two) with every grain relaxed. 2D moduli are forces per length.
#pragma once
#include <array>
#include <string>

#include "analysis/input.hpp"
#include "analysis/stiffness/elastic_response.hpp"
#include "dem/scene/scene.hpp"

namespace isostat {

using Moduli = ModuliTensor<3>;  // [F0/a] dsigma_a / de_b, order 11, 22, 12

// Of Gt k G, the tangent at zero force. Exists for floppy networks too: mechanisms resist nothing, and the load of a
// strain is always in the range of a positive k. Throws FactorisationFailed if distant links make the rest singular.
ElasticResponse<3> elastic_response(const LinkNetwork& network, NetworkLaw network_law, const DiskLaw& law);
inline Moduli elastic_moduli(const LinkNetwork& network, NetworkLaw network_law, const DiskLaw& law) {
  return elastic_response(network, network_law, law).tensor;
}

// With the geometric term: forces of the links turn with their frames and levers stretch. Not symmetric when there are
// tangential forces; solved by UMFPACK. The response is of sigma = (1/A) sum F r, with A and r at the strained state.
struct TangentModuli {
  Moduli tensor{};
  double antisymmetric_part = 0;  // |K - K^T| / |K + K^T|, Frobenius norms, of the tangent stiffness of the grains
};
// Throws FactorisationFailed if the tangent is singular beyond the translations and the grains without links.
TangentModuli tangent_moduli(const LinkNetwork& network, NetworkLaw network_law, const DiskLaw& law);

}  // namespace isostat
