// isostat lab throughput: the speed of the step loop.
#include <cstdint>
#include <nlohmann/json.hpp>

#include "analysis/input.hpp"
#include "apps/commands.hpp"
#include "apps/json_output.hpp"
#include "apps/lab/experiments.hpp"
#include "dem/disks/lab/throughput.hpp"
#include "dem/files/packing_file.hpp"
#include "dem/input_error.hpp"
#include "dem/run_error.hpp"
#include "dem/spheres/lab/throughput.hpp"
#include "dem/triangles/lab/throughput.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

Json stages(const StepTimes& times) {
  Json by_name;
  for (std::size_t k = 0; k < StepTimes::kNames.size(); ++k)
    by_name[std::string(StepTimes::kNames[k])] = times.seconds[k];
  return by_name;
}

Json report(const lab::Throughput& t, int threads) {
  return {{"grain_steps_per_cpu_second", t.grain_steps_per_cpu_second},
          {"grain_steps_per_wall_second", t.grain_steps_per_wall_second},
          {"grains", t.grains},
          {"steps", t.steps},
          {"cpu_seconds", t.cpu_seconds},
          {"wall_seconds", t.wall_seconds},
          {"pairs_per_grain", t.pairs_per_grain},
          {"threads", threads},
          {"isa", t.isa},
          {"stages", stages(t.times)}};
}

Json of_disks(const Arguments& args, Packing<2> packing) {
  lab::ThroughputSetup setup;
  setup.steps = args.integer("--steps", 1, INT64_MAX).value_or(0);
  setup.threads = static_cast<int>(args.integer("--threads", 1, 1024).value_or(1));
  const auto law = network_law_named(args.choice("--law", kNetworkLawNames).value_or("rolling"));
  setup.friction = law != NetworkLaw::frictionless, setup.rolling = law == NetworkLaw::rolling;
  setup.cohesion = args.has("--cohesion");
  setup.free_cell = args.choice("--cell", {"fixed", "free"}).value_or("fixed") == "free";
  if (setup.free_cell && !packing.cell)
    throw InputError(args.inputs()[0], 0, "--cell", "free", "needs a periodic cell; this packing is isolated");
  return report(lab::measure_throughput(std::move(packing), setup), setup.threads);
}

Json of_spheres(const Arguments& args, const PackingFile& file) {
  for (const char* option : {"--cohesion", "--cell"})
    if (args.has(option))
      throw InputError("command line", 0, option, *args.value(option), "of disks only; spheres take a fixed cell");
  lab::SphereThroughputSetup setup;
  setup.steps = args.integer("--steps", 1, INT64_MAX).value_or(0);
  setup.threads = static_cast<int>(args.integer("--threads", 1, 1024).value_or(1));
  const auto law = network_law_named(args.choice("--law", kNetworkLawNames).value_or("friction"));
  setup.friction = law != NetworkLaw::frictionless, setup.rolling = law == NetworkLaw::rolling;
  return report(
      file.spheres ? lab::measure_throughput(*file.spheres, setup) : lab::measure_throughput(*file.packing_3d, setup),
      setup.threads);
}

Json of_triangles(const Arguments& args, PackingFile file) {
  for (const char* option : {"--law", "--cohesion", "--cell"})
    if (args.has(option))
      throw InputError("command line", 0, option, *args.value(option),
                       "of disks only; triangles take the law of their state, in a fixed cell");
  lab::TriangleThroughputSetup setup;
  setup.steps = args.integer("--steps", 1, INT64_MAX).value_or(0);
  setup.threads = static_cast<int>(args.integer("--threads", 1, 1024).value_or(1));
  State<TriangleGrains>& state = *file.triangles;
  if (count_free(state.packing) == 0)
    throw InputError(args.inputs()[0], 0, "triangle", "", "only walls: there is no grain to march");
  if (!(state.time_step > 0)) lab::make_network_run(state);
  const lab::TriangleThroughput t = lab::measure_throughput(state, setup);
  return {{"triangle_steps_per_cpu_second", t.triangle_steps_per_cpu_second},
          {"grain_steps_per_cpu_second", t.grain_steps_per_cpu_second},
          {"grain_steps_per_wall_second", t.grain_steps_per_wall_second},
          {"grains", t.grains},
          {"triangles", t.triangles},
          {"steps", t.steps},
          {"cpu_seconds", t.cpu_seconds},
          {"wall_seconds", t.wall_seconds},
          {"pairs_per_triangle", t.pairs_per_triangle},
          {"rebuilds", t.rebuilds},
          {"threads", setup.threads},
          {"isa", t.isa},
          {"stages", stages(t.times)}};
}

}  // namespace

int lab_throughput(int argc, char** argv) {
  const Arguments args(
      argc, argv,
      {{"--steps", "N", "steps to time; default: about two seconds' worth"},
       {"--threads", "N", "default 1"},
       {"--law", "frictionless|friction|rolling", "of disks (default rolling) and spheres (default friction)"},
       {"--cohesion", "", "of disks: with attraction F0 = 1, D0 = 1e-3"},
       {"--cell", "fixed|free", "of disks; free: the barostat holds the stress (default fixed)"},
       kJsonOption},
      {"INPUT", "Grain-steps per second of the step loop on a fixed packing: a network or a state."});
  args.require_inputs(1, 1, "one network or state");
  PackingFile file = read_packing(args.inputs()[0]);
  try {
    write_json(args, file.packing_3d  ? of_spheres(args, file)
                     : file.triangles ? of_triangles(args, std::move(file))
                                      : of_disks(args, std::move(file.state.packing)));
  } catch (const RunError& error) {
    throw InputError(args.inputs()[0], 0, "packing", "", std::string("cannot be marched: ") + error.what());
  }
  return exit_done;
}

}  // namespace isostat
