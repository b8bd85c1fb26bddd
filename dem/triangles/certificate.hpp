// The certificate of a packing of triangle grains, dem/state/certificate.hpp. Forces and moments are judged on every
// triangle, beams included; walls are not judged; the kinetic energy is a mean over the free grains.
#pragma once
#include "dem/scene/scene.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/certificate.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

// The unit of length of the criteria: root of the area of the largest free grain [cm].
double grain_length(const TrianglePacking& packing);
// F1 = max(a P, weight of the heaviest free grain) [dyn]; 1 where neither is positive.
double force_scale(const TrianglePacking& packing, const ImposedStress<2>& imposed, double gravity);

// Static loads of beams, overlaps, friction springs and weight on every triangle [dyn, dyn cm], from its positions.
std::vector<BodyLoad> net_loads(const TrianglePacking& packing, const TriangleLaw& law, double gravity,
                                StressTensor* virial = nullptr);
// sigma_ab of beams, overlaps and motion, compression positive [g/s^2]; needs a cell.
StressTensor measured_stress(const State<TriangleGrains>& state);

Certificate evaluate_certificate(const TrianglePacking& packing, const TriangleLaw& law,
                                 const ImposedStress<2>& imposed, const EquilibriumScene& tolerance,
                                 double gravity = 0);
Certificate evaluate_certificate(const State<TriangleGrains>& state);
// sqrt(m a / F1) of the heaviest free grain, F1 = a P [s] (dem/run/loading.hpp).
double inertial_time(const State<TriangleGrains>& state, double pressure);
// Overlaps that carry a force.
std::size_t loaded_contacts(const State<TriangleGrains>& state);

// Of the grains as the stage runner asks (dem/run/): area over that of the cell, connected ones, the set of
// overlapping pairs as a number.
double solid_fraction(const TrianglePacking& packing, const std::optional<PeriodicCell<2>>& cell);
std::size_t count_clusters(const TrianglePacking& packing);
std::uint64_t contact_set(const TrianglePacking& packing);

}  // namespace isostat
