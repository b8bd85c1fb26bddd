// Density of states by the kernel polynomial method. Oracle: dense eigenvalues of the whole.
#include "analysis/stiffness/density_of_states.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/ensemble.hpp"
#include "analysis/report.hpp"
#include "analysis/report_text.hpp"
#include "analysis/rigidity/independent_columns.hpp"
#include "analysis/stiffness/sphere_stiffness.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "geometry/base/index.hpp"
#include "tests/support/random_network.hpp"
#include "tests/support/random_spheres.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

struct Vibrations {
  SymmetricMatrix a;
  std::int64_t zero = 0;
  bool definite = true;
};

Packing<2> network(double z, int size, double distant = 0, std::uint64_t seed = 3) {
  RandomNetwork o;
  o.columns = o.rows = size, o.seed = seed, o.coordination = z, o.distant = distant;
  return random_network(o);
}

Vibrations of(const Packing<2>& p, NetworkLaw law) {
  const RigidityMatrix g = rigidity_matrix(p, law, false);
  const auto k = row_stiffness(p, g, default_network_law());
  const auto dependent = dependent_columns(p, law, false);
  return {mass_scaled(weighted_normal_matrix(g, k), dof_masses(p, law)),
          std::count(dependent.begin(), dependent.end(), 1),
          std::all_of(k.begin(), k.end(), [](double v) { return v > 0; })};
}
Vibrations of(const Packing<3>& p, NetworkLaw law) {
  const auto dependent = dependent_columns(p, law, false);
  return {mass_scaled(stiffness_matrix(p, law, false, by_link(p, UniformStiffness{})), dof_masses(p, law)),
          std::count(dependent.begin(), dependent.end(), 1), true};
}

Eigen::VectorXd spectrum(const SymmetricMatrix& a) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(a.size, a.size);
  for (std::int32_t c = 0; c < a.size; ++c)
    for (auto e = idx(a.start[idx(c)]); e < idx(a.start[idx(c) + 1]); ++e) d(a.row[e], c) = d(c, a.row[e]) = a.value[e];
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(d, Eigen::EigenvaluesOnly).eigenvalues();
}

// sum of T_n(x) over the spectrum.
std::vector<double> traces(const Eigen::VectorXd& lambda, const SpectrumBounds& bounds, std::size_t count) {
  std::vector<double> t(count, 0.0);
  for (const double value : lambda)
    for (std::size_t n = 0; n < count; ++n)
      t[n] += std::cos(static_cast<double>(n) * std::acos(std::clamp(bounds.mapped(value), -1.0, 1.0)));
  return t;
}

TEST(SpectrumBounds, HoldTheSpectrumClosely) {
  for (const double distant : {0.0, 0.3})
    for (const double z : {1.0, 3.5, 5.5}) {
      const Vibrations v = of(network(z, 14, distant), NetworkLaw::friction);
      const Eigen::VectorXd lambda = spectrum(v.a);
      const SpectrumBounds b = spectrum_bounds(v.a, v.definite);
      const double top = lambda.maxCoeff(), bottom = std::min(lambda.minCoeff(), 0.0), width = top - bottom;
      EXPECT_GE(b.high, top);
      EXPECT_LE(b.high, top + 0.03 * width);
      if (v.definite) {
        EXPECT_EQ(b.low, 0);
      } else {
        EXPECT_LE(b.low, bottom);
        EXPECT_GE(b.low, bottom - 0.03 * width);
      }
    }
}

// Unit vectors see every diagonal entry once: their moments add up to the trace itself.
TEST(ChebyshevMoments, OfUnitVectorsAreTheTrace) {
  constexpr std::size_t count = 101;
  for (const double distant : {0.0, 0.3}) {
    const Vibrations v = of(network(3.2, 8, distant), NetworkLaw::rolling);
    const SpectrumBounds b = spectrum_bounds(v.a, v.definite);
    const auto n = idx(v.a.size);
    const auto unit = [](std::size_t vector, std::size_t component) { return vector == component ? 1.0 : 0.0; };
    const auto moments = chebyshev_moments(v.a, b, count, n, unit);
    ASSERT_TRUE(moments);
    const std::vector<double> expected = traces(spectrum(v.a), b, count);
    for (std::size_t m = 0; m < count; ++m) {
      double sum = 0;
      for (const auto& of_vector : *moments) sum += of_vector[m];
      EXPECT_NEAR(sum, expected[m], 1e-10 * static_cast<double>(n)) << m;
    }
  }
}

TEST(ChebyshevMoments, AreThoseOfEachVectorAlone) {
  const Vibrations v = of(network(4.2, 10), NetworkLaw::friction);
  const SpectrumBounds b = spectrum_bounds(v.a, true);
  const auto all = chebyshev_moments(v.a, b, 64, 7, random_sign);
  for (std::size_t r = 0; r < 7; ++r)
    EXPECT_EQ(chebyshev_moments(v.a, b, 64, 1, [&](auto, auto i) { return random_sign(r, i); })->at(0), all->at(r));
  EXPECT_EQ(chebyshev_moments(v.a, b, 33, 7, random_sign)->at(2),
            std::vector<double>(all->at(2).begin(), all->at(2).begin() + 33));
}

