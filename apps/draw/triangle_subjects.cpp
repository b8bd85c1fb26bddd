#include <algorithm>

#include "analysis/figure/triangle_content.hpp"
#include "apps/draw/subjects.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

using Content = std::unique_ptr<TriangleContent>;

std::vector<Content> forces(const Arguments& arguments, const std::vector<TriangleInput>& inputs) {
  TriangleForceOptions options;
  options.convention.threshold = arguments.number("--threshold");
  const auto width = arguments.value("--width").value_or(options.convention.threshold ? "total" : "normal");
  options.convention.width = width == "total" ? ForceMeasure::total : ForceMeasure::normal;
  options.scale = 0;
  for (const TriangleInput& input : inputs)
    options.scale = std::max(options.scale, mean_overlap_force(input.state.packing));
  std::vector<Content> contents;
  for (std::size_t k = 0; k < inputs.size(); ++k) contents.push_back(triangle_forces_content(options));
  return contents;
}

std::vector<Content> velocities(const std::vector<TriangleInput>& inputs) {
  std::vector<GrainMotion> motions;
  MotionScale scale;
  for (const TriangleInput& input : inputs) {
    const TrianglePacking& p = input.state.packing;
    motions.push_back(grain_motion(p, p.bodies.velocity, p.bodies.spin));
    scale = larger(scale, motion_scale(motions.back().velocity, motions.back().spin));
  }
  std::vector<Content> contents;
  for (GrainMotion& m : motions)
    contents.push_back(triangle_motion_content(
        std::move(m.centre),
        {std::move(m.velocity), std::move(m.spin), rich("`v`"), plain("spin"), plain("cm/s"), plain("/s"), {}, scale}));
  return contents;
}

}  // namespace

Drawing drawing_of(const Arguments& arguments, const std::vector<TriangleInput>& inputs) {
  bool overlaps = false;
  for (const TriangleInput& input : inputs) {
    if (input.state.packing.grains.size() == 0) throw InputError(input.path, 0, "", "", "has no grains to draw");
    overlaps = overlaps || !input.state.packing.overlaps.empty();
  }
  const std::string what = what_to_draw(arguments, overlaps);
  std::vector<Content> contents;
  if (what == "forces")
    contents = forces(arguments, inputs);
  else if (what == "velocity")
    contents = velocities(inputs);
  else if (what == "grains")
    for (std::size_t k = 0; k < inputs.size(); ++k) contents.push_back(triangle_grains_content());
  else
    throw InputError(inputs[0].path, 0, "--what", what,
                     "of grains of triangles draw shows grains, forces and velocity");
  Drawing drawing;
  drawing.length_unit = plain("cm");
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const State<TriangleGrains>& state = inputs[k].state;
    drawing.subjects.push_back(
        std::make_unique<TriangleSubject>(state.packing, std::move(contents[k]), room_of(state.scene.container)));
    drawing.captions.push_back(rich("`t` = ") + number_with_unit(state.time, plain("s")));
  }
  return drawing;
}

}  // namespace isostat
