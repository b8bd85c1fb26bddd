// isostat lab throughput: the speed of the step loop.
#include <cstdint>
#include <nlohmann/json.hpp>

#include "analysis/input.hpp"
#include "apps/commands.hpp"
#include "apps/json_output.hpp"
#include "apps/lab/experiments.hpp"
#include "dem/disks/lab/throughput.hpp"
#include "dem/files/network_file.hpp"
#include "dem/input_error.hpp"

namespace isostat {

int lab_throughput(int argc, char** argv) {
  const Arguments args(argc, argv,
                       {{"--steps", "N", "steps to time; default: about 2e8 grain-steps"},
                        {"--threads", "N", "default 1"},
                        {"--law", "frictionless|friction|rolling", "default rolling"},
                        {"--cohesion", "", "with attraction F0 = 1, D0 = 1e-3"},
                        {"--cell", "fixed|free", "free: the barostat holds the stress (default fixed)"},
                        kJsonOption},
                       {"INPUT.net", "Grain-steps per second of the step loop on a fixed packing."});
  args.require_inputs(1, 1, "one plain-text network");
  lab::ThroughputSetup setup;
  setup.steps = args.integer("--steps", 1, INT64_MAX).value_or(0);
  setup.threads = static_cast<int>(args.integer("--threads", 1, 1024).value_or(1));
  const auto law = network_law_named(args.choice("--law", kNetworkLawNames).value_or("rolling"));
  setup.friction = law != NetworkLaw::frictionless, setup.rolling = law == NetworkLaw::rolling;
  setup.cohesion = args.has("--cohesion");
  setup.free_cell = args.choice("--cell", {"fixed", "free"}).value_or("fixed") == "free";
  Packing<2> packing = read_network<2>(args.inputs()[0]).packing;
  if (setup.free_cell && !packing.cell)
    throw InputError(args.inputs()[0], 0, "--cell", "free", "needs a periodic cell; this packing is isolated");
  const lab::Throughput t = lab::measure_throughput(std::move(packing), setup);
  nlohmann::ordered_json stages;
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

}  // namespace isostat
