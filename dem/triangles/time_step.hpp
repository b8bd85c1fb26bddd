// The time step of a run of triangles: dt = c / omega, with omega the largest frequency of the smallest grain of each
// shape.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "dem/triangles/grain_template.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

GrainMaterial material_of(const Scene& scene);

// grains.shape, taken apart at its commas, without the spaces around them.
std::vector<std::string> shape_names(const std::string& list);

double grain_area(const GrainTemplate& grain);  // [cm^2]

// Of two such grains that lie with an edge on each other [1/s]: K = Y s^2 / l for the side s of a triangle, with l^2
// the area of the grain, acting in the middle of the side on the triangle by itself. Other contacts are shorter and
// softer.
double contact_frequency(const GrainTemplate& grain, double modulus);

// omega [1/s]: of the beams; of a grain without beams, which is rigid, contact_frequency().
double step_frequency(const GrainTemplate& grain, double modulus);

// The largest step at which a free grain is stable under this integrator, and its contact is, too [s].
double largest_step(const GrainTemplate& grain, double modulus, Integrator integrator);

// A grain of a packing as a template: its beams at rest, its triangles where they are.
GrainTemplate template_of(const TrianglePacking& packing, std::size_t grain, const GrainMaterial& material);

// The lightest free grain of each set of triangles and beams.
std::vector<GrainTemplate> smallest_grains(const TrianglePacking& packing, const GrainMaterial& material);

// c of the scene.
inline double triangle_step_fraction(const Scene& scene) { return scene.step.fraction.value_or(0.6); }

// dt [s] of a packing that has free grains.
double triangle_time_step(const Scene& scene, const TrianglePacking& packing);

}  // namespace isostat