TEST(ChebyshevMoments, SayThatTheSpectrumReachesBeyondItsBounds) {
  const Vibrations v = of(network(4.2, 10), NetworkLaw::friction);
  SpectrumBounds b = spectrum_bounds(v.a, true);
  b.high *= 0.9;
  EXPECT_FALSE(chebyshev_moments(v.a, b, 200, 1, random_sign));
}

TEST(SmoothedCounts, OfOneEigenvalueIsAStepAsWideAsThePageSays) {
  constexpr std::size_t count = 500;
  const SpectrumBounds b{0, 4};
  const double sd = std::numbers::pi / count;
  for (const double at : {0.0, 0.5, 2.0}) {
    const double angle = std::acos(b.mapped(at));
    std::vector<double> moments;
    for (std::size_t n = 0; n < count; ++n) moments.push_back(std::cos(static_cast<double>(n) * angle));
    const auto below = [&](double of) {
      return smoothed_counts({moments}, count, b, {2 + 2 * std::cos(std::min(of, std::numbers::pi))})[0][0];
    };
    // Within one and three standard deviations as a Gaussian, whose other half folds back at the end of the spectrum.
    EXPECT_NEAR(below(angle - sd) - below(angle + sd), std::erf(std::sqrt(0.5)), 0.02) << at;
    EXPECT_NEAR(below(angle - 3 * sd) - below(angle + 3 * sd), std::erf(3 * std::sqrt(0.5)), 0.01) << at;
    EXPECT_NEAR(below(0), 1, 1e-12);
    double last = 0;
    for (double of = std::numbers::pi; of >= 0; of -= 0.01) {
      EXPECT_GE(below(of), last - 1e-12);
      last = below(of);
    }
  }
}

// The exact number of modes below each edge lies between those that the kernel sees three of its widths before and
// after, but for the scatter of the vectors; and the scatter is as large as it says, against the exact trace.
void expect_exact_within_errors(const Vibrations& v, int bins, int vectors, const char* what) {
  DensityOptions options;
  options.bins = bins, options.vectors = vectors;
  const DensityOfStates d = density_of_states(v.a, v.definite, v.zero, options);
  ASSERT_GT(d.edges.size(), idx(bins) / 4);
  ASSERT_LE(d.edges.size(), idx(bins) + 1);
  const Eigen::VectorXd lambda = spectrum(v.a);
  std::vector<double> omega(lambda.begin(), lambda.end());
  std::sort(omega.begin(), omega.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  std::vector<double> moving(omega.begin() + v.zero, omega.end());
  for (double& w : omega) w = std::copysign(std::sqrt(std::abs(w)), w);
  for (std::size_t k = 0; k < idx(v.zero); ++k) omega[k] = 0;
  std::sort(omega.begin(), omega.end());
  const auto exact = [&](double to) {
    return static_cast<double>(std::upper_bound(omega.begin(), omega.end(), to) - omega.begin());
  };
  const Eigen::VectorXd vibrating = Eigen::Map<const Eigen::VectorXd>(moving.data(), std::ssize(moving));
  const std::vector<double> trace = traces(vibrating, d.bounds, idx(d.moments));
  double sum = 0, chi = 0, terms = 0;
  for (std::size_t k = 0; k + 1 < d.edges.size(); ++k) {
    const double left = d.edges[k], right = d.edges[k + 1];
    sum += d.density[k] * (right - left);
    const auto squared = [](double w) { return std::copysign(w * w, w); };
    const auto smooth = smoothed_counts({trace}, idx(d.moments), d.bounds, {squared(left), squared(right)})[0];
    const double expected = (smooth[1] - smooth[0]) / (right - left);
    EXPECT_NEAR(d.density[k], expected, 6 * d.error[k] + 1e-9 * std::abs(expected)) << what << ' ' << left;
    EXPECT_NEAR(d.below[k], smooth[1] + (right >= 0 ? static_cast<double>(v.zero) : 0),
                6 * d.below_error[k] + 1e-8 * static_cast<double>(d.dofs));
    if (expected * (right - left) > 5) chi += std::pow((d.density[k] - expected) / d.error[k], 2), ++terms;
    const double near = 3 * d.resolution;
    if (std::abs(right) < near && !v.definite) continue;  // zero modes are smeared to both sides, and taken out
    EXPECT_GE(d.below[k], exact(right - near) - 6 * d.below_error[k] - 1.5) << what << ' ' << right;
    EXPECT_LE(d.below[k], exact(right + near) + 6 * d.below_error[k] + 1.5) << what << ' ' << right;
  }
  EXPECT_NEAR(sum, static_cast<double>(d.dofs - v.zero), 1e-8 * static_cast<double>(d.dofs)) << what;
  ASSERT_GT(terms, 10) << what;
  EXPECT_GT(chi / terms, 0.4) << what;  // neighbouring bins share their vectors: few are independent
  EXPECT_LT(chi / terms, 2.5) << what;
}

TEST(DensityOfStates, IsExactWithinItsErrors) {
  for (const NetworkLaw law : {NetworkLaw::frictionless, NetworkLaw::friction, NetworkLaw::rolling})
    for (const double z : {2.6, 4.5}) expect_exact_within_errors(of(network(z, 18), law), 60, 24, "disks");
  expect_exact_within_errors(of(network(4.5, 18, 0.1), NetworkLaw::friction), 60, 24, "distant pairs");
  RandomSpheres o;
  o.size = {6, 6, 6};
  for (const double z : {4.0, 8.0}) {
    o.coordination = z;
    expect_exact_within_errors(of(random_spheres(o), NetworkLaw::frictionless), 60, 24, "spheres");
  }
}

// Grains that touch nothing are zero modes that random signs find without scatter: they change nothing at all.
TEST(DensityOfStates, OfGrainsThatTouchNothingHasNoNoise) {
  Packing<2> p = network(4.2, 10);
  const Vibrations alone = of(p, NetworkLaw::friction);
  const auto n = p.bodies.size();
  p.bodies.resize(4 * n);
  for (std::size_t k = n; k < 4 * n; ++k) {
    p.bodies.id[k] = static_cast<std::int64_t>(k);
    p.bodies.position[k] = {{0.01 * static_cast<double>(k), 0.5}};
    p.bodies.radius[k] = 1e-4, p.bodies.mass[k] = 1, p.bodies.inertia[k] = 0.125;
  }
  const Vibrations among = of(p, NetworkLaw::friction);
  EXPECT_EQ(among.zero, alone.zero + 9 * static_cast<std::int64_t>(n));
  const SpectrumBounds b = spectrum_bounds(alone.a, true);
  const auto few = *chebyshev_moments(alone.a, b, 200, 3, random_sign),
             many = *chebyshev_moments(among.a, b, 200, 3, random_sign);
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t m = 0; m < 200; ++m)
      EXPECT_NEAR(many[r][m] - few[r][m], 9.0 * static_cast<double>(n) * (m % 2 == 0 ? 1 : -1), 1e-8);

  p.links.clear();
  const DensityOfStates none = density_of_states(of(p, NetworkLaw::friction).a, true, 1200, {});
  EXPECT_TRUE(none.edges.empty());
  EXPECT_EQ(none.dofs, 1200);
}

