// Principal values and directions of a tensor, of its symmetric part: what a report says beside the components, which
// mean little where the axes of the cell are none of the packing's.
#pragma once
#include <array>
#include <nlohmann/json_fwd.hpp>

#include "geometry/vec.hpp"

namespace isostat {

template <int D>
using Tensor = std::array<Vec<D>, D>;  // rows

template <int D>
struct PrincipalAxes {
  Vec<D> value;                     // the largest first
  std::array<Vec<D>, D> direction;  // unit vectors; of each, the largest component is positive
};
template <int D>
PrincipalAxes<D> principal_axes(const Tensor<D>& tensor);

// Adds "principal", "directions" and "deviator", half the difference of the largest and the smallest value.
template <int D>
void add_principal(nlohmann::ordered_json& json, const Tensor<D>& tensor);

}  // namespace isostat
