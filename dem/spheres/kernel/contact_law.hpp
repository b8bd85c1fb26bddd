// The supported contact laws of spheres: a visible list of compositions of the axes, each with every normal force. To
// add one, add a line to `Supported`, and the case to the tests that run them all; to add a law to an axis:
// docs/adding.md.
#pragma once
#include <array>

#include "dem/spheres/kernel/pair_force.hpp"
#include "dem/spheres/law/adhesion.hpp"
#include "dem/spheres/law/damping.hpp"
#include "dem/spheres/law/friction.hpp"
#include "dem/spheres/law/normal.hpp"

namespace isostat::spheres {

template <class A, class D, class F, class R>
struct Axes {
  using Adhesion = A;
  using Damping = D;
  using Friction = F;
  using Rolling = R;
};

template <class N, class A>
struct ContactLaw : A {
  using Normal = N;
  static constexpr LawComposition composition{N::keyword, A::Adhesion::keyword, A::Damping::keyword,
                                              A::Friction::keyword, A::Rolling::keyword};
};

template <class... Law>
struct Catalogue {
  static constexpr std::array<LawComposition, sizeof...(Law)> compositions{Law::composition...};
};
template <class... A>
struct WithEveryNormal {
  template <class... Unlike>  // and of unlike bodies these
  using And = Catalogue<ContactLaw<law::NormalHertz, A>..., ContactLaw<law::NormalLinear, A>...,
                        ContactLaw<law::NormalUnlike, Unlike>...>;
};

using namespace law;
using Supported = WithEveryNormal<                                                 //
    Axes<AdhesionNone, DampingCritical, FrictionNone, RollingNone>,                //
    Axes<AdhesionNone, DampingCritical, FrictionCoulomb, RollingNone>,             //
    Axes<AdhesionNone, DampingCritical, FrictionCoulomb, RollingElastoplastic>,    //
    Axes<AdhesionLinear, DampingCritical, FrictionNone, RollingNone>,              //
    Axes<AdhesionLinear, DampingCritical, FrictionCoulomb, RollingNone>,           //
    Axes<AdhesionLinear, DampingCritical, FrictionCoulomb, RollingElastoplastic>,  //
    Axes<AdhesionNone, DampingNone, FrictionNone, RollingNone>,                    //
    Axes<AdhesionNone, DampingNone, FrictionCoulomb, RollingNone>,                 //
    Axes<AdhesionNone, DampingNone, FrictionCoulomb, RollingElastoplastic>,        //
    Axes<AdhesionLinear, DampingNone, FrictionNone, RollingNone>,                  //
    Axes<AdhesionLinear, DampingNone, FrictionCoulomb, RollingNone>,               //
    Axes<AdhesionLinear, DampingNone, FrictionCoulomb, RollingElastoplastic>>::    //
    And<Axes<AdhesionNone, DampingCritical, FrictionNone, RollingNone>,            //
        Axes<AdhesionNone, DampingCritical, FrictionCoulomb, RollingNone>,         //
        Axes<AdhesionNone, DampingNone, FrictionNone, RollingNone>,                //
        Axes<AdhesionNone, DampingNone, FrictionCoulomb, RollingNone>>;

using KernelSet = std::array<PairForceKernel, 2>;  // by tally
using KernelTable = std::array<KernelSet, Supported::compositions.size()>;

const KernelTable& scalar_kernels();
const KernelTable& avx2_kernels();
const KernelTable& avx512_kernels();

// Of a cell that shears, which measures the stress: kernels of their own, so that a rectangular cell pays nothing.
using ShearKernelTable = std::array<PairForceKernel, Supported::compositions.size()>;

const ShearKernelTable& scalar_shear_kernels();
const ShearKernelTable& avx2_shear_kernels();
const ShearKernelTable& avx512_shear_kernels();

}  // namespace isostat::spheres
