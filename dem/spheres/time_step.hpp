// The time step of spheres: dt = step.fraction sqrt(m / k) of the smallest grain, k the normal stiffness of its contact
// with another of its kind. Hertz: at an overlap of a tenth of its radius, more than a packing at rest has.
#pragma once
#include "dem/scene/scene.hpp"
#include "dem/spheres/sphere_law.hpp"

namespace isostat {

inline constexpr double kReferenceOverlap = 0.1;  // [radius]

// dN/dd [F0/a] of two equal spheres of this radius at the overlap `depth` [radius].
double stiffness_of_equal(const SphereLaw& law, double radius, double depth = kReferenceOverlap);

// sqrt(m / k) [T0].
double contact_time(const SphereLaw& law, double radius, double density);

// The same of the stiffest and lightest of a scene's grains.
double shortest_contact_time(const Scene& scene, double smallest_radius);

// Largest stable step over contact_time(), dt < 2 / omega_max with omega_max bounded for a grain among at most twelve
// neighbours as small: translation omega^2 = 2 * 12 (K_N + 2 K_T) / (3 m), rotation 2 * 8 (K_T R^2 + K_r) / I.
double critical_fraction(const SphereLaw& law, double radius, double density);
// Of the stiffest law of a scene's materials and stages.
double critical_fraction(const Scene& scene, double smallest_radius);

// c of the scene, or 0.1 and at most half of what is stable.
double step_fraction(const Scene& scene, double smallest_radius);

}  // namespace isostat
