// isostat lab EXPERIMENT ...: few-body experiments against closed forms, and the speed of the step loop.
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "apps/json_output.hpp"
#include "dem/disks/lab/cluster.hpp"
#include "dem/disks/lab/pair.hpp"
#include "dem/disks/lab/throughput.hpp"
#include "dem/files/network_file.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

const OptionSpec kJsonOption{"--json", "FILE|-", "where the JSON goes (default -)"};

// --- lab throughput -----------------------------------------------------------------------------------------------

int throughput(int argc, char** argv) {
  const Arguments args(argc, argv,
                       {{"--steps", "N", "steps to time; default: about 2e8 grain-steps"},
                        {"--threads", "N", "default 1"},
                        {"--law", "frictionless|friction|rolling", "default rolling"},
                        {"--cohesion", "", "with attraction F0 = 1, D0 = 1e-3"},
                        {"--cell", "fixed|free", "free: the barostat holds the stress (default fixed)"},
                        kJsonOption},
                       {"INPUT.net", "Grain-steps per second of the step loop on a fixed packing."});
  args.require_inputs(1, 1, "one plain-text network with a cell");
  lab::ThroughputSetup setup;
  setup.steps = args.integer("--steps", 1, INT64_MAX).value_or(0);
  setup.threads = static_cast<int>(args.integer("--threads", 1, 1024).value_or(1));
  const std::string law = args.choice("--law", {"frictionless", "friction", "rolling"}).value_or("rolling");
  setup.friction = law != "frictionless", setup.rolling = law == "rolling";
  setup.cohesion = args.has("--cohesion");
  setup.free_cell = args.choice("--cell", {"fixed", "free"}).value_or("fixed") == "free";
  Packing<2> packing = read_network<2>(args.inputs()[0]).packing;
  if (!packing.cell) throw InputError(args.inputs()[0], 0, "cell", "", "lab throughput needs a periodic cell");
  const lab::Throughput t = lab::measure_throughput(std::move(packing), setup);
  Json stages;
  for (std::size_t k = 0; k < StepTimes::kNames.size(); ++k)
    stages[std::string(StepTimes::kNames[k])] = t.times.seconds[k];
  write_json(args, {{"grain_steps_per_cpu_second", t.grain_steps_per_cpu_second},
                    {"grain_steps_per_wall_second", t.grain_steps_per_wall_second},
                    {"grains", t.grains},
                    {"steps", t.steps},
                    {"cpu_seconds", t.cpu_seconds},
                    {"wall_seconds", t.wall_seconds},
                    {"pairs_per_grain", t.pairs_per_grain},
                    {"threads", setup.threads},
                    {"isa", t.isa},
                    {"stages", stages}});
  return exit_done;
}

// --- lab pair -----------------------------------------------------------------------------------------------------

constexpr int kPhases = 32;
constexpr double kSpeed = 0.1;  // [a/T0] of approach: overlaps of 1e-4 a at K_N = 1e5

Json curve_json(const std::vector<lab::LawPoint>& points) {
  Json j = Json::array();
  for (const lab::LawPoint& p : points)
    j.push_back({{"displacement", p.displacement}, {"force", p.force}, {"exact", p.exact}});
  return j;
}

Json cycle_json(const lab::LoadCycle& c) {
  return {{"dissipated", c.dissipated}, {"exact", c.exact}, {"points", curve_json(c.points)}};
}

