// How often is the integer K wrong? Ours, SPQR with its default tolerance, and Cholesky of G^T G with pivot thresholds,
// on the same networks. CSV on stdout.   rank_reliability_bench [largest N] [networks]
#include <SuiteSparseQR.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "tests/support/random_network.hpp"

using namespace isostat;

namespace {

double since(std::chrono::steady_clock::time_point t) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
}

std::int64_t spqr_floppy(const RigidityMatrix& g) {
  cholmod_common common;
  cholmod_l_start(&common);
  cholmod_triplet* t =
      cholmod_l_allocate_triplet(static_cast<std::size_t>(g.rows()), static_cast<std::size_t>(g.columns()),
                                 g.value.size(), 0, CHOLMOD_REAL, &common);
  for (std::size_t r = 0; r < static_cast<std::size_t>(g.rows()); ++r)
    for (std::int64_t e = g.row_start[r]; e < g.row_start[r + 1]; ++e) {
      static_cast<SuiteSparse_long*>(t->i)[e] = static_cast<SuiteSparse_long>(r);
      static_cast<SuiteSparse_long*>(t->j)[e] = g.column[static_cast<std::size_t>(e)];
      static_cast<double*>(t->x)[e] = g.value[static_cast<std::size_t>(e)];
    }
  t->nnz = g.value.size();
  cholmod_sparse* a = cholmod_l_triplet_to_sparse(t, 0, &common);
  cholmod_l_free_triplet(&t, &common);
  cholmod_sparse* r = nullptr;
  const SuiteSparse_long rank =
      SuiteSparseQR<double>(SPQR_ORDERING_DEFAULT, SPQR_DEFAULT_TOL, 0, a, &r, nullptr, &common);
  cholmod_l_free_sparse(&r, &common);
  cholmod_l_free_sparse(&a, &common);
  cholmod_l_finish(&common);
  return g.columns() - rank;
}

// L D L^T of G^T G in which CHOLMOD replaces pivots below a threshold (relative to the largest diagonal) by it; the
// number of pivots replaced is K.
std::int64_t cholesky_floppy(const RigidityMatrix& g, double threshold) {
  SymmetricMatrix a = weighted_normal_matrix(g, std::vector<double>(static_cast<std::size_t>(g.rows()), 1.0));
  double top = 0;
  for (double v : a.value) top = std::max(top, v);
  cholmod_common common;
  cholmod_start(&common);
  common.supernodal = CHOLMOD_SIMPLICIAL;
  common.print = 0;
  common.dbound = threshold * top;
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(a.size);
  view.nzmax = a.row.size();
  view.p = a.start.data(), view.i = a.row.data(), view.x = a.value.data();
  view.stype = -1, view.itype = CHOLMOD_INT, view.xtype = CHOLMOD_REAL, view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1, view.packed = 1;
  cholmod_factor* f = cholmod_analyze(&view, &common);
  cholmod_factorize(&view, f, &common);
  const auto replaced = static_cast<std::int64_t>(common.ndbounds_hit);
  cholmod_free_factor(&f, &common);
  cholmod_finish(&common);
  return replaced;
}

}  // namespace

int main(int argc, char** argv) {
  const double largest = argc > 1 ? std::atof(argv[1]) : 5600;
  const int networks = argc > 2 ? std::atoi(argv[2]) : 20;
  std::printf("N,coordination,method,networks,wrong,mean_seconds\n");
  for (double n : {400.0, 1400.0, 5600.0, 22400.0}) {
    if (n > largest) break;
    for (double z : {3.0, 3.4}) {
      std::map<std::string, std::pair<int, double>> tally;  // wrong, seconds
      for (int k = 0; k < networks; ++k) {
        RandomNetwork o;
        o.columns = o.rows = static_cast<int>(std::lround(std::sqrt(n)));
        o.coordination = z, o.distant = 0.01, o.seed = static_cast<std::uint64_t>(k) + 1;
        const Packing<2> p = random_network(o);
        auto t = std::chrono::steady_clock::now();
        const ExactRank exact = exact_rank(p, NetworkLaw::friction, true);
        tally["exact"].second += since(t), tally["exact"].first += !exact.certified;
        const RigidityMatrix g = rigidity_matrix(p, NetworkLaw::friction, true);
        t = std::chrono::steady_clock::now();
        tally["spqr"].first += spqr_floppy(g) != exact.floppy;
        tally["spqr"].second += since(t);
        for (double threshold : {1e-8, 1e-10, 1e-12}) {
          char name[40];
          std::snprintf(name, sizeof name, "cholesky_%.0e", threshold);
          t = std::chrono::steady_clock::now();
          tally[name].first += cholesky_floppy(g, threshold) != exact.floppy;
          tally[name].second += since(t);
        }
      }
      for (const auto& [name, value] : tally)
        std::printf("%.0f,%.1f,%s,%d,%d,%.5f\n", n, z, name.c_str(), networks, value.first, value.second / networks);
      std::fflush(stdout);
    }
  }
}
