// isostat draw: what of each input is shown, alike in all pictures of a series.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "analysis/figure/picture_series.hpp"
#include "analysis/input.hpp"
#include "analysis/stiffness/vibration.hpp"
#include "apps/arguments.hpp"

namespace isostat {

struct Drawing {
  std::vector<std::unique_ptr<PictureSubject>> subjects;
  RichText length_unit;
  std::vector<RichText> captions;  // the times
};

// Keeps references to the packings, which are of one system. Throws InputError for an input in which there is nothing
// to draw, or not what is asked for.
Drawing drawing_of_disks(const Arguments& arguments, const std::vector<AnalysisInput>& inputs);
Drawing drawing_of_spheres(const Arguments& arguments, const std::vector<AnalysisInput>& inputs);
Drawing drawing_of_triangles(const Arguments& arguments, const std::vector<AnalysisInput>& inputs);

// --what, or its default. Throws InputError for options that are not about it.
std::string what_to_draw(const Arguments& arguments, bool forces_known);

// --threshold and --width.
ForceConvention convention_of(const Arguments& arguments);

// The n-th vibration mode above the zero modes, n = --mode; only ratios of displacements mean something. Throws
// InputError where there is none.
struct DrawnMode {
  std::vector<Vec2> displacement;  // one a body of the network
  std::vector<double> rotation;
  RichText note;  // its frequency
};
DrawnMode drawn_mode(const Arguments& arguments, const AnalysisInput& input, const RichText& frequency_unit);

}  // namespace isostat
