// isostat lab soft-laws: the laws of soft-particles, measured from the smallest decade of sizes upward (seed 000, Secs.
// 1, 2): those of a level hold grains of their decade and, above the first level, soft-particles of the level below.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "analysis/constitutive/soft_law_fit.hpp"
#include "apps/commands.hpp"
#include "apps/json_output.hpp"
#include "apps/lab/experiments.hpp"
#include "apps/lab/soft_laws.hpp"
#include "apps/lab/soft_measurement.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<double> kAtWall{0.05, 0.1, 0.15, 0.2, 0.25, 0.3}, kAtSoft{0.1, 0.15, 0.2, 0.25, 0.3, 0.35},
    kAtLast{0.2, 0.3};
const std::vector<double> kTurn{-4, 4};  // [degrees] of k_t: PHYSICS.md sec. 3
constexpr double kSliding = 25;          // [degrees] beyond which Ft/Fn is saturated
const std::vector<double> kBalls{0.25, 0.5, 1, 2,
                                 4};  // [R_s] radii of the partner from which the curvature's part is read

struct Team {
  std::size_t packings = 7;
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

template <class Get>
std::vector<std::vector<double>> columns(const std::vector<SoftMeasurement>& all, Get get) {
  std::vector<std::vector<double>> samples;
  for (const SoftMeasurement& m : all) samples.push_back(get(m));
  return samples;
}

std::vector<double> forces_of(const SoftMeasurement& m) {
  std::vector<double> f;
  for (const NormalPoint& p : m.normal) f.push_back(p.force);
  return f;
}

// Forces on this partner by deformation, in the mean over the packings.
std::vector<double> mean_forces(SoftParticleTest& test, SoftPartner partner, const Team& team) {
  test.partner = partner;
  return mean_of(columns(measure_soft_particles(test, team.seed, team.packings, team.threads), forces_of));
}

// A law that does not begin with a jump.
SoftLaw continuous_fit(const std::vector<double>& deltas, const std::vector<double>& force) {
  const SoftLaw fit = fit_soft_law(deltas, force);
  return fit.c > 0 ? fit_soft_law_from(0, deltas, force) : fit;
}

// |F_t|/F_n in the mean once it slides, less what was there before.
double saturated(const std::vector<SoftMeasurement>& all) {
  double along = 0, normal = 0;
  for (const SoftMeasurement& m : all) {
    double before = 0;
    for (const TangentialPoint& p : m.tangential) {
      if (p.alpha == 0)
        before = p.along;
      else
        along += p.along - before, normal += p.normal;
    }
  }
  return std::abs(along) / normal;
}

// Of one partner, all in units of E and R_s.
SoftParticleLaw partner_law(SoftParticleTest test, SoftPartner partner, const std::vector<double>& deltas,
                            const Team& team, Json& json) {
  const double rs = test.insertion.shell_radius, stress = test.law.grain.modulus;
  test.partner = partner, test.delta = deltas, test.alpha = kTurn;
  const std::vector<SoftMeasurement> all = measure_soft_particles(test, team.seed, team.packings, team.threads);
  const auto forces = columns(all, forces_of);
  const auto slopes = columns(all, [&](const SoftMeasurement& m) { return slopes_of(m, test.delta).along; });
  const std::vector<double> force = mean_of(forces), force_error = standard_error_of(forces), slope = mean_of(slopes),
                            slope_error = standard_error_of(slopes);
  for (std::size_t k = 0; k < deltas.size(); ++k)
    json.push_back({{"delta", deltas[k]},
                    {"F", force[k]},
                    {"F_error", force_error[k]},
                    {"k_t", slope[k]},
                    {"k_t_error", slope_error[k]}});
  const SoftLaw normal = continuous_fit(deltas, force);
  const SoftLaw tangential = fit_soft_law_from(normal.delta, deltas, slope);
  if (!std::isfinite(normal.a + normal.b + normal.c + tangential.a + tangential.b))
    throw InputError("command line", 0, "--packings", std::to_string(team.packings),
                     "too few of them carry a force for a fit; ask for more packings");
  SoftParticleTest sliding = test;
  sliding.delta = kAtLast, sliding.alpha = {kSliding};
  SoftParticleLaw law;
  law.force = normal.a / (stress * rs * rs), law.exponent = normal.b, law.offset = normal.c / (stress * rs * rs);
  law.tangential = tangential.a / (std::numbers::pi * rs / 180) / (stress * rs);
  law.tangential_exponent = tangential.b;
  law.friction = saturated(measure_soft_particles(sliding, team.seed, team.packings, team.threads));
  return law;
}

// q of F_ball = F_wall (R/(R + R_s))^q.
double curvature(SoftParticleTest test, const Team& team, Json& json) {
  test.delta = kAtLast, test.alpha = {};
  const std::vector<double> wall = mean_forces(test, SoftPartner::wall, team);
  double xx = 0, xy = 0;
  for (const double radius : kBalls) {
    test.partner_radius = radius * test.insertion.shell_radius;
    const std::vector<double> force = mean_forces(test, SoftPartner::ball, team);
    const double x = std::log(radius / (radius + 1));
    for (std::size_t k = 0; k < force.size(); ++k) {
      const double share = force[k] / wall[k];
      json.push_back({{"radius", radius}, {"delta", test.delta[k]}, {"share", share}});
      xx += x * x, xy += x * std::log(share);
    }
  }
  return xy / xx;
}

// In a packing a soft-particle is pressed on many sides and has less room to give way. The normal law of a particle in
// a cage of six walls takes the place of that at one wall, and that of two soft-particles grows by the same factor.
void confine(SoftParticleTest test, const Team& team, SphereLaw& law, Json& json) {
  const double rs = test.insertion.shell_radius, unit = test.law.grain.modulus * rs * rs;
  test.alpha = {}, test.delta = kAtWall;
  const std::vector<double> wall = mean_forces(test, SoftPartner::wall, team),
                            cage = mean_forces(test, SoftPartner::cage, team);
  double ratio = 0;
  for (std::size_t k = 0; k < kAtWall.size(); ++k) {
    const bool counts = std::find(kAtLast.begin(), kAtLast.end(), kAtWall[k]) != kAtLast.end();
    if (counts) ratio += cage[k] / wall[k] / static_cast<double>(kAtLast.size());
    json.push_back({{"delta", kAtWall[k]}, {"F", cage[k]}, {"over_wall", cage[k] / wall[k]}});
  }
  const SoftLaw fit = continuous_fit(kAtWall, cage);
  law.soft_solid.force = fit.a / unit, law.soft_solid.exponent = fit.b, law.soft_solid.offset = fit.c / unit;
  law.soft_soft.force *= ratio, law.soft_soft.offset *= ratio;
}

Json law_json(const SoftParticleLaw& law) {
  return {{"force", law.force},
          {"exponent", law.exponent},
          {"offset", law.offset},
          {"tangential", law.tangential},
          {"tangential_exponent", law.tangential_exponent},
          {"friction", law.friction}};
}

// Volume of all grains of the decades below over that of the grains of a decade, of the law N(r) ~ r^-b.
double rest_of_decades(double ratio, double exponent, int below) {
  const double e = 4 - exponent;
  const auto volume = [e](double from, double to) {
    return std::abs(e) < 1e-12 ? std::log(to / from) : (std::pow(to, e) - std::pow(from, e)) / e;
  };
  return volume(std::pow(ratio, -1 - below), 1 / ratio) / volume(1 / ratio, 1);
}

}  // namespace

