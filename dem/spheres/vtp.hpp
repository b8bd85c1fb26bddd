// VTK PolyData of spheres: what vtk_polydata() of a packing gives, with the groups of the spheres and their contacts
// with walls (docs/formats.md).
#pragma once
#include <string>

#include "dem/spheres/spheres.hpp"

namespace isostat {

std::string vtk_polydata(const SpherePacking& packing, double time);

}  // namespace isostat