int pair(int argc, char** argv) {
  const Arguments args(argc, argv,
                       {{"--step", "C", "time step c in dt = c sqrt(m/K) (default 0.005)"},
                        {"--damping", "ZETA", "default 0.8"},
                        {"--friction", "MU", "default 0.5"},
                        {"--stiffness", "K_N", "[F0/a] (default 1e5)"},
                        {"--range", "D0", "[a] (default 1e-3)"},
                        kJsonOption},
                       {"[restitution|pull-off|oblique|load-cycle|curve ...]",
                        "Two disks of diameter a against closed forms; without a name, all experiments."});
  LawScene law;
  law.damping = args.number("--damping").value_or(law.damping);
  law.friction = args.number("--friction").value_or(law.friction);
  law.normal_stiffness = args.number("--stiffness").value_or(law.normal_stiffness);
  law.attraction_range = args.number("--range").value_or(law.attraction_range);
  const double step = args.number("--step").value_or(0.005);
  auto require = [](bool good, const char* option, double value, const char* rule) {
    if (!good) throw InputError("command line", 0, option, std::to_string(value), rule);
  };
  require(step > 0 && step <= 0.3, "--step", step, "in (0, 0.3]");
  require(law.damping > 0 && law.damping < 1, "--damping", law.damping, "in (0, 1)");
  require(law.friction > 0, "--friction", law.friction, "positive");
  require(law.normal_stiffness >= 10, "--stiffness", law.normal_stiffness, "at least 10 F0/a");
  require(law.attraction_range > 0 && law.attraction_range < 0.5, "--range", law.attraction_range, "in (0, 0.5) a");

  const std::vector<std::string> known = {"restitution", "pull-off", "oblique", "load-cycle", "curve"};
  std::vector<std::string> names = args.inputs().empty() ? known : args.inputs();
  LawScene sliding = law;
  sliding.rolling = false;
  Json out;
  for (const std::string& name : names) {
    if (name == "restitution") {
      const lab::Restitution r = lab::restitution(sliding, step, kSpeed, kPhases);
      out[name] = {{"step", r.step_fraction}, {"mean", r.mean}, {"spread", r.spread}, {"exact", r.exact}};
    } else if (name == "pull-off") {
      const lab::PullOff p = lab::pull_off(sliding, step);
      out[name] = {{"speed", p.speed}, {"exact", p.exact}, {"largest_tension", p.largest_tension}};
    } else if (name == "oblique") {
      Json list = Json::array();
      for (double ratio : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0}) {
        const lab::ObliqueImpact o = lab::oblique_impact(sliding, step, kSpeed, ratio * kSpeed, kPhases);
        list.push_back({{"normal_approach", kSpeed},
                        {"tangential_approach", ratio * kSpeed},
                        {"normal", o.normal_velocity},
                        {"tangential", o.tangential_velocity},
                        {"spin", o.spin},
                        {"spread", o.spread},
                        {"tangential_if_sliding", o.sliding_exact}});
      }
      out[name] = list;
    } else if (name == "load-cycle") {
      const double overlap = 1 / law.normal_stiffness;  // N_e = F0
      const double slip = law.friction * overlap, roll = 0.01 * law.friction / (1e-4 * law.normal_stiffness);
      out[name] = {{"tangential", cycle_json(lab::tangential_cycle(sliding, overlap, 4 * slip, 400))},
                   {"rolling", cycle_json(lab::rolling_cycle(law, overlap, 4 * roll, 400))}};
    } else if (name == "curve") {
      out[name] = {{"normal", curve_json(lab::normal_curve(sliding, 400))}};
    } else {
      throw InputError("command line", 0, "lab pair", name, "one of restitution, pull-off, oblique, load-cycle, curve");
    }
  }
  write_json(args, out);
  return exit_done;
}

// --- lab cluster --------------------------------------------------------------------------------------------------

Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json cluster_json(const lab::ClusterResult& r) {
  Json contacts = Json::array();
  const Bodies<2>& b = r.state.packing.bodies;
  for (std::int64_t p = 0; p < 4; ++p)
    for (std::int64_t q = p + 1; q < 4; ++q)
      for (const Link<2>& l : r.state.packing.links) {
        const auto i = b.id[static_cast<std::size_t>(l.i)], j = b.id[static_cast<std::size_t>(l.j)];
        if (std::min(i, j) == p && std::max(i, j) == q && is_contact(l.kind))
          contacts.push_back({{"i", p}, {"j", q}, {"h", l.gap}, {"N", l.normal_force}, {"T", l.tangential_force}});
      }
  return {{"contacts", contacts},
          {"at_rest", r.at_rest},
          {"residual_force", r.residual},
          {"time", r.state.time},
          {"N_outer", number_or_null(r.outer_normal)},
          {"N_common", number_or_null(r.common_normal)},
          {"T_outer", number_or_null(r.outer_tangential)}};
}

