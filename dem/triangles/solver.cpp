// The step loop for grains of triangles.
#include "dem/solver/solver_impl.hpp"
#include "dem/triangles/engine.hpp"

namespace isostat {

template class Solver<TriangleGrains>;

}  // namespace isostat