AnalysisInput input_of(std::uint64_t seed) {
  AnalysisInput input;
  input.path = "test", input.links_given = true;
  input.state.packing = network(4.2, 10, 0, seed);
  return input;
}

TEST(DensityOfStates, StandsInTheReportInsteadOfTheModes) {
  AnalysisOptions options;
  options.density = DensityOptions{.bins = 40};
  options.modes = 0;
  const AnalysisInput input = input_of(3);
  const Json modes = analyze(input, options, {"modes"})["modes"];
  EXPECT_TRUE(modes["omega"].is_null());
  EXPECT_EQ(modes["degrees_of_freedom"], 300);
  options.modes = std::nullopt;
  const Json both = analyze(input, options, {"modes"})["modes"];
  EXPECT_EQ(both["density"], modes["density"]);
  EXPECT_EQ(both["zero_modes"], modes["zero_modes"]);
  EXPECT_EQ(both["omega"].size() + both["zero_modes"].get<std::size_t>(), 300u);
  EXPECT_LT(both["omega"].back(), modes["density"]["omega_max"]);
}

TEST(DensityOfStates, OfSeveralInputsIsTheMeanByBin) {
  AnalysisOptions options;
  options.density = DensityOptions{.bins = 50};
  options.modes = 0;
  std::vector<Json> reports;
  for (const std::uint64_t seed : {3, 4}) reports.push_back(analyze(input_of(seed), options, {"modes"}));
  const auto histogram = [](const Json& r) { return r["modes"]["density"]["histogram"]; };
  ASSERT_EQ(histogram(reports[0])["edges"][1], histogram(reports[1])["edges"][1]) << "of one width";
  const Json merged = merge_reports(reports), h = histogram(merged);
  for (std::size_t k = 0; k < 10; ++k) {
    const double first = histogram(reports[0])["density"][k], second = histogram(reports[1])["density"][k];
    EXPECT_NEAR(h["density"][k]["mean"].get<double>(), (first + second) / 2, 1e-12 * std::abs(first));
    EXPECT_TRUE(h["below"][k].contains("se"));
  }
  const auto files = report_as_csv(merged);
  const auto found =
      std::find_if(files.begin(), files.end(), [](const auto& f) { return f.first == "modes.density.histogram.csv"; });
  ASSERT_NE(found, files.end());
  EXPECT_TRUE(found->second.starts_with("left,right,density,density_sd,density_se,error,error_sd,error_se,"));
}

}  // namespace
}  // namespace isostat
