// The pair force kernel of spheres: one source for every instruction set, law, tally and flow. Included only by the
// translation units dem/spheres/kernel/kernels_*.cpp and shear_kernels_*.cpp, each compiled for its own instruction
// set.
#pragma once
#include "dem/spheres/kernel/contact_law.hpp"
#include "dem/spheres/kernel/pair_force.hpp"
#include "dem/spheres/kernel/row.hpp"
#include "dem/spheres/kernel/soft_lanes.hpp"
#include "dem/spheres/kernel/transport.hpp"

namespace isostat::spheres {

template <class V>
ISOSTAT_INLINE V load(const double* p) {
  return V(p, stdx::element_aligned);
}
template <class V>
ISOSTAT_INLINE Real3<V> load(const std::array<double*, 3>& p, std::size_t k) {
  return {load<V>(p[0] + k), load<V>(p[1] + k), load<V>(p[2] + k)};
}
template <class V>
ISOSTAT_INLINE void store(const std::array<double*, 3>& p, std::size_t k, const Real3<V>& x) {
  for (std::size_t a = 0; a < 3; ++a) x[a].copy_to(p[a] + k, stdx::element_aligned);
}

// x shortened to the limit >= 0 where it is longer. Root and division are for the batches that need them: most contacts
// stick.
template <class V>
ISOSTAT_INLINE void shorten(Real3<V>& x, V limit) {
  const V square = dot_3d<V>(x, x);
  const auto beyond = square > limit * limit;
  if (!any_of(beyond)) return;
  const V factor = select(beyond, limit / sqrt(square), V(1.0));
  for (V& c : x) c = c * factor;
}

inline constexpr double kNoOverlap = 1e-300;  // [a] a divisor that is not zero

// The part normal to n of a velocity with v.n = along, and that less the surface speeds' part at the contact.
template <class V>
ISOSTAT_INLINE Real3<V> without_normal(const Real3<V>& v, const Real3<V>& n, V along) {
  return {mul_add<V>(-along, n[0], v[0]), mul_add<V>(-along, n[1], v[1]), mul_add<V>(-along, n[2], v[2])};
}

template <class V>
ISOSTAT_INLINE Real3<V> without_lever(const Real3<V>& v, const PairFrame3<V>& f, const Real3<V>& surface_sum) {
  const Real3<V> turn = cross_3d<V>(surface_sum, f.n);
  return {mul_add<V>(-f.lever_ratio, turn[0], v[0]), mul_add<V>(-f.lever_ratio, turn[1], v[1]),
          mul_add<V>(-f.lever_ratio, turn[2], v[2])};
}

// Of a pair with a shell, whose radius and so the sum are below zero, the distance counts as negative, and all formulas
// hold as they stand: N > 0 pushes the grain towards the centre, the gap is R_s - R - |r|, and lever arms end at the
// contact point on the shell.
template <class V>
ISOSTAT_INLINE void face_shells(PairFrame3<V>& f, V radius_sum) {
  const V side = select(radius_sum < V(0.0), V(-1.0), V(1.0));
  for (V& n : f.n) n = side * n;
  f.distance = side * f.distance;
  f.gap = f.distance - radius_sum;
  f.lever_ratio = side * f.lever_ratio;
}

// Velocity of slip over a step, with the lever arms of its middle: a rigid rotation slips nowhere. With those of its
// end it would, by half a step times the product of the spins along and across n, always to the same side.
template <class V>
ISOSTAT_INLINE Real3<V> slip_rate(const PairDifference<V>& d, const Real3<V>& n, V half_step, V per_radius) {
  Real3<V> middle, slip;
  for (std::size_t a = 0; a < 3; ++a) middle[a] = mul_add<V>(-half_step, d.half_velocity[a], d.r[a]);
  const Real3<V> turn = cross_3d<V>(d.half_surface_sum, middle);
  for (std::size_t a = 0; a < 3; ++a) slip[a] = mul_add<V>(-per_radius, turn[a], d.half_velocity[a]);
  return without_normal<V>(slip, n, dot_3d<V>(slip, n));
}

template <class V, class Law, bool kStress, bool kImages, Flow kFlow>
PairForceTally pair_forces(const PairForceInput& input) {
  const PairForceInput in = input;  // a copy that no store can alias: its fields stay in registers
  const SphereLaw& law = in.law;
  constexpr bool kTurns = Law::Friction::acts || Law::Rolling::acts;
  const V dt(in.time_step), half_step(0.5 * in.time_step), zero(0.0), one(1.0);
  Real3<V> virial{zero, zero, zero};
  [[maybe_unused]] V shear_virial(0.0);

  // The loads of a batch are added while the next one is under way (dem/disks/kernel/pair_force_impl.hpp).
  Real3<V> late_force{zero, zero, zero}, late_arm{zero, zero, zero}, late_moment{zero, zero, zero};
  std::size_t late = in.begin;
  const auto add_late = [&] {
    if constexpr (kTurns)
      add_loads(in.loads, in.pairs.i + late, in.pairs.j + late, late_force, late_arm);
    else
      add_forces(in.loads, in.pairs.i + late, in.pairs.j + late, late_force);
    if constexpr (Law::Rolling::acts) add_moments(in.moments, in.pairs.i + late, in.pairs.j + late, late_moment);
  };

  for (std::size_t k = in.begin; k < in.end; k += V::size()) {
    PairDifference<V> d = load_differences<!kTurns>(in.rows, in.pairs.i + k, in.pairs.j + k, V());
    add_late();
    if constexpr (kImages)
      for (std::size_t a = 0; a < 3; ++a) d.r[a] = d.r[a] + look_up(in.offset[a].data(), in.pairs.shift + k, V());
    if constexpr (kStress)
      for (std::size_t a = 0; a < 3; ++a) {
        d.velocity[a] = mul_add<V>(V(in.flow_now[a]), d.r[a], d.velocity[a]);
        if constexpr (kTurns) d.half_velocity[a] = mul_add<V>(V(in.flow_half[a]), d.r[a], d.half_velocity[a]);
      }
    if constexpr (kFlow == Flow::shear) {
      d.velocity[0] = mul_add<V>(V(in.shear_now), d.r[1], d.velocity[0]);
      if constexpr (kTurns) d.half_velocity[0] = mul_add<V>(V(in.shear_half), d.r[1], d.half_velocity[0]);
    }
    const V radius_sum = load<V>(in.pairs.radius_sum + k);
    PairFrame3<V> f = pair_frame<V>(d.r, radius_sum);
    if constexpr (Law::Normal::unlike) face_shells(f, radius_sum);
    const auto contact = f.gap < zero;
    const V overlap = max(-f.gap, zero);
    const V stiffness = Law::Normal::stiffens ? load<V>(in.pairs.stiffness + k) : V(law.normal_stiffness);
    law::Repulsion<V> elastic = Law::Normal::force(stiffness, overlap);
    V damping_root = Law::Normal::damping_root(elastic.root);
    if constexpr (Law::Normal::unlike) soft_normal<V>(in.pairs, k, overlap, elastic.repulsion, damping_root);

    V normal = elastic.repulsion, damping(0.0), receding(0.0);
    if constexpr (Law::Adhesion::acts) normal = normal + Law::Adhesion::force(law, f.gap);
    if constexpr (Law::Damping::acts) {
      receding = dot_3d<V>(f.n, d.velocity);
      damping = load<V>(in.pairs.damping + k) * damping_root;
      if constexpr (!Law::Normal::stiffens) damping = select(contact, damping, zero);
      normal = mul_add<V>(-damping, receding, normal);
    }
    Real3<V> force{normal * f.n[0], normal * f.n[1], normal * f.n[2]};

    if constexpr (kTurns) {
      const V q = one / (f.distance * radius_sum), inverse = q * radius_sum, per_radius = q * f.distance;
      const V normal_rate = dot_3d<V>(f.n, d.half_velocity), receded = normal_rate * dt;
      Real3<V> slide = without_normal<V>(d.half_velocity, f.n, normal_rate);
      for (V& s : slide) s = s * dt;
      const ContactTurn<V> turn =
          contact_turn<V>(inverse, receded, slide, dot_3d<V>(f.n, d.half_surface_sum) * per_radius * dt);
      if constexpr (Law::Friction::acts) {
        V friction(law.friction), ratio(in.tangential_ratio);
        if constexpr (Law::Normal::unlike)
          friction = load<V>(in.pairs.friction + k), ratio = load<V>(in.pairs.tangential_ratio + k);
        const V limit = friction * elastic.repulsion;
        Real3<V> tangential = carried_tangential<V>(load<V>(in.pairs.tangential, k), f.n, turn);
        V softened(0.0), spring = select(contact, V(law.tangential_stiffness), zero);
        if constexpr (Law::Normal::stiffens) {
          // |r| - |r_old|: a chord of a rotation is no change of the distance
          const V lengthened = mul_add<V>(V(-0.5) * inverse, dot_3d<V>(slide, slide), receded);
          softened = sqrt(overlap / max(overlap + max(lengthened, zero), V(kNoOverlap)));
          spring = ratio * stiffness * elastic.root;
          if constexpr (Law::Normal::unlike) soft_tangential<V>(in.pairs, k, overlap, lengthened, spring, softened);
        } else {
          softened = select(contact, one, zero);
        }
        const Real3<V> slip = slip_rate<V>(d, f.n, half_step, per_radius);
        for (std::size_t a = 0; a < 3; ++a)
          tangential[a] = mul_add<V>(-(spring * dt), slip[a], softened * tangential[a]);
        shorten<V>(tangential, limit);
        if constexpr (Law::Normal::unlike)  // below the threshold of a soft contact: no zero with a sign
          for (V& t : tangential) t = select(limit > zero, t, zero);
        store<V>(in.pairs.tangential, k, tangential);
        if constexpr (Law::Damping::acts) {
          const Real3<V> sliding = without_lever<V>(without_normal<V>(d.velocity, f.n, receding), f, d.surface_sum);
          const V dashpot = V(law.tangential_damping) * damping;
          for (std::size_t a = 0; a < 3; ++a) tangential[a] = mul_add<V>(-dashpot, sliding[a], tangential[a]);
          shorten<V>(tangential, limit);
        }
        const Real3<V> across = cross_3d<V>(f.n, tangential);
        for (std::size_t a = 0; a < 3; ++a) {
          force[a] = force[a] + tangential[a];
          late_arm[a] = -(f.lever_ratio * across[a]);
        }
      }
      if constexpr (Law::Rolling::acts) {
        Real3<V> moment = carried_moment<V>(load<V>(in.pairs.moment, k), f.n, turn);
        const Real3<V> roll = load_spin_difference(in.spins, in.pairs.i + k, in.pairs.j + k, V());
        const V spring(law.rolling_stiffness * in.time_step);
        for (std::size_t a = 0; a < 3; ++a) moment[a] = select(contact, mul_add<V>(-spring, roll[a], moment[a]), zero);
        shorten<V>(moment, V(law.rolling_friction) * elastic.repulsion);
        store<V>(in.pairs.moment, k, moment);
        late_moment = moment;
      }
    }
    if constexpr (kStress)
      for (std::size_t a = 0; a < 3; ++a) virial[a] = mul_add<V>(force[a], d.r[a], virial[a]);
    if constexpr (kFlow == Flow::shear) shear_virial = mul_add<V>(force[0], d.r[1], shear_virial);
    late = k, late_force = force;
  }
  add_late();

  PairForceTally sum;
  if constexpr (kStress)
    for (std::size_t a = 0; a < 3; ++a) sum.virial[a] = reduce(virial[a]);
  if constexpr (kFlow == Flow::shear) sum.shear_virial = reduce(shear_virial);
  return sum;
}

template <class V, class Law, bool kStress, Flow kFlow = Flow::stretch>
PairForceTally pair_force_kernel(const PairForceInput& in) {
  return in.images ? pair_forces<V, Law, kStress, true, kFlow>(in) : pair_forces<V, Law, kStress, false, kFlow>(in);
}

template <class V, class... Law>
constexpr KernelTable kernel_table(Catalogue<Law...>) {
  return {KernelSet{&pair_force_kernel<V, Law, false>, &pair_force_kernel<V, Law, true>}...};
}
template <class V, class... Law>
constexpr ShearKernelTable shear_kernel_table(Catalogue<Law...>) {
  return {&pair_force_kernel<V, Law, true, Flow::shear>...};
}

}  // namespace isostat::spheres