double soft_share_of(double ratio, double exponent, int below, double solid_fraction) {
  const double softs = rest_of_decades(ratio, exponent, below) / solid_fraction;
  return softs / (1 + softs);
}

int lab_soft_laws(int argc, char** argv) {
  const Arguments args(argc, argv,
                       {{"--levels", "N", "of soft-particles, one inside the other (default 2)"},
                        {"--packings", "N", "average over N packings (default 14)"},
                        {"--seed", "S", "of the first packing (default 1)"},
                        {"--threads", "N", "packings side by side (default: all cores)"},
                        {"--confined", "", "normal laws of particles pressed on six sides at once, as in a packing"},
                        {"--exponent", "B", "of the law of sizes (default 3.5)"},
                        {"--ratio", "PI", "largest over smallest radius of a decade (default 10)"},
                        kJsonOption},
                       {"", "Measures the laws of soft-particles from the smallest decade of sizes upward."});
  args.require_inputs(0, 0, "no operand");
  Team team;
  team.packings = static_cast<std::size_t>(args.integer("--packings", 2, 100000).value_or(14));
  team.seed = static_cast<std::uint64_t>(args.integer("--seed", 0, INT32_MAX).value_or(1));
  team.threads = static_cast<unsigned>(
      args.integer("--threads", 1, 1024).value_or(std::max(1u, std::thread::hardware_concurrency())));
  const auto levels = static_cast<int>(args.integer("--levels", 1, 6).value_or(2));
  const double exponent = args.number("--exponent").value_or(3.5), ratio = args.number("--ratio").value_or(10);
  const bool confined = args.has("--confined");
  if (!(exponent >= 0 && exponent <= 10))
    throw InputError("command line", 0, "--exponent", *args.value("--exponent"), "from 0 to 10");
  if (!(ratio >= 2 && ratio <= 30))
    throw InputError("command line", 0, "--ratio", *args.value("--ratio"), "from 2 to 30");

  SoftParticleTest test = soft_particle_defaults(SoftPartner::wall, SoftProtocol::fire);
  const double largest = test.insertion.radius_max / test.insertion.shell_radius;
  test.insertion.exponent = exponent;
  test.insertion.radius_min = test.insertion.radius_max / ratio;
  Json json;
  json["modulus"] = test.law.grain.modulus, json["density"] = test.density, json["friction"] = test.law.friction;
  json["radius"] = test.insertion.shell_radius, json["largest"] = largest, json["ratio"] = ratio;
  json["confined"] = confined, json["exponent"] = exponent, json["packings"] = team.packings;
  for (int level = 0; level < levels; ++level) {
    const double begin = cpu_seconds();
    Json of;
    of["level"] = level, of["soft_share"] = test.insertion.soft_share;
    SoftParticleTest counted = test;
    counted.delta = {kAtWall.front()};
    double grains = 0, softs = 0, filled = 0;
    for (const SoftMeasurement& m : measure_soft_particles(counted, team.seed, team.packings, team.threads))
      grains += static_cast<double>(m.grains), softs += static_cast<double>(m.softs),
          filled += m.density / test.density;
    grains /= static_cast<double>(team.packings), softs /= static_cast<double>(team.packings),
        filled /= static_cast<double>(team.packings);
    of["bodies"] = grains, of["soft_particles"] = softs;
    of["solid_fraction"] = filled;  // of grains, those in soft-particles, too
    SphereLaw next = test.law;
    next.soft_solid = partner_law(test, SoftPartner::wall, kAtWall, team, of["wall"]);
    next.soft_soft = partner_law(test, SoftPartner::soft, kAtSoft, team, of["soft"]);
    next.soft_curvature = std::max(0.0, curvature(test, team, of["balls"]));
    if (confined) confine(test, team, next, of["cage"]);
    of["soft_solid"] = law_json(next.soft_solid), of["soft_soft"] = law_json(next.soft_soft);
    of["soft_curvature"] = next.soft_curvature;
    of["cpu_seconds"] = cpu_seconds() - begin;
    json["levels"].push_back(of);
    test.law = next;
    // The next level's holds these, as large as their largest grain is the smallest of it.
    test.soft_density = filled * test.density;
    test.insertion.soft_radius = test.insertion.radius_min / largest;
    test.insertion.soft_share = soft_share_of(ratio, exponent, level + 1, filled);
  }
  write_json(args, json);
  return exit_done;
}

}  // namespace isostat
