// CHOLMOD, METIS and UMFPACK would start OpenMP threads of their own. A run is one thread, and a study or a shell runs
// several of them side by side; only OMP_NUM_THREADS in the environment asks for more.
#pragma once

namespace isostat {

// Parallel regions that the calling thread enters from now on run on it alone. Cheap; called before each such library.
void keep_libraries_to_one_thread();

}  // namespace isostat
