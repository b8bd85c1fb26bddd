#include "dem/triangles/grain_spectrum.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/state/beam.hpp"
#include "dem/state/link.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

// Three rows of G a beam: a unit link force, and the loads it puts on the bodies (dx, dy, dtheta of i, then of j).
struct BeamRows {
  std::array<std::array<double, 6>, 3> load;
  std::array<double, 3> stiffness, damping;
};

BeamRows rows_of(const GrainTemplate& grain, const GrainBeam& b) {
  const Vec2 chord = grain.triangles[idx(b.j)].centroid - grain.triangles[idx(b.i)].centroid;
  const double half = b.beam.rest_length / 2;
  const LinkFrame<double> frame = link_frame(chord[0], chord[1], half, half);
  const BeamStiffness k = beam_stiffness(b.beam, frame.distance);
  const BeamDamping c = beam_damping(b.beam, grain.material.damping, frame.distance);
  BeamRows rows{{}, {k.normal, k.tangential, k.rolling}, {c.normal, c.tangential, c.rolling}};
  for (std::size_t r = 0; r < 3; ++r) {
    const LinkLoad<double> l = link_load(frame, r == 0 ? 1.0 : 0.0, r == 1 ? 1.0 : 0.0, r == 2 ? 1.0 : 0.0);
    rows.load[r] = {-l.fx, -l.fy, l.moment_i, l.fx, l.fy, l.moment_j};
  }
  return rows;
}

std::size_t dof(const GrainBeam& b, std::size_t k) { return 3 * idx(k < 3 ? b.i : b.j) + k % 3; }

double mass_of(const GrainTemplate& grain, std::size_t d) {
  const GrainTriangle& t = grain.triangles[d / 3];
  return d % 3 == 2 ? t.inertia : t.mass;
}

}  // namespace

GrainMatrices grain_matrices(const GrainTemplate& grain) {
  GrainMatrices m;
  const std::size_t n = m.size = 3 * grain.triangles.size();
  m.stiffness.assign(n * n, 0), m.damping.assign(n * n, 0);
  for (std::size_t d = 0; d < n; ++d) m.mass.push_back(mass_of(grain, d));
  for (const GrainBeam& b : grain.beams) {
    const BeamRows rows = rows_of(grain, b);
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t p = 0; p < 6; ++p)
        for (std::size_t q = 0; q < 6; ++q) {
          const double product = rows.load[r][p] * rows.load[r][q];
          m.stiffness[dof(b, p) * n + dof(b, q)] += rows.stiffness[r] * product;
          m.damping[dof(b, p) * n + dof(b, q)] += rows.damping[r] * product;
        }
  }
  return m;
}

std::vector<double> grain_frequencies(const GrainTemplate& grain) {
  const std::size_t n = 3 * grain.triangles.size();
  std::vector<double> omega(n, 0.0);
  if (grain.beams.empty()) return omega;
  Eigen::MatrixXd scaled =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * grain.beams.size()), static_cast<Eigen::Index>(n));
  for (std::size_t e = 0; e < grain.beams.size(); ++e) {
    const GrainBeam& b = grain.beams[e];
    const BeamRows rows = rows_of(grain, b);
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t p = 0; p < 6; ++p) {
        const std::size_t d = dof(b, p);
        scaled(static_cast<Eigen::Index>(3 * e + r), static_cast<Eigen::Index>(d)) =
            std::sqrt(rows.stiffness[r] / mass_of(grain, d)) * rows.load[r][p];
      }
  }
  const Eigen::VectorXd values = Eigen::BDCSVD<Eigen::MatrixXd>(scaled).singularValues();  // descending
  const double zero = static_cast<double>(n) * std::numeric_limits<double>::epsilon() * values[0];
  for (Eigen::Index k = 0; k < values.size() && idx(k) < n; ++k)
    if (values[k] > zero) omega[n - 1 - idx(k)] = values[k];
  return omega;
}

}  // namespace isostat
