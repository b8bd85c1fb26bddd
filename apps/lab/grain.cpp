// isostat lab grain: the free vibrations of one grain of triangles and beams, and the largest stable time step.
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands.hpp"
#include "apps/json_output.hpp"
#include "apps/lab/experiments.hpp"
#include "dem/input_error.hpp"
#include "dem/triangles/grain_shape.hpp"
#include "dem/triangles/grain_spectrum.hpp"
#include "dem/triangles/grain_template.hpp"
#include "dem/triangles/stable_step.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json experiment(const Arguments& args) {
  GrainMaterial material;
  material.density = args.number("--density").value_or(material.density);
  material.stiffness = args.number("--stiffness").value_or(material.stiffness);
  material.bending = args.number("--bending").value_or(material.bending);
  material.damping = args.number("--damping").value_or(material.damping);
  const GrainTemplate grain = grain_template(
      grain_shape(args.required("--shape"), args.number("--size"), args.number("--refine").value_or(0)), material);
  const StableStep step = stable_step(grain);
  return {{"triangles", grain.triangles.size()},
          {"beams", grain.beams.size()},
          {"mass", grain.mass},
          {"inertia", grain.inertia},
          {"omega", grain_frequencies(grain)},
          {"dt_max", {{"gear", number_or_null(step.gear)}, {"verlet", number_or_null(step.verlet)}}}};
}

}  // namespace

int lab_grain(int argc, char** argv) {
  const Arguments args(
      argc, argv,
      {{"--shape", "NAME|FILE",
        "square, triangle, polygonN (N sides), rod, L, star, or a file of corners \"x y\" [cm]"},
       {"--size", "S",
        "[cm] side of square, triangle and polygonN, length of rod and L, diameter of star (default 0.14); of a file a "
        "factor (default 1)"},
       {"--stiffness", "E", "[g/s^2] force per elongation of a beam (default 1e5)"},
       {"--bending", "EI", "[g cm^3/s^2] (default 10)"},
       {"--damping", "G", "[g/s] gamma of the beams (default 9)"},
       {"--density", "RHO", "[g/cm^2] (default 1)"},
       {"--refine", "H", "[cm] cut the polygon of a file until no edge is longer"},
       kJsonOption},
      {"", "Mass, frequencies and stable time steps of one grain of triangles and beams."});
  args.require_inputs(0, 0, "no operand: the shape is --shape NAME or FILE");
  try {
    write_json(args, experiment(args));
  } catch (const InputError& error) {  // a fault of the grain is one of the option of that name
    std::vector<Fault> faults = error.faults();
    for (Fault& f : faults)
      if (f.file == "grain") f.file = "command line", f.key = "--" + f.key;
    throw InputError(std::move(faults));
  }
  return exit_done;
}

}  // namespace isostat
