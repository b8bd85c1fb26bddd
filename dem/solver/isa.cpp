#include "dem/solver/isa.hpp"

#include <cstdlib>
#include <string>

#include "dem/input_error.hpp"

namespace isostat {

Isa best_isa() {
  const Isa best = machine_isa();
  const char* asked = std::getenv("ISOSTAT_ISA");
  if (!asked) return best;
  for (Isa isa : {Isa::scalar, Isa::avx2, Isa::avx512})
    if (name(isa) == asked && isa <= best) return isa;
  throw InputError("environment", 0, "ISOSTAT_ISA", asked,
                   "one of scalar, avx2, avx512, up to what this machine and build have: " + std::string(name(best)));
}

}  // namespace isostat
