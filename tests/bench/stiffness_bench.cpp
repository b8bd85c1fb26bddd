// Stiffness: assembly, CHOLMOD factorisation and the 6 lowest modes against N. CSV on stdout; CPU time, as the machine
// may be shared.   stiffness_bench [largest N] [largest N for modes]
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/stiffness/lowest_modes.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "tests/oracle/random_network.hpp"

using namespace isostat;

namespace {

double cpu_since(std::clock_t from) { return static_cast<double>(std::clock() - from) / CLOCKS_PER_SEC; }

}  // namespace

int main(int argc, char** argv) {
  const double largest = argc > 1 ? std::atof(argv[1]) : 1e5, largest_modes = argc > 2 ? std::atof(argv[2]) : 22400;
  std::printf("N,columns,K,assembly,independent_columns,cholesky,factor_entries,solve,modes,lowest,peak_MB\n");
  for (double n : {100.0, 400.0, 1400.0, 5600.0, 22400.0, 1e5, 1e6}) {
    if (n > largest) break;
    RandomNetwork o;
    o.columns = o.rows = static_cast<int>(std::lround(std::sqrt(n)));
    o.coordination = 5.0;
    const Packing<2> p = random_network(o);
    auto t = std::clock();
    const RigidityMatrix g = rigidity_matrix(p, NetworkLaw::friction, false);
    const SymmetricMatrix a = weighted_normal_matrix(g, row_stiffness(p, g, default_network_law()));
    const double assembly = cpu_since(t);
    t = std::clock();
    const auto dependent = dependent_columns(p, NetworkLaw::friction, false);
    const double columns = cpu_since(t);
    std::vector<char> keep(dependent.size());
    for (std::size_t c = 0; c < keep.size(); ++c) keep[c] = !dependent[c];
    const SymmetricMatrix inner = principal_submatrix(a, keep);
    t = std::clock();
    const SparseCholesky factor(inner, SparseCholesky::Form::definite);
    const double cholesky = cpu_since(t);
    t = std::clock();
    factor.solve(std::vector<double>(static_cast<std::size_t>(inner.size), 1.0));
    const double solve = cpu_since(t);
    double modes = NAN, lowest = NAN;
    if (n <= largest_modes) {
      t = std::clock();
      const LowestModes m = lowest_modes(a, dependent, {}, 6, true, false);
      modes = cpu_since(t);
      if (m.converged) lowest = m.value[0];
    }
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    std::printf("%zu,%d,%lld,%.5f,%.5f,%.5f,%lld,%.5f,%.5f,%.6g,%.0f\n", p.bodies.size(), a.size,
                static_cast<long long>(std::count(dependent.begin(), dependent.end(), 1)), assembly, columns, cholesky,
                static_cast<long long>(factor.factor_entries()), solve, modes, lowest,
                static_cast<double>(usage.ru_maxrss) / 1024);
    std::fflush(stdout);
  }
}
