// The stage runner for grains of triangles.
#include "dem/run/stages_impl.hpp"
#include "dem/triangles/certificate.hpp"
#include "dem/triangles/engine.hpp"
#include "dem/triangles/outflow.hpp"
#include "dem/triangles/stage.hpp"

namespace isostat {

template RunOutcome run_stages(State<TriangleGrains>&, const SolverOptions&, const RunHooks<TriangleGrains>&,
                               StaticSolver<TriangleGrains>*);

}  // namespace isostat
