// isostat lab cluster: the hyperstatic four-disk cluster of Gilabert 2007, Figs. 13 and 18.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/commands.hpp"
#include "apps/json_output.hpp"
#include "apps/lab/experiments.hpp"
#include "dem/disks/lab/cluster.hpp"
#include "dem/input_error.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kDisks = 4;
constexpr double kMostStep = 0.3;             // c in dt = c sqrt(m/K) that is still stable
constexpr double kLeastKappa = 10;            // K_N a / F0: below, overlaps are a tenth of a disk
constexpr double kMostImpactParameter = 1.5;  // [a] beyond, the path misses the base
constexpr double kTimeAfterImpact = 200;  // [T0] within which a disk that is shot at the base has settled or is gone

// The scan of Fig. 13.
constexpr double kScanSpeeds[] = {0.0, 0.1, 0.3, 1.0, 3.0, 10.0};        // [V*]
constexpr double kScanFirst = -0.9, kScanEnd = 0.95, kScanStride = 0.1;  // [a] impact parameters
constexpr double kScanTime = 100;                                        // [T0] of one point

Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json cluster_json(const lab::ClusterResult& r) {
  Json contacts = Json::array();
  const Bodies<2>& b = r.state.packing.bodies;
  for (std::int64_t p = 0; p < kDisks; ++p)
    for (std::int64_t q = p + 1; q < kDisks; ++q)
      for (const Link<2>& l : r.state.packing.links) {
        const auto i = b.id[idx(l.i)], j = b.id[idx(l.j)];
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

// Forces against approach speed and impact parameter, as a CSV table.
std::string scan_table(const lab::ClusterSetup& setup) {
  std::ostringstream csv;
  csv << "approach,impact_parameter,contacts,at_rest,N_outer,N_common,T_outer\n";
  csv.precision(10);
  for (const double speed : kScanSpeeds)
    for (double offset = kScanFirst; offset < kScanEnd; offset += kScanStride) {
      lab::ClusterSetup s = setup;
      s.approach = speed, s.impact_parameter = offset, s.max_time = kScanTime;
      const lab::ClusterResult r = lab::double_triangle(s);
      csv << speed << ',' << offset << ',' << r.contacts << ',' << r.at_rest << ',' << r.outer_normal << ','
          << r.common_normal << ',' << r.outer_tangential << '\n';
    }
  return csv.str();
}

}  // namespace

int lab_cluster(int argc, char** argv) {
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
  if (!(setup.step_fraction > 0 && setup.step_fraction <= kMostStep))
    throw InputError("command line", 0, "--step", *args.value("--step"), "in (0, 0.3]");
  if (!(setup.law.normal_stiffness >= kLeastKappa))
    throw InputError("command line", 0, "--kappa", *args.value("--kappa"), "at least 10");
  if (!(setup.law.friction > 0))
    throw InputError("command line", 0, "--friction", *args.value("--friction"), "positive");
  setup.impact_parameter = args.number("--impact-parameter").value_or(0);
  if (!(std::abs(setup.impact_parameter) < kMostImpactParameter))
    throw InputError("command line", 0, "--impact-parameter", *args.value("--impact-parameter"), "within 1.5 a");
  const std::string approach = args.value("--approach").value_or("fall");
  if (approach != "fall") {
    setup.approach = args.number("--approach");
    if (!(*setup.approach >= 0)) throw InputError("command line", 0, "--approach", approach, "fall, or a speed in V*");
    setup.max_time = kTimeAfterImpact;
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

}  // namespace isostat
