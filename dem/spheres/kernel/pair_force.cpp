#include "dem/spheres/kernel/pair_force.hpp"

#include "dem/input_error.hpp"
#include "dem/spheres/kernel/contact_law.hpp"

namespace isostat::spheres {

LawComposition composition(const SphereLaw& p, bool unlike) {
  const bool hertz = p.normal == NormalForce::hertz;
  return {!hertz ? (unlike ? "linear of unlike bodies" : NormalLinear::keyword)
                 : (unlike ? NormalUnlike::keyword : NormalHertz::keyword),
          p.attraction > 0 ? AdhesionLinear::keyword : AdhesionNone::keyword,
          p.damping > 0 ? DampingCritical::keyword : DampingNone::keyword,
          p.friction > 0 ? FrictionCoulomb::keyword : FrictionNone::keyword,
          p.rolling_friction > 0 ? RollingElastoplastic::keyword : RollingNone::keyword};
}

namespace {
std::string words(const LawComposition& c) {
  std::string s = "normal ";
  s.append(c.normal).append(", adhesion ").append(c.adhesion).append(", damping ").append(c.damping);
  return s.append(", friction ").append(c.friction).append(", rolling ").append(c.rolling);
}
}  // namespace

std::string supported_compositions() {
  std::string list;
  for (const LawComposition& c : Supported::compositions) list += words(c) + "\n";
  return list;
}

PairForceKernel select_kernel(const SphereLaw& p, Tally tally, Isa isa, bool unlike, Flow flow) {
  const LawComposition wanted = composition(p, unlike);
  const KernelTable& table = isa == Isa::avx512 ? avx512_kernels()
                             : isa == Isa::avx2 ? avx2_kernels()
                                                : scalar_kernels();
  const ShearKernelTable& sheared = isa == Isa::avx512 ? avx512_shear_kernels()
                                    : isa == Isa::avx2 ? avx2_shear_kernels()
                                                       : scalar_shear_kernels();
  for (std::size_t k = 0; k < table.size(); ++k)
    if (Supported::compositions[k] == wanted)
      return flow == Flow::shear ? sheared[k] : table[k][static_cast<std::size_t>(tally)];
  throw InputError("scene", 0, "law", words(wanted), "not among the supported laws:\n" + supported_compositions());
}

}  // namespace isostat::spheres
