// The step loop for disks.
#include "dem/disks/engine.hpp"
#include "dem/solver/solver_impl.hpp"

namespace isostat {

template class Solver<Disks>;

}  // namespace isostat
