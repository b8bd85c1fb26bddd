#include "analysis/one_thread.hpp"

#include <cstdlib>

// OpenMP 5.0, Sec. 3.2.15, from the GNU runtime that SuiteSparse brings; clang's <omp.h> belongs to another runtime.
extern "C" void omp_set_max_active_levels(int max_active_levels);

namespace isostat {

void keep_libraries_to_one_thread() {
  // CHOLMOD names a number of threads in its num_threads clauses, which omp_set_num_threads() does not overrule; with
  // no active level allowed every region is serial (OpenMP 5.0, Sec. 2.6.1).
  if (std::getenv("OMP_NUM_THREADS") == nullptr) omp_set_max_active_levels(0);
}

}  // namespace isostat
