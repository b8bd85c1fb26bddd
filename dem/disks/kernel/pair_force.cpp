#include "dem/disks/kernel/pair_force.hpp"

#include "dem/disks/kernel/contact_law.hpp"
#include "dem/input_error.hpp"

namespace isostat {

LawComposition composition(const DiskLaw& p) {
  return {p.attraction > 0 ? law::AdhesionLinear::keyword : law::AdhesionNone::keyword,
          p.damping > 0 ? law::DampingCritical::keyword : law::DampingNone::keyword,
          p.friction > 0 ? law::FrictionCoulomb::keyword : law::FrictionNone::keyword,
          p.rolling_friction > 0 ? law::RollingElastoplastic::keyword : law::RollingNone::keyword};
}

namespace {
std::string words(const LawComposition& c) {
  std::string s = "adhesion ";
  s.append(c.adhesion).append(", damping ").append(c.damping).append(", friction ").append(c.friction);
  return s.append(", rolling ").append(c.rolling);
}
}  // namespace

std::string supported_compositions() {
  std::string list;
  for (const LawComposition& c : kernel::Supported::compositions) list += words(c) + "\n";
  return list;
}

PairForceKernel select_kernel(const DiskLaw& p, Tally tally, Isa isa, Flow flow) {
  const LawComposition wanted = composition(p);
  const kernel::KernelTable& table = isa == Isa::avx512 ? kernel::avx512_kernels()
                                     : isa == Isa::avx2 ? kernel::avx2_kernels()
                                                        : kernel::scalar_kernels();
  const kernel::ShearKernelTable& sheared = isa == Isa::avx512 ? kernel::avx512_shear_kernels()
                                            : isa == Isa::avx2 ? kernel::avx2_shear_kernels()
                                                               : kernel::scalar_shear_kernels();
  const auto t = static_cast<std::size_t>(tally);
  for (std::size_t k = 0; k < table.size(); ++k)
    if (kernel::Supported::compositions[k] == wanted) return flow == Flow::shear ? sheared[k].at(t - 1) : table[k][t];
  throw InputError("scene", 0, "law", words(wanted), "not among the supported laws:\n" + supported_compositions());
}

}  // namespace isostat
