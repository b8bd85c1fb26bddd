// The stage runner for disks.
#include "dem/disks/certificate.hpp"
#include "dem/disks/engine.hpp"
#include "dem/disks/outflow.hpp"
#include "dem/disks/stage.hpp"
#include "dem/run/stages_impl.hpp"

namespace isostat {

template RunOutcome run_stages(State<Disks>&, const SolverOptions&, const RunHooks<Disks>&, StaticSolver<Disks>*);

}  // namespace isostat
