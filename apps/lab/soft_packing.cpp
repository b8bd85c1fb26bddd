// isostat lab soft-packing: packings of solid grains and soft-particles compressed, as the model has them and with
// every grain of the soft-particles in it (dem/spheres/lab/soft_packing.hpp).
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "analysis/constitutive/soft_law_fit.hpp"
#include "apps/commands.hpp"
#include "apps/json_output.hpp"
#include "apps/lab/experiments.hpp"
#include "apps/lab/side_by_side.hpp"
#include "apps/lab/soft_laws.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"
#include "dem/spheres/lab/soft_packing.hpp"
#include "dem/spheres/lab/soft_particle.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
using Runs = std::vector<SoftPackingRun>;  // of the packings

SoftParticleLaw law_of(const Json& json) {
  return {
      json.at("force"),   json.at("exponent"), json.at("offset"), json.at("tangential"), json.at("tangential_exponent"),
      json.at("friction")};
}

SoftPackingTest test_of(const Arguments& args) {
  const std::string path = args.required("--laws");
  SoftPackingTest t;
  try {
    std::ifstream in(path);
    if (!in) throw InputError(path, 0, "", "", "cannot be read");
    const Json json = Json::parse(in);
    const Json& level = json.at("levels").at(0);  // the softs of the packing hold grains alone: they can be resolved
    SoftParticleTest particle = soft_particle_defaults(SoftPartner::wall, SoftProtocol::fire);
    t.law = particle.law;
    t.law.grain.modulus = t.law.wall.modulus = json.at("modulus");
    t.law.friction = t.law.wall_friction = json.at("friction");
    t.law.soft_solid = law_of(level.at("soft_solid")), t.law.soft_soft = law_of(level.at("soft_soft"));
    t.law.soft_curvature = level.at("soft_curvature");
    t.density = json.at("density");
    t.inside = particle.insertion;
    t.inside.shell_radius = json.at("radius");
    const double largest = json.at("largest"), ratio = json.at("ratio");
    t.inside.radius_max = largest * t.inside.shell_radius, t.inside.radius_min = t.inside.radius_max / ratio;
    t.inside.exponent = json.at("exponent");
    t.packing = t.inside;
    t.packing.room = InsertionRoom::box;
    t.packing.radius_min = t.inside.radius_max, t.packing.radius_max = ratio * t.packing.radius_min;
    t.packing.soft_radius = t.inside.shell_radius;
    t.packing.soft_share = soft_share_of(ratio, t.inside.exponent, 1, level.at("solid_fraction"));
  } catch (const Json::exception& e) {
    throw InputError(path, 0, "--laws", path, std::string("no JSON of `isostat lab soft-laws`: ") + e.what());
  }
  const double edge = args.number("--edge").value_or(1.5);
  if (!(edge >= 1.2))
    throw InputError("command line", 0, "--edge", *args.value("--edge"), "at least 1.2 largest diameters");
  t.packing.box.fill(edge * 2 * t.packing.radius_max);
  t.packing.trials = args.number("--trials").value_or(1e6);
  t.packing.volume_factor = args.number("--filled").value_or(0.6);
  if (!(t.packing.volume_factor > 0 && t.packing.volume_factor < 1))
    throw InputError("command line", 0, "--filled", *args.value("--filled"), "between 0 and 1, both excluded");
  t.packing.soft_share = args.number("--soft-share").value_or(t.packing.soft_share);
  if (!(t.packing.soft_share > 0 && t.packing.soft_share < 1))
    throw InputError("command line", 0, "--soft-share", *args.value("--soft-share"), "between 0 and 1, both excluded");
  const double most = args.number("--strain").value_or(0.1);
  const auto points = args.integer("--points", 1, 1000).value_or(10);
  if (!(most > 0 && most <= 0.3))
    throw InputError("command line", 0, "--strain", *args.value("--strain"), "above 0 and at most 0.3");
  for (long long k = 1; k <= points; ++k)
    t.strain.push_back(most * static_cast<double>(k) / static_cast<double>(points));
  t.increment = args.number("--increment").value_or(t.increment);
  if (!(t.increment > 0)) throw InputError("command line", 0, "--increment", *args.value("--increment"), "above 0");
  t.most_iterations = static_cast<int>(args.integer("--iterations", 1, 1000000).value_or(t.most_iterations));
  if (args.has("--plane-law")) t.law.soft_curvature = 0;
  return t;
}

double correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k)
    sx += x[k], sy += y[k], sxx += x[k] * x[k], syy += y[k] * y[k], sxy += x[k] * y[k];
  return (n * sxy - sx * sy) / std::sqrt((n * sxx - sx * sx) * (n * syy - sy * sy));
}

double mean(const std::vector<double>& x) {
  double sum = 0;
  for (const double v : x) sum += v;
  return sum / static_cast<double>(x.size());
}
double deviation(const std::vector<double>& x) {  // sample standard deviation
  const double m = mean(x);
  double sum = 0;
  for (const double v : x) sum += (v - m) * (v - m);
  return std::sqrt(sum / static_cast<double>(x.size() - 1));
}

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

// Two readings of the same packings at one strain: means, scatter of the second between packings, and the mean of
// first - second in units of that scatter.
Json against(const std::vector<double>& first, const std::vector<double>& second) {
  std::vector<double> difference;
  for (std::size_t k = 0; k < first.size(); ++k) difference.push_back(first[k] - second[k]);
  const double scatter = deviation(second);
  return {{"mean", mean(first)},
          {"resolved", mean(second)},
          {"scatter", number(scatter)},
          {"deviation", number(mean(difference) / scatter)},
          {"deviation_error", number(deviation(difference) / std::sqrt(static_cast<double>(first.size())) / scatter)}};
}

std::vector<double> at(const Runs& runs, std::size_t point, double SoftPackingPoint::*member) {
  std::vector<double> x;
  for (const SoftPackingRun& r : runs) x.push_back(r.points[point].*member);
  return x;
}
std::vector<double> mean_loads(const Runs& runs, std::size_t point) {
  std::vector<double> x;
  for (const SoftPackingRun& r : runs) x.push_back(mean(r.points[point].solid_load));
  return x;
}

Json compared(const SoftPackingTest& test, const Runs& model, const Runs& resolved) {
  Json list = Json::array();
  for (std::size_t k = 0; k < test.strain.size(); ++k) {
    std::vector<double> likeness;
    for (std::size_t p = 0; p < model.size(); ++p) {
      const double c = correlation(model[p].points[k].solid_load, resolved[p].points[k].solid_load);
      if (std::isfinite(c)) likeness.push_back(c);
    }
    list.push_back(
        {{"strain", test.strain[k]},
         {"pressure", against(at(model, k, &SoftPackingPoint::pressure), at(resolved, k, &SoftPackingPoint::pressure))},
         {"solid_load", against(mean_loads(model, k), mean_loads(resolved, k))},
         {"correlation", likeness.empty() ? Json(nullptr) : number(mean(likeness))}});
  }
  return list;
}

Json summary(const Runs& runs) {
  std::vector<double> solids, softs, bodies, filled, steps, seconds;
  for (const SoftPackingRun& r : runs) {
    solids.push_back(static_cast<double>(r.solids)), softs.push_back(static_cast<double>(r.softs));
    bodies.push_back(static_cast<double>(r.bodies)), filled.push_back(r.solid_fraction);
    steps.push_back(static_cast<double>(r.steps)), seconds.push_back(r.cpu_seconds);
  }
  Json curve = Json::array();
  for (std::size_t k = 0; k < runs.front().points.size(); ++k) {
    const std::vector<double> pressure = at(runs, k, &SoftPackingPoint::pressure);
    curve.push_back({{"strain", runs.front().points[k].strain},
                     {"pressure", mean(pressure)},
                     {"scatter", number(deviation(pressure))},
                     {"residual", mean(at(runs, k, &SoftPackingPoint::residual))}});
  }
  return {{"solid_grains", mean(solids)},
          {"soft_particles", mean(softs)},
          {"bodies", mean(bodies)},
          {"solid_fraction", mean(filled)},
          {"steps", mean(steps)},
          {"cpu_seconds", mean(seconds)},
          {"curve", curve}};
}

}  // namespace

