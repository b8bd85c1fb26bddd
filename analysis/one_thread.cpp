#include "analysis/one_thread.hpp"

#include <omp.h>

#include <cstdlib>

namespace isostat {

void keep_libraries_to_one_thread() {
  // CHOLMOD names a number of threads in its num_threads clauses, which omp_set_num_threads() does not overrule; with
  // no active level allowed every region is serial (OpenMP 5.0, Sec. 2.6.1).
  if (std::getenv("OMP_NUM_THREADS") == nullptr) omp_set_max_active_levels(0);
}

}  // namespace isostat
