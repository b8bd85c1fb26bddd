// isostat draw INPUT -o FILE.svg|pdf|png [--what grains|forces|velocity] [--threshold F] [--width normal|total]
#include <algorithm>
#include <cmath>

#include "analysis/figure/figure_file.hpp"
#include "analysis/figure/packing_picture.hpp"
#include "apps/arguments.hpp"
#include "apps/commands.hpp"
#include "dem/input_error.hpp"
#include "dem/network_file.hpp"

namespace isostat {
namespace {

bool carries_forces(const Packing<2>& packing) {
  return std::any_of(packing.links.begin(), packing.links.end(), [](const Link<2>& l) { return total_force(l) > 0; });
}

double mean_force(const Packing<2>& packing) {
  double sum = 0;
  std::size_t loaded = 0;
  for (const Link<2>& link : packing.links)
    if (const double f = total_force(link); f > 0) sum += f, ++loaded;
  return loaded ? sum / static_cast<double>(loaded) : 1;
}

}  // namespace

int draw_command(int argc, char** argv) {
  const Arguments arguments(argc, argv, {{"-o"}, {"--what"}, {"--threshold"}, {"--width"}});
  if (arguments.inputs().size() != 1)
    throw InputError("command line", 0, "INPUT", std::to_string(arguments.inputs().size()) + " files",
                     "draw takes one packing");
  const std::string& path = arguments.inputs()[0];
  const auto what = arguments.choice("--what", {"grains", "forces", "velocity"});
  const auto threshold = arguments.number("--threshold");
  if (threshold && *threshold <= 0)
    throw InputError("command line", 0, "--threshold", *arguments.value("--threshold"), "must be positive");
  const auto width = arguments.choice("--width", {"normal", "total"});
  const FigureFile file(arguments.required("-o"));

  const Packing<2> packing = read_network<2>(path).packing;
  if (packing.bodies.size() == 0) throw InputError(path, 0, "", "", "has no grains to draw");

  PictureOptions options;
  const bool forces = carries_forces(packing);
  const std::string kind = what.value_or(threshold || width || forces ? "forces" : "grains");
  if (kind == "forces" && !forces)
    throw InputError(path, 0, "--what", "forces", "no link of this packing carries a force; draw grains");
  options.kind = kind == "forces"     ? PictureKind::forces
                 : kind == "velocity" ? PictureKind::velocity
                                      : PictureKind::grains;
  options.convention.threshold = threshold;
  options.convention.width =
      width.value_or(threshold ? "total" : "normal") == "total" ? ForceMeasure::total : ForceMeasure::normal;
  options.force_scale = mean_force(packing);

  const PackingPicture picture(packing, options);
  const auto canvas = file.canvas(picture.size());
  picture.draw(*canvas);
  file.write(*canvas);
  return exit_done;
}

}  // namespace isostat
