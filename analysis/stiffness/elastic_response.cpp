#include "analysis/stiffness/elastic_response.hpp"

#include "analysis/vector_algebra.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

template <std::size_t N>
ElasticResponse<N> elastic_response(RigidityMatrix g, std::vector<double> k, const PseudoInverse& inverse,
                                    const std::array<std::vector<double>, N>& strain, double volume) {
  std::array<std::vector<double>, N> force, load;  // k s and G^T k s
  for (std::size_t b = 0; b < N; ++b) {
    force[b] = strain[b];
    for (std::size_t r = 0; r < k.size(); ++r) force[b][r] *= k[r];
    load[b] = g.body_forces(force[b]);
  }
  ElasticResponse<N> response;
  for (std::size_t b = 0; b < N; ++b) {
    const std::vector<double> relaxed = inverse.solve(load[b]);  // grains move by -relaxed
    for (std::size_t a = 0; a < N; ++a) {
      response.affine[a][b] = dot(strain[a], force[b]) / volume;
      response.tensor[a][b] = (dot(strain[a], force[b]) - dot(load[a], relaxed)) / volume;
    }
    const std::vector<double> back = g.link_velocities(relaxed);
    response.velocity[b] = strain[b];
    for (std::size_t r = 0; r < k.size(); ++r) response.velocity[b][r] -= back[r];
  }
  response.g = std::move(g), response.k = std::move(k);
  return response;
}

template <std::size_t N>
EnergyShares energy_shares(const ElasticResponse<N>& response, const std::vector<bool>& contact,
                           const std::vector<std::array<double, N>>& strains) {
  EnergyShares shares;
  std::vector<double> of_link(contact.size());
  double total = 0;
  for (std::size_t r = 0; r < response.k.size(); ++r) {
    const std::size_t link = idx(response.g.link_of_row[r]);
    double energy = 0;
    for (const std::array<double, N>& strain : strains) {
      double v = 0;
      for (std::size_t a = 0; a < N; ++a) v += strain[a] * response.velocity[a][r];
      energy += 0.5 * response.k[r] * v * v;
    }
    total += energy;
    of_link[link] += energy;
    const ByRow<double*> by_kind{&shares.normal, &shares.tangential, &shares.rolling};
    *(contact[link] ? by_kind[response.g.kind[r]] : &shares.distant) += energy;
  }
  for (double* part : {&shares.normal, &shares.tangential, &shares.rolling, &shares.distant}) *part /= total;
  double sum = 0, squares = 0, contacts = 0;
  for (std::size_t l = 0; l < contact.size(); ++l)
    if (contact[l]) sum += of_link[l], squares += of_link[l] * of_link[l], ++contacts;
  shares.participation = sum * sum / (contacts * squares);
  return shares;
}

template ElasticResponse<3> elastic_response(RigidityMatrix, std::vector<double>, const PseudoInverse&,
                                             const std::array<std::vector<double>, 3>&, double);
template ElasticResponse<6> elastic_response(RigidityMatrix, std::vector<double>, const PseudoInverse&,
                                             const std::array<std::vector<double>, 6>&, double);
template EnergyShares energy_shares(const ElasticResponse<3>&, const std::vector<bool>&,
                                    const std::vector<std::array<double, 3>>&);
template EnergyShares energy_shares(const ElasticResponse<6>&, const std::vector<bool>&,
                                    const std::vector<std::array<double, 6>>&);

}  // namespace isostat
