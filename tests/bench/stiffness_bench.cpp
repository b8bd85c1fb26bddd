// Stiffness: assembly, CHOLMOD factorisation and the 6 lowest modes against N, each with its peak memory. CSV on
// stdout; CPU time, as the machine may be shared.
//   stiffness_bench [smallest N] [largest N] [largest N for modes] [friction|frictionless]
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/stiffness/lowest_modes.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "tests/support/random_network.hpp"

using namespace isostat;

namespace {

double cpu_since(std::clock_t from) { return static_cast<double>(std::clock() - from) / CLOCKS_PER_SEC; }

double peak_megabytes() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace

int main(int argc, char** argv) {
  const double smallest = argc > 1 ? std::atof(argv[1]) : 100, largest = argc > 2 ? std::atof(argv[2]) : 1e5,
               largest_modes = argc > 3 ? std::atof(argv[3]) : 1e5;
  const bool friction = argc <= 4 || std::strcmp(argv[4], "frictionless") != 0;
  const NetworkLaw law = friction ? NetworkLaw::friction : NetworkLaw::frictionless;
  std::printf(
      "N,law,columns,K,assembly,independent_columns,cholesky,factor_entries,solve,cholesky_peak_MB,modes,lowest,"
      "modes_peak_MB\n");
  for (double n : {100.0, 400.0, 1400.0, 5600.0, 22400.0, 1e5, 1e6}) {
    if (n < smallest || n > largest) continue;
    RandomNetwork o;
    o.columns = o.rows = static_cast<int>(std::lround(std::sqrt(n)));
    o.coordination = 5.0;
    const Packing<2> p = random_network(o);
    auto t = std::clock();
    SymmetricMatrix a;
    {
      const RigidityMatrix g = rigidity_matrix(p, law, false);
      a = weighted_normal_matrix(g, row_stiffness(p, g, default_network_law()));
    }
    const double assembly = cpu_since(t);
    t = std::clock();
    const auto dependent = dependent_columns(p, law, false);
    const double columns = cpu_since(t);
    double cholesky = 0, solve = 0;
    std::int64_t entries = 0;
    {
      std::vector<char> keep(dependent.size());
      for (std::size_t c = 0; c < keep.size(); ++c) keep[c] = !dependent[c];
      const SymmetricMatrix inner = principal_submatrix(a, keep);
      t = std::clock();
      const SparseCholesky factor(inner, SparseCholesky::Form::definite);
      cholesky = cpu_since(t), entries = factor.factor_entries();
      t = std::clock();
      factor.solve(std::vector<double>(static_cast<std::size_t>(inner.size), 1.0));
      solve = cpu_since(t);
    }
    const double cholesky_peak = peak_megabytes();
    double modes = NAN, lowest = NAN, modes_peak = NAN;
    if (n <= largest_modes) {
      t = std::clock();
      const LowestModes m = lowest_modes(a, dependent, {}, 6, true, false);
      modes = cpu_since(t), modes_peak = peak_megabytes();
      if (m.converged) lowest = m.value[0];
    }
    std::printf("%zu,%s,%d,%lld,%.5f,%.5f,%.5f,%lld,%.5f,%.0f,%.5f,%.6g,%.0f\n", p.bodies.size(),
                friction ? "friction" : "frictionless", a.size,
                static_cast<long long>(std::count(dependent.begin(), dependent.end(), 1)), assembly, columns, cholesky,
                static_cast<long long>(entries), solve, cholesky_peak, modes, lowest, modes_peak);
    std::fflush(stdout);
  }
}
