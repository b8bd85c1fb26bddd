// `lab throughput` of spheres.
#pragma once
#include "dem/solver/throughput.hpp"
#include "dem/spheres/engine.hpp"

namespace isostat::lab {

struct SphereThroughputSetup {
  std::int64_t steps = 0;  // 0: about two seconds' worth
  int threads = 1;
  bool friction = true, rolling = false;  // of a network
};

// Of a network, Hertz and Mindlin's law with E = 1e6, nu = .3, mu = .3, zeta = .3, density 1, fixed cell, the step of a
// scene; of a state its own law and step.
Throughput measure_throughput(const Packing<3>& packing, const SphereThroughputSetup& setup);
Throughput measure_throughput(const State<Spheres>& state, const SphereThroughputSetup& setup);

}  // namespace isostat::lab
