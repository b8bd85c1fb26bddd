#include "analysis/stiffness/prestressed_modes.hpp"

#include <Spectra/GenEigsRealShiftSolver.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "analysis/stiffness/link_tangent.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "geometry/union_find.hpp"

namespace isostat {
namespace {

using Complex = std::complex<double>;

// -kShift times the largest diagonal entry: far below the lowest modes of a packing (a wave across 1e3 grains has
// omega^2 near 1e-5 of it), far above rounding; below zero, where stable packings have no eigenvalue.
constexpr double kShift = 1e-8;
constexpr Eigen::Index kMostRestarts = 1000;
constexpr double kArnoldiTolerance = 1e-10;  // relative, of 1 / (omega^2 - shift)

struct Pair {
  Complex value;
  double residual;
};

// Mass-scaled tangent of one piece. Translations, scaled: orthonormal columns q with A q = 0 (moving all changes
// nothing) and q^T A = 0 (the forces of a link are opposite).
struct Piece {
  UnsymmetricMatrix tangent;
  Eigen::MatrixXd translations;
  double diagonal = 0;  // largest

  double residual_of(const Eigen::VectorXcd& u, Complex lambda) const {
    const Eigen::VectorXd re = u.real(), im = u.imag();
    const auto a_re = tangent.multiply({re.data(), re.data() + re.size()}),
               a_im = tangent.multiply({im.data(), im.data() + im.size()});
    double sum = 0;
    for (Eigen::Index i = 0; i < u.size(); ++i)
      sum += std::norm(Complex(a_re[static_cast<std::size_t>(i)], a_im[static_cast<std::size_t>(i)]) - lambda * u[i]);
    return diagonal > 0 ? std::sqrt(sum) / u.norm() / diagonal : 0;
  }
};

std::vector<Pair> dense_pairs(const Piece& piece) {
  const auto n = static_cast<Eigen::Index>(piece.tangent.size), held = piece.translations.cols();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index c = 0; c < n; ++c)
    for (auto e = static_cast<std::size_t>(piece.tangent.start[static_cast<std::size_t>(c)]);
         e < static_cast<std::size_t>(piece.tangent.start[static_cast<std::size_t>(c) + 1]); ++e)
      a(piece.tangent.row[e], c) = piece.tangent.value[e];
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(n, n - held);  // the columns of Q beside the translations
  rest.bottomRows(n - held).setIdentity();
  if (held > 0) rest.applyOnTheLeft(Eigen::HouseholderQR<Eigen::MatrixXd>(piece.translations).householderQ());
  std::vector<Pair> pairs;
  if (rest.cols() == 0) return pairs;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(rest.transpose() * a * rest);
  for (Eigen::Index k = 0; k < rest.cols(); ++k)
    pairs.push_back(
        {solver.eigenvalues()[k], piece.residual_of(rest * solver.eigenvectors().col(k), solver.eigenvalues()[k])});
  return pairs;
}

// Operator type of Spectra: (A - sigma)^-1 with the translations projected out on both sides.
class ShiftedInverse {
 public:
  using Scalar = double;
  explicit ShiftedInverse(const Piece& piece) : piece_(piece) {}
  Eigen::Index rows() const { return piece_.tangent.size; }
  Eigen::Index cols() const { return rows(); }
  void set_shift(double sigma) {
    Triplets entries;
    for (std::int32_t c = 0; c < piece_.tangent.size; ++c) {
      for (auto e = static_cast<std::size_t>(piece_.tangent.start[static_cast<std::size_t>(c)]);
           e < static_cast<std::size_t>(piece_.tangent.start[static_cast<std::size_t>(c) + 1]); ++e)
        entries.add(piece_.tangent.row[e], c, piece_.tangent.value[e]);
      entries.add(c, c, -sigma);
    }
    shifted_ = assemble(piece_.tangent.size, entries);
    factor_ = std::make_unique<UnsymmetricLu>(shifted_);
  }
  void perform_op(const double* x, double* y) const {
    const std::vector<double> solved =
        factor_->solve(without_translations(Eigen::Map<const Eigen::VectorXd>(x, rows())));
    const std::vector<double> result = without_translations(Eigen::Map<const Eigen::VectorXd>(solved.data(), rows()));
    std::copy(result.begin(), result.end(), y);
  }
  std::vector<double> without_translations(const Eigen::VectorXd& x) const {
    const Eigen::VectorXd rest = x - piece_.translations * (piece_.translations.transpose() * x);
    return {rest.data(), rest.data() + rest.size()};
  }

