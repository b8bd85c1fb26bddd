// isostat lab pair: two disks of diameter a against closed forms.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "apps/commands.hpp"
#include "apps/json_output.hpp"
#include "apps/lab/experiments.hpp"
#include "dem/disks/disk_law.hpp"
#include "dem/disks/lab/pair.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kStep = 0.005, kMostStep = 0.3;  // c in dt = c sqrt(m/K): default, and what is still stable
constexpr double kLeastStiffness = 10;            // [F0/a] below, overlaps are a tenth of a disk
constexpr double kMostRange = 0.5;                // [a]
constexpr double kSpeed = 0.1;                    // [a/T0] of approach: overlaps of 1e-4 a at K_N = 1e5
constexpr int kPhases = 32;                       // of the first contact within a step; a collision is their mean
constexpr double kTangentialToNormal[] = {0.1, 0.2, 0.5, 1.0, 2.0, 5.0};  // approach speeds of oblique impacts
constexpr double kCycleAmplitude = 4;                                     // [displacement at which the limit is met]
constexpr int kCurvePoints = 400;

struct Setup {
  LawScene law;      // with rolling resistance
  LawScene sliding;  // the same law without
  double step = kStep;
};

Json curve_json(const std::vector<lab::LawPoint>& points) {
  Json j = Json::array();
  for (const lab::LawPoint& p : points)
    j.push_back({{"displacement", p.displacement}, {"force", p.force}, {"exact", p.exact}});
  return j;
}

Json cycle_json(const lab::LoadCycle& c) {
  return {{"dissipated", c.dissipated}, {"exact", c.exact}, {"points", curve_json(c.points)}};
}

Json restitution(const Setup& setup) {
  const lab::Restitution r = lab::restitution(setup.sliding, setup.step, kSpeed, kPhases);
  return {{"step", r.step_fraction}, {"mean", r.mean}, {"spread", r.spread}, {"exact", r.exact}};
}

Json pull_off(const Setup& setup) {
  const lab::PullOff p = lab::pull_off(setup.sliding, setup.step);
  return {{"speed", p.speed}, {"exact", p.exact}, {"largest_tension", p.largest_tension}};
}

Json oblique(const Setup& setup) {
  Json list = Json::array();
  for (const double ratio : kTangentialToNormal) {
    const lab::ObliqueImpact o = lab::oblique_impact(setup.sliding, setup.step, kSpeed, ratio * kSpeed, kPhases);
    list.push_back({{"normal_approach", kSpeed},
                    {"tangential_approach", ratio * kSpeed},
                    {"normal", o.normal_velocity},
                    {"tangential", o.tangential_velocity},
                    {"spin", o.spin},
                    {"spread", o.spread},
                    {"tangential_if_sliding", o.sliding_exact}});
  }
  return list;
}

Json load_cycle(const Setup& setup) {
  const DiskLaw law = resolve(setup.law);
  const double overlap = 1 / law.normal_stiffness;                   // N_e = F0
  const double slip = law.friction * overlap;                        // mu N_e / K_T with K_T = K_N
  const double roll = law.rolling_friction / law.rolling_stiffness;  // mu_r N_e / K_r
  return {
      {"tangential", cycle_json(lab::tangential_cycle(setup.sliding, overlap, kCycleAmplitude * slip, kCurvePoints))},
      {"rolling", cycle_json(lab::rolling_cycle(setup.law, overlap, kCycleAmplitude * roll, kCurvePoints))}};
}

Json curve(const Setup& setup) { return {{"normal", curve_json(lab::normal_curve(setup.sliding, kCurvePoints))}}; }

struct Experiment {
  std::string_view name;
  Json (*run)(const Setup&);
};
constexpr Experiment kExperiments[] = {{"restitution", restitution},
                                       {"pull-off", pull_off},
                                       {"oblique", oblique},
                                       {"load-cycle", load_cycle},
                                       {"curve", curve}};

Setup setup_of(const Arguments& args) {
  Setup setup;
  LawScene& law = setup.law;
  law.damping = args.number("--damping").value_or(law.damping);
  law.friction = args.number("--friction").value_or(law.friction);
  law.normal_stiffness = args.number("--stiffness").value_or(law.normal_stiffness);
  law.attraction_range = args.number("--range").value_or(law.attraction_range);
  setup.step = args.number("--step").value_or(kStep);
  const auto require = [](bool good, const char* option, double value, const char* rule) {
    if (!good) throw InputError("command line", 0, option, std::to_string(value), rule);
  };
  require(setup.step > 0 && setup.step <= kMostStep, "--step", setup.step, "in (0, 0.3]");
  require(law.damping > 0 && law.damping < 1, "--damping", law.damping, "in (0, 1)");
  require(law.friction > 0, "--friction", law.friction, "positive");
  require(law.normal_stiffness >= kLeastStiffness, "--stiffness", law.normal_stiffness, "at least 10 F0/a");
  require(law.attraction_range > 0 && law.attraction_range < kMostRange, "--range", law.attraction_range,
          "in (0, 0.5) a");
  setup.sliding = law;
  setup.sliding.rolling = false;
  return setup;
}

}  // namespace

int lab_pair(int argc, char** argv) {
  const Arguments args(argc, argv,
                       {{"--step", "C", "time step c in dt = c sqrt(m/K) (default 0.005)"},
                        {"--damping", "ZETA", "default 0.8"},
                        {"--friction", "MU", "default 0.5"},
                        {"--stiffness", "K_N", "[F0/a] (default 1e5)"},
                        {"--range", "D0", "[a] (default 1e-3)"},
                        kJsonOption},
                       {"[restitution|pull-off|oblique|load-cycle|curve ...]",
                        "Two disks of diameter a against closed forms; without a name, all experiments."});
  const Setup setup = setup_of(args);
  std::vector<std::string> names = args.inputs();
  std::string known;
  for (const Experiment& e : kExperiments) {
    if (args.inputs().empty()) names.emplace_back(e.name);
    known += (known.empty() ? "" : ", ") + std::string(e.name);
  }
  Json out;
  for (const std::string& name : names) {
    const auto e = std::find_if(std::begin(kExperiments), std::end(kExperiments),
                                [&](const Experiment& each) { return each.name == name; });
    if (e == std::end(kExperiments)) throw InputError("command line", 0, "lab pair", name, "one of " + known);
    out[name] = e->run(setup);
  }
  write_json(args, out);
  return exit_done;
}

}  // namespace isostat
