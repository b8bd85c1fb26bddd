#include "analysis/network/principal.hpp"

#include <Eigen/Eigenvalues>
#include <nlohmann/json.hpp>

namespace isostat {

template <int D>
PrincipalAxes<D> principal_axes(const Tensor<D>& tensor) {
  Eigen::Matrix<double, D, D> symmetric;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b)
      symmetric(a, b) = 0.5 * (tensor[static_cast<std::size_t>(a)][b] + tensor[static_cast<std::size_t>(b)][a]);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, D, D>> solver(symmetric);
  PrincipalAxes<D> axes;
  for (int k = 0; k < D; ++k) {
    const Eigen::Matrix<double, D, 1> v = solver.eigenvectors().col(D - 1 - k);
    Eigen::Index largest = 0;
    v.cwiseAbs().maxCoeff(&largest);
    axes.value[k] = solver.eigenvalues()[D - 1 - k];
    for (int a = 0; a < D; ++a) axes.direction[static_cast<std::size_t>(k)][a] = v[largest] < 0 ? -v[a] : v[a];
  }
  return axes;
}

template <int D>
void add_principal(nlohmann::ordered_json& json, const Tensor<D>& tensor) {
  const PrincipalAxes<D> axes = principal_axes<D>(tensor);
  json["principal"] = axes.value.c;
  for (const Vec<D>& direction : axes.direction) json["directions"].push_back(direction.c);
  json["deviator"] = 0.5 * (axes.value[0] - axes.value[D - 1]);
}

template PrincipalAxes<2> principal_axes<2>(const Tensor<2>&);
template PrincipalAxes<3> principal_axes<3>(const Tensor<3>&);
template void add_principal<2>(nlohmann::ordered_json&, const Tensor<2>&);
template void add_principal<3>(nlohmann::ordered_json&, const Tensor<3>&);

}  // namespace isostat