 private:
  const Piece& piece_;
  UnsymmetricMatrix shifted_;
  std::unique_ptr<UnsymmetricLu> factor_;
};

std::vector<Pair> arnoldi_pairs(const Piece& piece, int count, double shift, bool& converged) {
  ShiftedInverse op(piece);
  const Eigen::Index wanted = std::min<Eigen::Index>(count + 1, piece.tangent.size - 4);
  const Eigen::Index subspace = std::min<Eigen::Index>(2 * wanted + 20, piece.tangent.size - 2);
  Spectra::GenEigsRealShiftSolver<ShiftedInverse> solver(op, wanted, subspace, shift);
  Eigen::VectorXd first(piece.tangent.size);
  for (Eigen::Index i = 0; i < first.size(); ++i) first[i] = std::sin(1.0 + 0.7 * static_cast<double>(i));
  const std::vector<double> start = op.without_translations(first);
  solver.init(start.data());
  solver.compute(Spectra::SortRule::LargestMagn, kMostRestarts, kArnoldiTolerance);
  converged = converged && solver.info() == Spectra::CompInfo::Successful;
  const Eigen::VectorXcd values = solver.eigenvalues();
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  std::vector<Pair> pairs;
  for (Eigen::Index k = 0; k < values.size(); ++k)
    pairs.push_back({values[k], piece.residual_of(vectors.col(k), values[k])});
  return pairs;
}

std::vector<std::vector<std::size_t>> linked_pieces(const LinkNetwork& network) {
  UnionFind joined(network.packing.bodies.size());
  std::vector<char> linked(network.packing.bodies.size(), 0);
  for (std::size_t l = 0; l < network.links(); ++l)
    network.each_bond(l, [&](std::int32_t a, std::int32_t b, const ImageShift<2>&) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      linked[i] = linked[j] = 1;
      joined.join(i, j);
    });
  // One pair of an overlap after the other: what one grain's side joins belongs together, too.
  for (const AreaLink& area : network.areas)
    for (const AreaPair& p : area.pairs)
      joined.join(static_cast<std::size_t>(p.i), static_cast<std::size_t>(area.pairs[0].i));
  auto pieces = joined.sets();
  std::erase_if(pieces, [&](const auto& piece) { return !linked[piece.front()]; });
  return pieces;
}

}  // namespace

PrestressedModes prestressed_modes(const LinkNetwork& network, NetworkLaw network_law, const DiskLaw& law, int count) {
  const auto per_body = static_cast<std::size_t>(dof_layout(network, network_law, false).per_body);
  const std::vector<double> mass = dof_masses(network, network_law);
  const UnsymmetricMatrix whole = tangent_stiffness(network, network_law, law);

  PrestressedModes modes;
  modes.antisymmetric_part = antisymmetric_part(whole);
  modes.unlinked_dofs = whole.size;
  std::vector<Pair> pairs;
  std::vector<std::int32_t> number(mass.size(), -1);
  for (auto& bodies : linked_pieces(network)) {
    const auto free = static_cast<std::size_t>(network.free);
    const bool held = bodies.back() >= free;  // then a translation is no motion without forces
    while (!bodies.empty() && bodies.back() >= free) bodies.pop_back();
    if (bodies.empty()) continue;
    ++modes.pieces;
    const std::size_t size = bodies.size() * per_body;
    modes.unlinked_dofs -= static_cast<std::int64_t>(size);
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (std::size_t d = 0; d < per_body; ++d)
        number[bodies[b] * per_body + d] = static_cast<std::int32_t>(b * per_body + d);
    Piece piece;
    piece.tangent.size = static_cast<std::int32_t>(size);
    piece.tangent.start.push_back(0);
    piece.translations = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(size), held ? 0 : 2);
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (std::size_t d = 0; d < per_body; ++d) {
        const std::size_t c = bodies[b] * per_body + d;
        if (d < 2 && !held) piece.translations(number[c], static_cast<Eigen::Index>(d)) = std::sqrt(mass[c]);
        for (auto e = static_cast<std::size_t>(whole.start[c]); e < static_cast<std::size_t>(whole.start[c + 1]); ++e) {
          const auto r = static_cast<std::size_t>(whole.row[e]);
          piece.tangent.row.push_back(number[r]);
          piece.tangent.value.push_back(whole.value[e] / std::sqrt(mass[r] * mass[c]));
          if (r == c) piece.diagonal = std::max(piece.diagonal, std::abs(piece.tangent.value.back()));
        }
        piece.tangent.start.push_back(static_cast<std::int32_t>(piece.tangent.row.size()));
      }
    if (!held) piece.translations.col(0).normalize(), piece.translations.col(1).normalize();

    const bool dense = size <= kDensePiece;
    if (!dense) modes.shift = std::min(modes.shift, -kShift * piece.diagonal);
    const auto found =
        dense ? dense_pairs(piece) : arnoldi_pairs(piece, count, -kShift * piece.diagonal, modes.converged);
    pairs.insert(pairs.end(), found.begin(), found.end());
  }

  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
    const double a = std::norm(x.value), b = std::norm(y.value);  // equal for conjugates: those stay together
    return a != b ? a < b : x.value.imag() > y.value.imag();
  });
  for (const Pair& pair : pairs) {
    const auto kept = modes.omega_squared.size();
    const bool completes = kept > 0 && pair.value.imag() != 0 && pair.value == std::conj(modes.omega_squared.back());
    if (kept >= static_cast<std::size_t>(count) && !completes) break;
    modes.omega_squared.push_back(pair.value), modes.residual.push_back(pair.residual);
    if (kept + 1 > static_cast<std::size_t>(count)) break;
  }
  return modes;
}

}  // namespace isostat
