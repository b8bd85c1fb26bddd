// isostat draw: from the options to a picture of a packing.
#include "analysis/figure/figure_file.hpp"
#include "analysis/figure/nice_numbers.hpp"
#include "analysis/figure/packing_picture.hpp"
#include "analysis/load_input.hpp"
#include "analysis/network/coordination.hpp"
#include "analysis/network/force_scale.hpp"
#include "analysis/rigidity/clusters.hpp"
#include "analysis/stiffness/pseudo_inverse.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "dem/input_error.hpp"
#include "geometry/pores.hpp"

namespace isostat {
namespace {

using Content = std::unique_ptr<PictureContent>;

RichText length_unit(const ForceReading& reading) { return reading.law_known ? rich("`a`") : RichText{}; }

Content forces(const Arguments& arguments, const AnalysisInput& input, const ForceReading& reading) {
  if (!reading.known) throw InputError(input.path, 0, "--what", "forces", "this file gives no forces; draw grains");
  ForceOptions options;
  options.convention.threshold = arguments.number("--threshold");
  const auto width = arguments.value("--width").value_or(options.convention.threshold ? "total" : "normal");
  options.convention.width = width == "total" ? ForceMeasure::total : ForceMeasure::normal;
  options.scale = reading.scale;
  if (reading.law_known) {
    const bool by_attraction = input.state.law.attraction >= reading.scale;
    options.scale_label = by_attraction ? rich("`F`_{0}") : rich("`aP`");
    options.width_at_scale = by_attraction ? kWidthAtF0 : kWidthAtAP;
  }
  if (!reading.cohesive) {
    const Coordination c = coordination(input.packing(), reading);
    options.rattler.assign(c.rattler.begin(), c.rattler.end());
  }
  return forces_content(std::move(options));
}

Content velocity(const AnalysisInput& input, const ForceReading& reading) {
  MotionOptions options{
      input.packing().bodies.velocity, input.packing().bodies.spin, rich("`v`"), plain("spin"), {}, {}, {}};
  if (reading.law_known) options.speed_unit = rich("`a`/`T`_{0}"), options.spin_unit = rich("/`T`_{0}");
  return motion_content(std::move(options));
}

// The n-th vibration mode above the zero modes; only ratios of displacements mean something.
Content mode(const Arguments& arguments, const AnalysisInput& input, const ForceReading& reading) {
  const auto number = static_cast<int>(arguments.integer("--mode", 1, 1000).value_or(1));
  const auto refuse = [&](const std::string& why) { throw InputError(input.path, 0, "--what", "modes", why); };
  VibrationModes modes;
  try {
    modes = vibration_modes(input.packing(), input.network_law({}), law_of(input), number, true);
  } catch (const std::length_error& error) {
    refuse(error.what());
  } catch (const FactorisationFailed& error) {
    refuse(error.what());
  }
  if (modes.displacement.size() < static_cast<std::size_t>(number))
    refuse("has " + std::to_string(modes.displacement.size()) + " vibration modes above its " +
           std::to_string(modes.zero_modes) + " zero modes");
  const std::vector<double>& u = modes.displacement.back();
  MotionOptions options;
  for (std::size_t i = 0; i < input.packing().bodies.size(); ++i) {
    const std::size_t at = i * static_cast<std::size_t>(modes.per_body);
    options.velocity.push_back({{u[at], u[at + 1]}});
    options.spin.push_back(modes.per_body > 2 ? u[at + 2] : 0.0);
  }
  options.symbol = rich("`u`"), options.spin_name = plain("rotation");
  options.notes.push_back(rich("`ω`_{" + std::to_string(number) + "} = ") +
                          number_with_unit(modes.omega[static_cast<std::size_t>(number - 1)],
                                           reading.law_known ? rich("/`T`_{0}") : RichText{}));
  return motion_content(std::move(options));
}

Content clusters(const AnalysisInput& input) {
  const RigidClusters rigid = rigid_clusters(input.packing(), input.network_law({}), false);
  ClusterOptions options{rigid.cluster_of_grain, rigid.cluster_of_link, {}};
  for (const RigidCluster& c : rigid.clusters) options.hyperstatic.push_back(c.hyperstatic > 0);
  return clusters_content(std::move(options));
}

// Outer walls run clockwise: their area is negative.
double signed_area(const Polygon& wall) {
  double twice = 0;
  for (std::size_t k = 0; k < wall.size(); ++k) {
    const Vec2 a = wall[k] - wall[0], b = wall[(k + 1) % wall.size()] - wall[0];
    twice += a[0] * b[1] - b[0] * a[1];
  }
  return twice / 2;
}

Content pores(const AnalysisInput& input, const ForceReading& reading) {
  const Bodies<2>& b = input.packing().bodies;
  PoreOptions how;
  how.with_arcs = true;
  Pores found;
  try {
    found = input.packing().cell ? find_pores(b.position, b.radius, *input.packing().cell, how)
                                 : find_enclosed_pores(b.position, b.radius, how);
  } catch (const std::invalid_argument& error) {
    throw InputError(input.path, 0, "--what", "pores", error.what());
  }
  PoreMapOptions options;
  options.length_unit = length_unit(reading);
  for (std::size_t p = 0; p < found.pores.size(); ++p) {
    const Pore& pore = found.pores[p];
    options.percolating = options.percolating || pore.percolating;
    if (pore.percolating) continue;
    for (Polygon& wall : pore_polygons(found, p))
      if (signed_area(wall) < 0) options.pores.push_back({std::move(wall), pore.area, pore.equivalent_radius});
  }
  return pores_content(std::move(options));
}

Content content_of(const Arguments& arguments, const AnalysisInput& input, const ForceReading& reading) {
  const bool asks_forces = arguments.has("--threshold") || arguments.has("--width");
  const std::string what = arguments.value("--what").value_or(asks_forces || reading.known ? "forces" : "grains");
  if (asks_forces && what != "forces")
    throw InputError("command line", 0, "--what", what, "--threshold and --width are about forces");
  if (arguments.has("--mode") && what != "modes")
    throw InputError("command line", 0, "--what", what, "--mode is about modes");
  if (what == "forces") return forces(arguments, input, reading);
  if (what == "velocity") return velocity(input, reading);
  if (what == "modes") return mode(arguments, input, reading);
  if (what == "clusters") return clusters(input);
  if (what == "pores") return pores(input, reading);
  return grains_content();
}

}  // namespace

int draw_command(int argc, char** argv) {
  const Arguments arguments(
      argc, argv,
      {{"-o", "FILE", "the picture; its extension is the format: .svg, .pdf or .png"},
       {"--what", "KIND",
        "grains, forces, pores, clusters, modes or velocity; default: forces, or grains if the file gives no forces"},
       {"--threshold", "F", "links whose total force is below F are blue, disks touched only by such light grey"},
       {"--width", "MEASURE", "line width by normal or total force; default: normal, with --threshold total"},
       {"--mode", "N", "which vibration mode, from the lowest above the zero modes; default 1"}},
      {"INPUT -o FILE", "Draws a packing: its grains, the forces between them, pores, rigid clusters, motion."});
  arguments.require_inputs(1, 1, "one packing");
  (void)arguments.choice("--what", {"grains", "forces", "pores", "clusters", "modes", "velocity"});
  (void)arguments.choice("--width", {"normal", "total"});
  if (const auto threshold = arguments.number("--threshold"); threshold && !(*threshold > 0))
    throw InputError("command line", 0, "--threshold", *arguments.value("--threshold"), "must be positive");
  const FigureFile file(arguments.required("-o"));

  const AnalysisInput input = load_input(arguments.inputs()[0], {});
  if (input.packing_3d) throw InputError(input.path, 0, "", "", "is a packing in 3D; draw shows packings in the plane");
  if (input.grains() == 0) throw InputError(input.path, 0, "", "", "has no grains to draw");
  const ForceReading reading = read_forces(input);
  const PackingPicture picture(input.packing(), content_of(arguments, input, reading), length_unit(reading));
  const auto canvas = file.canvas(picture.size());
  picture.draw(*canvas);
  file.write(*canvas);
  return exit_done;
}

}  // namespace isostat