int lab_soft_packing(int argc, char** argv) {
  const Arguments args(
      argc, argv,
      {{"--laws", "FILE.json", "of `isostat lab soft-laws`; its level 0 is taken, whose particles can be resolved"},
       {"--resolutions", "LIST", "of model, shells, free (default model,shells)"},
       {"--edge", "L", "[largest diameter] of the cube (default 1.5)"},
       {"--soft-share", "S", "share of the listed volume that soft-particles have (default: that of one more decade)"},
       {"--filled", "PHI", "solid grains and soft-particles, as spheres, at the start (default 0.6)"},
       {"--trials", "I", "random points tried for each of them (default 1e6)"},
       {"--strain", "E", "largest strain of the edges (default 0.1)"},
       {"--points", "N", "strains at which forces are taken (default 10)"},
       {"--increment", "E", "most strain between two relaxations (default 0.0025)"},
       {"--iterations", "N", "most steps of a relaxation (default 3000)"},
       {"--plane-law", "", "leave out what the curvature of a partner takes from the force"},
       {"--packings", "N", "(default 7)"},
       {"--seed", "S", "of the first packing (default 1)"},
       {"--threads", "N", "packings side by side (default: all cores)"},
       {"--loads", "FILE.csv", "the mean pressure on each solid grain at each strain"},
       kJsonOption},
      {"--laws FILE.json", "Compresses packings of solid grains and soft-particles, as a model and resolved."});
  args.require_inputs(0, 0, "no operand");
  const SoftPackingTest test = test_of(args);
  std::vector<SoftResolution> wanted;
  const std::string list = args.value("--resolutions").value_or("model,shells");
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const auto found = std::find(kSoftResolutionNames.begin(), kSoftResolutionNames.end(),
                                 std::string_view(list).substr(begin, end - begin));
    if (found == kSoftResolutionNames.end())
      throw InputError("command line", 0, "--resolutions", list, "a list of model, shells, free");
    wanted.push_back(static_cast<SoftResolution>(found - kSoftResolutionNames.begin()));
    begin = end + 1;
  }
  const auto packings = static_cast<std::size_t>(args.integer("--packings", 2, 100000).value_or(7));
  const auto seed = static_cast<std::uint64_t>(args.integer("--seed", 0, INT32_MAX).value_or(1));
  const auto threads = static_cast<unsigned>(
      args.integer("--threads", 1, 1024).value_or(std::max(1u, std::thread::hardware_concurrency())));
  if (const auto loads = args.value("--loads")) require_writable(*loads);

  const Runs all = side_by_side(packings * wanted.size(), threads, [&](std::size_t k) {
    return compress_soft_packing(test, wanted[k / packings], seed + k % packings);
  });
  Json json;
  json["packings"] = packings, json["soft_share"] = test.packing.soft_share;
  std::vector<Runs> by_resolution;
  std::string csv = "resolution,seed,strain,grain,load\n";
  for (std::size_t w = 0; w < wanted.size(); ++w) {
    const auto from = all.begin() + static_cast<std::ptrdiff_t>(w * packings);
    by_resolution.emplace_back(from, from + static_cast<std::ptrdiff_t>(packings));
    const std::string name(kSoftResolutionNames[static_cast<std::size_t>(wanted[w])]);
    json[name] = summary(by_resolution.back());
    for (std::size_t p = 0; p < packings; ++p)
      for (const SoftPackingPoint& point : by_resolution.back()[p].points)
        for (std::size_t g = 0; g < point.solid_load.size(); ++g)
          csv += name + ',' + std::to_string(seed + p) + ',' + Json(point.strain).dump() + ',' + std::to_string(g) +
                 ',' + Json(point.solid_load[g]).dump() + '\n';
  }
  for (std::size_t a = 0; a < wanted.size(); ++a)
    for (std::size_t b = a + 1; b < wanted.size(); ++b)
      json[std::string(kSoftResolutionNames[static_cast<std::size_t>(wanted[a])]) + "_against_" +
           std::string(kSoftResolutionNames[static_cast<std::size_t>(wanted[b])])] =
          compared(test, by_resolution[a], by_resolution[b]);
  if (const auto loads = args.value("--loads")) write_file_atomically(*loads, csv);
  write_json(args, json);
  return exit_done;
}

}  // namespace isostat
