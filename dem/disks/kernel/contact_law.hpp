// The supported contact laws: a visible list of compositions of the axes. To add one, add a line to `Supported`, and
// the case to the tests that run them all; to add a law to an axis: docs/adding.md.
#pragma once
#include <array>

#include "dem/disks/kernel/pair_force.hpp"
#include "dem/disks/law/adhesion.hpp"
#include "dem/disks/law/damping.hpp"
#include "dem/disks/law/friction.hpp"
#include "dem/disks/law/normal.hpp"

namespace isostat::kernel {

template <class A, class D, class F, class R>
struct ContactLaw {
  using Adhesion = A;
  using Damping = D;
  using Friction = F;
  using Rolling = R;
  static constexpr LawComposition composition{A::keyword, D::keyword, F::keyword, R::keyword};
};

template <class... Law>
struct Catalogue {
  static constexpr std::array<LawComposition, sizeof...(Law)> compositions{Law::composition...};
};

using namespace law;
using Supported = Catalogue<                                                             //
    ContactLaw<AdhesionNone, DampingCritical, FrictionNone, RollingNone>,                //
    ContactLaw<AdhesionNone, DampingCritical, FrictionCoulomb, RollingNone>,             //
    ContactLaw<AdhesionNone, DampingCritical, FrictionCoulomb, RollingElastoplastic>,    //
    ContactLaw<AdhesionLinear, DampingCritical, FrictionNone, RollingNone>,              //
    ContactLaw<AdhesionLinear, DampingCritical, FrictionCoulomb, RollingNone>,           //
    ContactLaw<AdhesionLinear, DampingCritical, FrictionCoulomb, RollingElastoplastic>,  //
    ContactLaw<AdhesionNone, DampingNone, FrictionNone, RollingNone>,                    //
    ContactLaw<AdhesionNone, DampingNone, FrictionCoulomb, RollingNone>,                 //
    ContactLaw<AdhesionNone, DampingNone, FrictionCoulomb, RollingElastoplastic>,        //
    ContactLaw<AdhesionLinear, DampingNone, FrictionNone, RollingNone>,                  //
    ContactLaw<AdhesionLinear, DampingNone, FrictionCoulomb, RollingNone>,               //
    ContactLaw<AdhesionLinear, DampingNone, FrictionCoulomb, RollingElastoplastic>>;

// By tally: nothing, stress, energy.
using KernelSet = std::array<PairForceKernel, 3>;
using KernelTable = std::array<KernelSet, Supported::compositions.size()>;

const KernelTable& scalar_kernels();
const KernelTable& avx2_kernels();
const KernelTable& avx512_kernels();

// Of a cell that shears, by tally from stress on: kernels of their own, so that a rectangular cell pays nothing.
using ShearKernelSet = std::array<PairForceKernel, 2>;
using ShearKernelTable = std::array<ShearKernelSet, Supported::compositions.size()>;

const ShearKernelTable& scalar_shear_kernels();
const ShearKernelTable& avx2_shear_kernels();
const ShearKernelTable& avx512_shear_kernels();

}  // namespace isostat::kernel
