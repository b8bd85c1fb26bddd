// The stage runner for spheres.
#include "dem/run/stages_impl.hpp"
#include "dem/spheres/certificate.hpp"
#include "dem/spheres/engine.hpp"
#include "dem/spheres/stage.hpp"

namespace isostat {

template RunOutcome run_stages(State<Spheres>&, const SolverOptions&, const RunHooks<Spheres>&, StaticSolver<Spheres>*);

}  // namespace isostat
