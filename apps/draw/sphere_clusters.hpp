// Spheres in the colours of their rigid clusters: neighbours differ, hyperstatic ones are strong.
#pragma once
#include <memory>

#include "analysis/figure/sphere_content.hpp"
#include "analysis/input.hpp"

namespace isostat {

std::unique_ptr<SphereContent> sphere_clusters(const AnalysisInput& input);

}  // namespace isostat
