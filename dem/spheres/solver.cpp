// The step loop for spheres.
#include "dem/solver/solver_impl.hpp"
#include "dem/spheres/engine.hpp"

namespace isostat {

template class Solver<Spheres>;

}  // namespace isostat
