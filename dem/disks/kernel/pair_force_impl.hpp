// The pair force kernel: one source for every instruction set, law and tally. Included only by the translation units
// dem/disks/kernel/kernels_*.cpp, each compiled for its own instruction set.
#pragma once
#include "dem/disks/kernel/contact_law.hpp"
#include "dem/disks/kernel/crossing.hpp"
#include "dem/disks/kernel/pair_force.hpp"
#include "dem/disks/kernel/row.hpp"
#include "dem/state/link.hpp"

namespace isostat::kernel {

template <class V>
ISOSTAT_INLINE V load(const double* p) {
  return V(p, stdx::element_aligned);
}

template <class V, class Law, Tally kTally, bool kImages, Flow kFlow>
PairForceTally pair_forces(const PairForceInput& input) {
  const PairForceInput in = input;  // a copy that no store can alias: its fields stay in registers
  const DiskLaw& law = in.law;
  const V dt(in.time_step);
  const double braking = crossing_braking(law, in.time_step);
  V virial_x(0.0), virial_y(0.0), sliding(0.0), rolling(0.0);
  [[maybe_unused]] V virial_shear(0.0);

  // The loads of a batch are added while the next one is under way: a batch is a long chain of dependent operations
  // that ends with as many instructions as it began with, and the processor looks ahead less far than two batches.
  V late_x(0.0), late_y(0.0), late_a(0.0), late_b(0.0);
  std::size_t late = in.begin;

  for (std::size_t k = in.begin; k < in.end; k += V::size()) {
    PairDifference<V> d = load_differences(in.rows, in.pairs.i + k, in.pairs.j + k, V());
    add_loads(in.loads, in.pairs.i + late, in.pairs.j + late, late_x, late_y, late_a, late_b);
    if constexpr (kImages) {
      d.x += look_up(in.offset_x, in.pairs.shift + k, V());
      d.y += look_up(in.offset_y, in.pairs.shift + k, V());
    }
    if constexpr (kTally != Tally::nothing) {
      d.u = mul_add<V>(V(in.flow_half[0]), d.x, d.u);
      d.v = mul_add<V>(V(in.flow_half[1]), d.y, d.v);
      d.p = mul_add<V>(V(in.flow_now[0]), d.x, d.p);
      d.q = mul_add<V>(V(in.flow_now[1]), d.y, d.q);
    }
    if constexpr (kFlow == Flow::shear) {
      d.u = mul_add<V>(V(in.shear_half), d.y, d.u);
      d.p = mul_add<V>(V(in.shear_now), d.y, d.p);
    }
    const PairFrame<V> f = pair_frame<V>(d.x, d.y, load<V>(in.pairs.radius_sum + k));
    const auto contact = f.gap < V(0.0);
    const V repulsion = law::NormalLinear::repulsion(law, f.gap);

    V elastic = repulsion, damping(0.0);
    const V damping_coefficient = Law::Damping::acts ? load<V>(in.pairs.damping + k) : V(1.0);
    if constexpr (Law::Damping::acts) {
      const V receding = mul_add<V>(f.nx, d.p, f.ny * d.q);
      damping = select(contact, Law::Damping::force(damping_coefficient, receding), V(0.0));
    }
    const LinkVelocity<V> velocity = pair_velocity<V>(f, d.u, d.v, d.surface_sum, d.spin);
    V slip = velocity.tangential * dt, roll = velocity.rolling * dt;

    const V receded = velocity.normal * dt;
    const bool crossing = crosses(f.gap, receded);
    CrossingWeights<V> weight;
    if (crossing) [[unlikely]] {
      weight = crossing_weights<V>(f.gap, receded, braking, damping_coefficient);
      elastic = elastic * weight.elastic, damping = damping * weight.viscous;
      slip = slip * weight.stretch, roll = roll * weight.stretch;
    }
    V normal = elastic;
    if constexpr (Law::Adhesion::acts) normal += Law::Adhesion::force(law, f.gap);
    if constexpr (Law::Damping::acts) normal += damping;

    V tangential(0.0), moment(0.0), slipped(0.0);
    V* const watched = kTally == Tally::energy ? &slipped : nullptr;
    if constexpr (Law::Friction::acts) {
      tangential = law::spring<typename Law::Friction>(law, load<V>(in.pairs.tangential + k), slip, repulsion, watched);
      tangential.copy_to(in.pairs.tangential + k, stdx::element_aligned);
      if constexpr (kTally == Tally::energy) sliding += slipped * V(0.5 / law.tangential_stiffness);
    }
    if constexpr (Law::Rolling::acts) {
      moment = law::spring<typename Law::Rolling>(law, load<V>(in.pairs.moment + k), roll, repulsion, watched);
      moment.copy_to(in.pairs.moment + k, stdx::element_aligned);
      if constexpr (kTally == Tally::energy) rolling += slipped * V(0.5 / law.rolling_stiffness);
    }
    if (crossing) [[unlikely]] {
      if constexpr (Law::Friction::acts) tangential = tangential * weight.elastic;
      if constexpr (Law::Rolling::acts) moment = moment * weight.elastic;
    }

    const V fx = mul_add<V>(-f.ny, tangential, f.nx * normal);
    const V fy = mul_add<V>(f.nx, tangential, f.ny * normal);
    if constexpr (kTally != Tally::nothing) {
      virial_x = mul_add<V>(fx, d.x, virial_x);
      virial_y = mul_add<V>(fy, d.y, virial_y);
      if constexpr (kFlow == Flow::shear) virial_shear = mul_add<V>(fx, d.y, virial_shear);
    }
    late = k, late_x = fx, late_y = fy, late_a = -(f.lever_ratio * tangential), late_b = moment;
  }
  add_loads(in.loads, in.pairs.i + late, in.pairs.j + late, late_x, late_y, late_a, late_b);

  PairForceTally sum;
  if constexpr (kTally != Tally::nothing) sum.virial[0] = reduce(virial_x), sum.virial[1] = reduce(virial_y);
  if constexpr (kTally == Tally::energy) sum.sliding = reduce(sliding), sum.rolling = reduce(rolling);
  if constexpr (kFlow == Flow::shear) sum.shear_virial = reduce(virial_shear);
  return sum;
}

template <class V, class Law, Tally kTally, Flow kFlow = Flow::stretch>
PairForceTally pair_force_kernel(const PairForceInput& in) {
  return in.images ? pair_forces<V, Law, kTally, true, kFlow>(in) : pair_forces<V, Law, kTally, false, kFlow>(in);
}

template <class V, class Law>
inline constexpr KernelSet kernel_set = {&pair_force_kernel<V, Law, Tally::nothing>,
                                         &pair_force_kernel<V, Law, Tally::stress>,
                                         &pair_force_kernel<V, Law, Tally::energy>};

template <class V, class Law>
inline constexpr ShearKernelSet shear_kernel_set = {&pair_force_kernel<V, Law, Tally::stress, Flow::shear>,
                                                    &pair_force_kernel<V, Law, Tally::energy, Flow::shear>};

template <class V, class... Law>
constexpr std::array<KernelSet, sizeof...(Law)> kernel_table(Catalogue<Law...>) {
  return {kernel_set<V, Law>...};
}
template <class V, class... Law>
constexpr std::array<ShearKernelSet, sizeof...(Law)> shear_kernel_table(Catalogue<Law...>) {
  return {shear_kernel_set<V, Law>...};
}

}  // namespace isostat::kernel
