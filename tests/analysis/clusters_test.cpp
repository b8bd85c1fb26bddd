#include "analysis/rigidity/clusters.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <set>

#include "analysis/rigidity/exact_rank.hpp"
#include "analysis/rigidity/rigidity_matrix.hpp"
#include "dem/files/network_file.hpp"
#include "tests/support/random_network.hpp"

namespace isostat {
namespace {

Packing<2> cluster(const char* name) {
  return read_network<2>(std::string(ISOSTAT_DATA "/clusters/") + name + ".net").packing;
}

std::vector<std::int64_t> sizes(const RigidClusters& c) {
  std::vector<std::int64_t> s;
  for (const auto& k : c.clusters) s.push_back(k.grains);
  return s;
}

TEST(RigidClusters, CanonicalCases) {
  using V = std::vector<std::int64_t>;
  EXPECT_EQ(sizes(rigid_clusters(cluster("double_triangle"), NetworkLaw::friction, false)), (V{4}));
  EXPECT_EQ(rigid_clusters(cluster("double_triangle"), NetworkLaw::friction, false).clusters[0].hyperstatic, 1);
  EXPECT_EQ(sizes(rigid_clusters(cluster("hinge_triangles"), NetworkLaw::friction, false)), (V{5}));
  EXPECT_EQ(sizes(rigid_clusters(cluster("hinge_triangles"), NetworkLaw::frictionless, false)), (V{3, 3}));
  EXPECT_EQ(sizes(rigid_clusters(cluster("ring5"), NetworkLaw::friction, false)), (V{}));
  EXPECT_EQ(sizes(rigid_clusters(cluster("ring5"), NetworkLaw::rolling, false)), (V{5}));
  EXPECT_EQ(sizes(rigid_clusters(cluster("pair"), NetworkLaw::friction, false)), (V{}));
  EXPECT_EQ(sizes(rigid_clusters(cluster("pair"), NetworkLaw::frictionless, false)), (V{2}));
  // Disk 3 of sliding_spin spins freely: not in the cluster.
  EXPECT_EQ(sizes(rigid_clusters(cluster("sliding_spin"), NetworkLaw::friction, false)), (V{3}));
  const auto lattice = rigid_clusters(cluster("periodic_triangular4"), NetworkLaw::friction, false);
  ASSERT_EQ(lattice.clusters.size(), 1u);
  EXPECT_EQ(lattice.clusters[0].spans, (std::array<bool, 3>{true, true}));
  EXPECT_EQ(lattice.clusters[0].hyperstatic, 14);
  const auto chain = rigid_clusters(cluster("periodic_chain"), NetworkLaw::rolling, true);
  ASSERT_EQ(chain.clusters.size(), 1u);
  EXPECT_EQ(chain.clusters[0].spans, (std::array<bool, 3>{true, false}));
}

// Oracle: two linked grains are rigidly connected if every null vector of the dense G moves them as one.
TEST(RigidClusters, EqualDenseNullSpace) {
  int hinges = 0, inside = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    RandomNetwork o;
    o.columns = 6, o.rows = 6, o.seed = seed, o.periodic = seed % 2 == 0,
    o.coordination = 2.6 + 0.02 * static_cast<double>(seed);
    if (seed % 3 == 0) o.sliding = 0.1, o.rolling_yielded = 0.1;
    const Packing<2> p = random_network(o);
    for (const NetworkLaw law : {NetworkLaw::friction, NetworkLaw::rolling}) {
      const bool cell_free = o.periodic && seed % 4 == 0;
      const RigidityMatrix g = rigidity_matrix(p, law, cell_free);
      Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(std::max(g.rows(), g.columns()), g.columns());
      for (Eigen::Index r = 0; r < g.rows(); ++r)
        for (auto e = g.row_start[static_cast<std::size_t>(r)]; e < g.row_start[static_cast<std::size_t>(r) + 1]; ++e)
          dense(r, g.column[static_cast<std::size_t>(e)]) = g.value[static_cast<std::size_t>(e)];
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(dense, Eigen::ComputeFullV);
      const Eigen::Index k = exact_rank(p, law, cell_free).floppy;
      const Eigen::MatrixXd null = svd.matrixV().rightCols(k);
      const RigidClusters found = rigid_clusters(p, law, cell_free);
      for (std::size_t l = 0; l < p.links.size(); ++l) {
        const Link<2>& link = p.links[l];
        Vec2 r =
            p.bodies.position[static_cast<std::size_t>(link.j)] - p.bodies.position[static_cast<std::size_t>(link.i)];
        if (p.cell) r += p.cell->offset(link.shift);
        double worst = 0;
        for (Eigen::Index m = 0; m < k; ++m) {
          const auto x = null.col(m);
          const Eigen::Index i = 3 * link.i, j = 3 * link.j;
          const double e1 = cell_free ? x[g.layout.strain_column(0)] : 0,
                       e2 = cell_free ? x[g.layout.strain_column(1)] : 0;
          worst = std::max({worst, std::abs(x[i + 2] - x[j + 2]), std::abs(x[j] - x[i] - e1 * r[0] + x[i + 2] * r[1]),
                            std::abs(x[j + 1] - x[i + 1] - e2 * r[1] - x[i + 2] * r[0])});
        }
        const bool together = found.cluster_of_link[l] >= 0;
        EXPECT_EQ(together, worst < 1e-8) << "seed " << seed << " link " << l << " " << worst;
        (together ? inside : hinges)++;
      }
      std::int64_t sum = 0;
      for (const auto& c : found.clusters) sum += c.hyperstatic;
      EXPECT_LE(sum, exact_rank(p, law, cell_free).hyperstatic);
    }
  }
  EXPECT_GT(hinges, 300);
  EXPECT_GT(inside, 300);
}

}  // namespace
}  // namespace isostat
