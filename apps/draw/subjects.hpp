// isostat draw: what of each input is shown, alike in all pictures of a series.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "analysis/figure/picture_series.hpp"
#include "analysis/input.hpp"
#include "apps/arguments.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

struct Drawing {
  std::vector<std::unique_ptr<PictureSubject>> subjects;
  RichText length_unit;
  std::vector<RichText> captions;  // the times
};

// --what, or its default. Throws InputError for options that are not about it.
std::string what_to_draw(const Arguments& arguments, bool forces_known);

// Keep references to the packings. Throw InputError for an input in which there is nothing to draw, or not what is
// asked for.
Drawing drawing_of(const Arguments& arguments, const std::vector<AnalysisInput>& inputs);

struct TriangleInput {
  std::string path;
  State<TriangleGrains> state;
};
Drawing drawing_of(const Arguments& arguments, const std::vector<TriangleInput>& inputs);

}  // namespace isostat
