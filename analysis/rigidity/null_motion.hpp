// A random vector of null G over a prime field, as motions of rigid bodies: what moves alike in it moves alike in all
// of them, but for a chance of 1 / p.
#pragma once
#include <array>
#include <vector>

#include "analysis/rigidity/reduced_problem.hpp"

namespace isostat {

// By body: V at the origin of its frame, then W; the strain last.
template <class Network>
using NullMotion = std::vector<std::array<WideField, kMostDofs<Network>>>;

template <class Network>
NullMotion<Network> random_null_motion(const ReducedProblem<WideField, Network>& problem);

}  // namespace isostat