// The scan of Fig. 13: forces against approach speed and impact parameter, as a CSV table.
std::string scan_table(const lab::ClusterSetup& setup) {
  std::ostringstream csv;
  csv << "approach,impact_parameter,contacts,at_rest,N_outer,N_common,T_outer\n";
  csv.precision(10);
  for (double speed : {0.0, 0.1, 0.3, 1.0, 3.0, 10.0})
    for (double offset = -0.9; offset < 0.95; offset += 0.1) {
      lab::ClusterSetup s = setup;
      s.approach = speed, s.impact_parameter = offset, s.max_time = 100;
      const lab::ClusterResult r = lab::double_triangle(s);
      csv << speed << ',' << offset << ',' << r.contacts << ',' << r.at_rest << ',' << r.outer_normal << ','
          << r.common_normal << ',' << r.outer_tangential << '\n';
    }
  return csv.str();
}

int cluster(int argc, char** argv) {
  const Arguments args(
      argc, argv,
      {{"--approach", "fall|V", "speed of the fourth disk [V*]; fall: at rest, drawn in by the attraction"},
       {"--impact-parameter", "D", "[a] offset of its path from the axis of the base"},
       {"--step", "C", "time step c in dt = c sqrt(m/K) (default 0.01)"},
       {"--kappa", "K", "K_N a / F0 (default 1e5)"},
       {"--friction", "MU", "default 0.5"},
       {"--scan", "FILE.csv", "instead: a table over approach speeds and impact parameters"},
       kJsonOption},
      {"double-triangle", "The hyperstatic four-disk cluster of Gilabert 2007, Figs. 13 and 18."});
  args.require_inputs(1, 1, "the cluster's name");
  if (args.inputs()[0] != "double-triangle")
    throw InputError("command line", 0, "lab cluster", args.inputs()[0], "one of double-triangle");
  lab::ClusterSetup setup = lab::default_cluster_setup();
  setup.law.normal_stiffness = args.number("--kappa").value_or(setup.law.normal_stiffness);
  setup.law.friction = args.number("--friction").value_or(setup.law.friction);
  setup.step_fraction = args.number("--step").value_or(setup.step_fraction);
  if (!(setup.step_fraction > 0 && setup.step_fraction <= 0.3))
    throw InputError("command line", 0, "--step", *args.value("--step"), "in (0, 0.3]");
  if (!(setup.law.normal_stiffness >= 10))
    throw InputError("command line", 0, "--kappa", *args.value("--kappa"), "at least 10");
  if (!(setup.law.friction > 0))
    throw InputError("command line", 0, "--friction", *args.value("--friction"), "positive");
  setup.impact_parameter = args.number("--impact-parameter").value_or(0);
  if (!(std::abs(setup.impact_parameter) < 1.5))
    throw InputError("command line", 0, "--impact-parameter", *args.value("--impact-parameter"), "within 1.5 a");
  const std::string approach = args.value("--approach").value_or("fall");
  if (approach != "fall") {
    setup.approach = args.number("--approach");
    if (!(*setup.approach >= 0)) throw InputError("command line", 0, "--approach", approach, "fall, or a speed in V*");
    setup.max_time = 200;
  }
  if (const auto path = args.value("--scan")) {
    write_text(*path, scan_table(setup));
    return exit_done;
  }
  const lab::ClusterResult r = lab::double_triangle(setup);
  write_json(args, cluster_json(r));
  if (r.at_rest) return exit_done;
  std::cerr << "isostat lab cluster: not at rest after " << setup.max_time << " T0 (residual force " << r.residual
            << " F0): with this approach the fourth disk flies off or goes on rolling\n";
  return exit_unfinished;
}

}  // namespace

int lab_command(int argc, char** argv) {
  struct Experiment {
    std::string_view name;
    int (*run)(int, char**);
  };
  constexpr Experiment experiments[] = {{"pair", pair}, {"cluster", cluster}, {"throughput", throughput}};
  std::string list;
  for (const Experiment& e : experiments) {
    if (argc > 1 && e.name == argv[1]) return e.run(argc - 1, argv + 1);
    list += (list.empty() ? "" : ", ") + std::string(e.name);
  }
  if (argc > 1 && std::string_view(argv[1]) == "--help")
    throw HelpRequest{"isostat lab EXPERIMENT ...\n\nFew-body experiments against closed forms: " + list +
                      ".\nisostat lab EXPERIMENT --help says more.\n"};
  throw InputError("command line", 0, "lab", argc > 1 ? argv[1] : "", "one of " + list);
}

}  // namespace isostat
