// The Matrix Market files, read again by the slow hand: K = G^T k G, K u = omega^2 M u, and what rows and columns are.
#include "analysis/stiffness/matrix_files.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>
#include <sstream>

#include "analysis/rigidity/rigidity_matrix.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "dem/files/network_file.hpp"
#include "tests/support/random_network.hpp"
#include "tests/support/random_spheres.hpp"

namespace isostat {
namespace {

using Files = std::map<std::string, std::string>;

Eigen::MatrixXd read(const std::string& text) {
  std::istringstream in(text);
  std::string banner, word, form, field, symmetry;
  in >> banner >> word >> form >> field >> symmetry;
  EXPECT_EQ(banner + word + field, "%%MatrixMarketmatrixreal");
  Eigen::Index rows = 0, columns = 0, entries = 0;
  in >> rows >> columns;
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(rows, columns);
  if (form == "array") {
    for (Eigen::Index c = 0; c < columns; ++c)
      for (Eigen::Index r = 0; r < rows; ++r) in >> m(r, c);
  } else {
    in >> entries;
    for (Eigen::Index e = 0; e < entries; ++e) {
      Eigen::Index r = 0, c = 0;
      double value = 0;
      in >> r >> c >> value;
      m(r - 1, c - 1) = value;
      if (symmetry == "symmetric") {
        EXPECT_GE(r, c);
        m(c - 1, r - 1) = value;
      }
    }
  }
  EXPECT_TRUE(in);
  EXPECT_FALSE(in >> word);  // nothing is left
  return m;
}

std::vector<std::map<std::string, std::string>> table(const std::string& text) {
  const auto cells = [](const std::string& line) {
    std::vector<std::string> all;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) all.push_back(cell);
    return all;
  };
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  const auto names = cells(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(in, line)) {
    const auto values = cells(line);
    EXPECT_EQ(values.size(), names.size()) << line;
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = values[k];
  }
  return rows;
}

void expect_consistent(const Files& files) {
  const Eigen::MatrixXd g = read(files.at("G.mtx")), k = read(files.at("K.mtx")), m = read(files.at("M.mtx"));
  const auto rows = table(files.at("rows.csv")), columns = table(files.at("columns.csv"));
  ASSERT_EQ(std::ssize(rows), g.rows());
  ASSERT_EQ(std::ssize(columns), g.cols());
  Eigen::VectorXd stiffness(g.rows());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    EXPECT_EQ(rows[r].at("row"), std::to_string(r + 1));
    stiffness[static_cast<Eigen::Index>(r)] = std::stod(rows[r].at("k"));
  }
  EXPECT_LT((g.transpose() * stiffness.asDiagonal() * g - k).cwiseAbs().maxCoeff(), 1e-12 * k.cwiseAbs().maxCoeff());
  EXPECT_EQ(m.rows(), g.cols());
  if (!files.contains("modes.mtx")) return;
  const Eigen::MatrixXd u = read(files.at("modes.mtx"));
  EXPECT_GT(u.cols(), 3);
  EXPECT_LT((u.transpose() * m * u - Eigen::MatrixXd::Identity(u.cols(), u.cols())).cwiseAbs().maxCoeff(), 1e-8);
  const Eigen::MatrixXd omega_squared = u.transpose() * k * u;
  for (Eigen::Index c = 0; c < u.cols(); ++c) {
    EXPECT_GT(omega_squared(c, c), 0);
    EXPECT_LT((k * u.col(c) - omega_squared(c, c) * m * u.col(c)).cwiseAbs().maxCoeff(),
              1e-7 * k.cwiseAbs().maxCoeff());
  }
}

AnalysisInput of(Packing<2> packing) {
  AnalysisInput input;
  input.path = "test";
  input.state.packing = std::move(packing);
  input.links_given = true;
  return input;
}

Files files_of(const AnalysisInput& input, const AnalysisOptions& options, bool modes) {
  const auto list = matrix_files(input, options, modes);
  return {list.begin(), list.end()};
}

TEST(MatrixFiles, OfANetworkOfDisks) {
  RandomNetwork o;
  o.columns = o.rows = 5, o.seed = 4, o.coordination = 4.4, o.periodic = true;
  o.sliding = o.rolling_yielded = 0.1;
  const AnalysisInput input = of(random_network(o));
  for (const NetworkLaw law : {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling}) {
    AnalysisOptions options;
    options.law = law;
    options.stiffness = {3, 2, 0.5};
    options.modes = std::nullopt;
    expect_consistent(files_of(input, options, true));
    options.cell_free = true;
    const Files free = files_of(input, options, false);
    expect_consistent(free);
    EXPECT_EQ(table(free.at("columns.csv")).back().at("component"), "strain_22");
  }
}

// A disk on another, to the right of it: n = x, t = y, and the row of N takes the velocities' difference.
TEST(MatrixFiles, RowsAndColumnsOfAPair) {
  const AnalysisInput input = of(read_network<2>(ISOSTAT_DATA "/clusters/pair.net").packing);
  const Files files = files_of(input, {}, false);
  const auto rows = table(files.at("rows.csv")), columns = table(files.at("columns.csv"));
  ASSERT_EQ(rows.size(), 2u);
  ASSERT_EQ(columns.size(), 6u);
  EXPECT_EQ(rows[0].at("component"), "N");
  EXPECT_EQ(rows[1].at("component"), "T");
  EXPECT_EQ(std::stod(rows[0].at("k")), 1e5);
  const Eigen::MatrixXd g = read(files.at("G.mtx")), m = read(files.at("M.mtx"));
  const Bodies<2>& b = input.state.packing.bodies;
  const Vec2 n = (1 / norm(b.position[1] - b.position[0])) * (b.position[1] - b.position[0]);
  for (int c = 0; c < 6; ++c) {
    const int body = c / 3;
    EXPECT_EQ(columns[static_cast<std::size_t>(c)].at("id"), std::to_string(b.id[static_cast<std::size_t>(body)]));
    const std::array<const char*, 3> names{"x", "y", "spin"};
    EXPECT_EQ(columns[static_cast<std::size_t>(c)].at("component"), names[static_cast<std::size_t>(c % 3)]);
    EXPECT_NEAR(g(0, c), c % 3 == 2 ? 0 : (body == 1 ? 1 : -1) * n[c % 3], 1e-15);
  }
  EXPECT_DOUBLE_EQ(m(0, 0), b.mass[0]);
  EXPECT_DOUBLE_EQ(m(5, 5), b.inertia[1]);
  EXPECT_EQ(m(5, 4), 0);
}

TEST(MatrixFiles, OfSpheresInTheFramesOfTheirContacts) {
  AnalysisInput input;
  input.path = "test";
  static_cast<Packing<3>&>(input.packing_3d.emplace()) = random_spheres({.coordination = 7, .distant = 0.1, .seed = 3});
  input.links_given = true;
  AnalysisOptions options;
  options.law = NetworkLaw::rolling;
  const Files files = files_of(input, options, false);
  expect_consistent(files);
  const auto rows = table(files.at("rows.csv"));
  for (std::size_t r = 0; r + 2 < rows.size(); ++r) {
    if (rows[r].at("component") != "N" || rows[r + 1].at("component") != "T") continue;
    const auto axis = [&](std::size_t row) {
      return Vec3{{std::stod(rows[row].at("nx")), std::stod(rows[row].at("ny")), std::stod(rows[row].at("nz"))}};
    };
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) EXPECT_NEAR(dot(axis(r + a), axis(r + b)), a == b, 1e-14);
  }
}

}  // namespace
}  // namespace isostat
