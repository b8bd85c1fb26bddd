#include "dem/solver/isa.hpp"

#include <cstdlib>
#include <string>

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

}  // namespace isostat
