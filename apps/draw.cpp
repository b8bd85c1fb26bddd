// isostat draw: from the options to a picture of a packing.
#include <cmath>

#include "analysis/figure/figure_file.hpp"
#include "analysis/figure/packing_picture.hpp"
#include "analysis/load_input.hpp"
#include "analysis/network/coordination.hpp"
#include "analysis/network/force_scale.hpp"
#include "analysis/rigidity/clusters.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

PictureKind picture_kind(const Arguments& arguments, const AnalysisInput& input, bool forces_known) {
  const bool asks_forces = arguments.has("--threshold") || arguments.has("--width");
  const std::string what = arguments.choice("--what", {"grains", "forces", "velocity", "clusters", "modes"})
                               .value_or(asks_forces || forces_known ? "forces" : "grains");
  if (asks_forces && what != "forces")
    throw InputError("command line", 0, "--what", what, "--threshold and --width are about forces");
  if (what == "forces" && !forces_known)
    throw InputError(input.path, 0, "--what", "forces", "this file gives no forces; draw grains");
  if (what == "clusters") return PictureKind::clusters;
  if (what == "velocity" || what == "modes") return PictureKind::velocity;
  return what == "forces" ? PictureKind::forces : PictureKind::grains;
}

// Rigid clusters (analysis/rigidity/clusters.hpp) of the network under the input's own law, fixed cell.
void colour_clusters(const AnalysisInput& input, PictureOptions& options) {
  const RigidClusters found = rigid_clusters(input.packing, input.network_law({}), false);
  options.cluster_of_grain = found.cluster_of_grain;
  options.cluster_of_link = found.cluster_of_link;
  for (const RigidCluster& c : found.clusters) options.hyperstatic.push_back(c.hyperstatic > 0);
}

// The packing with the displacements of a vibration mode in the place of velocities; mode 1 is the lowest above zero.
Packing<2> displaced_by_mode(const AnalysisInput& input, int mode) {
  const VibrationModes modes = vibration_modes(input.packing, input.network_law({}), law_of(input), mode, true);
  if (modes.displacement.size() < static_cast<std::size_t>(mode))
    throw InputError("command line", 0, "--mode", std::to_string(mode),
                     "this packing has " + std::to_string(modes.displacement.size()) + " modes above zero");
  const std::vector<double>& u = modes.displacement.back();
  const auto per_body = static_cast<std::size_t>(modes.per_body);
  Packing<2> moved = input.packing;
  for (std::size_t i = 0; i < moved.bodies.size(); ++i) {
    moved.bodies.velocity[i] = {{u[per_body * i], u[per_body * i + 1]}};
    moved.bodies.spin[i] = per_body == 3 ? u[per_body * i + 2] : 0;
  }
  return moved;
}

// Scales and their names: of the law that the state knows, else bare numbers in the file's own units.
void name_scales(const AnalysisInput& input, const ForceReading& reading, PictureOptions& options) {
  options.force_scale = reading.scale;
  if (!reading.law_known) return;
  options.length_unit = rich("`a`");
  options.speed_unit = rich("`a`/`T`_{0}");
  options.spin_unit = rich("/`T`_{0}");
  const bool by_attraction = input.state->law.attraction >= reading.scale;
  options.force_scale_label = by_attraction ? rich("`F`_{0}") : rich("`aP`");
  options.width_at_scale = by_attraction ? kWidthAtF0 : kWidthAtAP;
}

}  // namespace

int draw_command(int argc, char** argv) {
  const Arguments arguments(
      argc, argv,
      {{"-o", "FILE", "the picture; its extension is the format: .svg, .pdf or .png"},
       {"--what", "KIND",
        "grains, forces, velocity, clusters or modes; default: forces, or grains if the file gives no forces"},
       {"--mode", "K", "which vibration mode --what modes draws, 1: the lowest above zero (default 1)"},
       {"--threshold", "F", "links whose total force is below F are blue, disks touched only by such light grey"},
       {"--width", "MEASURE", "line width by normal or total force; default: normal, with --threshold total"}},
      {"INPUT -o FILE", "Draws a packing: its grains, the forces between them, or their velocities."});
  arguments.require_inputs(1, 1, "one packing");
  const auto threshold = arguments.number("--threshold");
  if (threshold && !(*threshold > 0))
    throw InputError("command line", 0, "--threshold", *arguments.value("--threshold"), "must be positive");
  const auto width = arguments.choice("--width", {"normal", "total"});
  const FigureFile file(arguments.required("-o"));

  const AnalysisInput input = load_input(arguments.inputs()[0], {});
  if (input.packing_3d) throw InputError(input.path, 0, "", "", "is a packing in 3D; draw shows packings in the plane");
  if (input.packing.bodies.size() == 0) throw InputError(input.path, 0, "", "", "has no grains to draw");
  const ForceReading reading = read_forces(input);

  PictureOptions options;
  options.kind = picture_kind(arguments, input, reading.known);
  options.convention.threshold = threshold;
  options.convention.width =
      width.value_or(threshold ? "total" : "normal") == "total" ? ForceMeasure::total : ForceMeasure::normal;
  name_scales(input, reading, options);
  if (options.kind == PictureKind::forces && !reading.cohesive) {
    const Coordination c = coordination(input.packing, reading);
    options.rattler.assign(c.rattler.begin(), c.rattler.end());
  }
  if (options.kind == PictureKind::clusters) colour_clusters(input, options);
  const bool modes = arguments.value("--what") == "modes";
  const double mode = arguments.number("--mode").value_or(1);
  if (arguments.has("--mode") && !(modes && mode >= 1 && mode <= 100 && mode == std::floor(mode)))
    throw InputError("command line", 0, "--mode", *arguments.value("--mode"),
                     "an integer from 1 to 100, with --what modes");
  Packing<2> displaced;
  if (modes) {
    displaced = displaced_by_mode(input, static_cast<int>(mode));
    options.speed_symbol = rich("`u`");
    options.speed_unit = options.spin_unit = {};
  }
  const PackingPicture picture(modes ? displaced : input.packing, options);
  const auto canvas = file.canvas(picture.size());
  picture.draw(*canvas);
  file.write(*canvas);
  return exit_done;
}

}  // namespace isostat
