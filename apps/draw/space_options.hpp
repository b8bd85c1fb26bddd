// isostat draw of packings in space: from where, or which section.
#pragma once
#include <optional>

#include "analysis/figure/sphere_slice.hpp"
#include "analysis/figure/view.hpp"
#include "apps/arguments.hpp"

namespace isostat {

// --view x|y|z|AZIMUTH,ELEVATION, or a view from the front, the right and above. Throws InputError.
View view_of(const Arguments& arguments);

// --slice x|y|z=POSITION. Throws InputError, also for a view beside it.
std::optional<Slice> slice_of(const Arguments& arguments);

}  // namespace isostat
