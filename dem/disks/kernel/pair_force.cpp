#include "dem/disks/kernel/pair_force.hpp"

#include <cstdlib>

#include "dem/disks/kernel/contact_law.hpp"
#include "dem/input_error.hpp"

namespace isostat {

Isa best_isa() {
  Isa best = Isa::scalar;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) best = Isa::avx2;
  if (best == Isa::avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
    best = Isa::avx512;
#endif
  const char* asked = std::getenv("ISOSTAT_ISA");
  if (!asked) return best;
  for (Isa isa : {Isa::scalar, Isa::avx2, Isa::avx512})
    if (name(isa) == asked && isa <= best) return isa;
  throw InputError("environment", 0, "ISOSTAT_ISA", asked,
                   "one of scalar, avx2, avx512, up to what this machine and build have: " + std::string(name(best)));
}

std::string_view name(Isa isa) {
  constexpr std::string_view names[] = {"scalar", "avx2", "avx512"};
  return names[static_cast<int>(isa)];
}

LawComposition composition(const LawParameters& p) {
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

PairForceKernel select_kernel(const LawParameters& p, Tally tally, Isa isa) {
  const LawComposition wanted = composition(p);
  const kernel::KernelTable& table = isa == Isa::avx512 ? kernel::avx512_kernels()
                                     : isa == Isa::avx2 ? kernel::avx2_kernels()
                                                        : kernel::scalar_kernels();
  for (std::size_t k = 0; k < table.size(); ++k)
    if (kernel::Supported::compositions[k] == wanted) return table[k][static_cast<std::size_t>(tally)];
  throw InputError("scene", 0, "law", words(wanted), "not among the supported laws:\n" + supported_compositions());
}

}  // namespace isostat
