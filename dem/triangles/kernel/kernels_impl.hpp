// All kernels of one instruction set, by their needs. Included by kernels_*.cpp only, each compiled for one of them.
#pragma once
#include "dem/triangles/kernel/beam_force_impl.hpp"
#include "dem/triangles/kernel/motion_impl.hpp"
#include "dem/triangles/kernel/overlap_force_impl.hpp"

namespace isostat::kernel {

namespace {

template <class V, ContactLaw kLaw, bool kFriction, bool kVirial>
OverlapTally overlap_forces(const OverlapInput& in) {
  return overlap_forces_in<V, kLaw, kFriction, kVirial>(in);
}
template <class V, bool kDamping, bool kVirial>
BeamTally beam_forces(const BeamInput& in) {
  return beam_forces_in<V, kDamping, kVirial>(in);
}
template <class V, bool kKinetic>
DriftTally drift(const DriftInput& in) {
  return drift_in<V, kKinetic>(in);
}
template <class V>
void all_corners(std::size_t begin, std::size_t end, const GrainArrays& g) {
  all_corners_in<V>(begin, end, g);
}
template <class V>
void separations(const SeparationInput& in) {
  separations_in<V>(in);
}

template <class V, ContactLaw kLaw, bool kFriction>
OverlapKernel overlap_kernel(bool virial) {
  return virial ? overlap_forces<V, kLaw, kFriction, true> : overlap_forces<V, kLaw, kFriction, false>;
}

template <class V>
TriangleKernels kernels_of(const OverlapNeeds& overlap, const BeamNeeds& beams, bool kinetic) {
  TriangleKernels k{};
  if (overlap.law == ContactLaw::paper)  // has no friction (dem/triangles/check.cpp)
    k.overlap = overlap_kernel<V, ContactLaw::paper, false>(overlap.virial);
  else if (overlap.friction)
    k.overlap = overlap_kernel<V, ContactLaw::overlap_energy, true>(overlap.virial);
  else
    k.overlap = overlap_kernel<V, ContactLaw::overlap_energy, false>(overlap.virial);
  if (beams.damping)
    k.beams = beams.virial ? beam_forces<V, true, true> : beam_forces<V, true, false>;
  else
    k.beams = beams.virial ? beam_forces<V, false, true> : beam_forces<V, false, false>;
  k.drift = kinetic ? drift<V, true> : drift<V, false>;
  k.corners = all_corners<V>;
  k.separation = separations<V>;
  return k;
}

}  // namespace
}  // namespace isostat::kernel
