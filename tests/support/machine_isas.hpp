// The instruction sets that tests run. What this machine or ISOSTAT_ISA leaves out is printed, once a program: a green
// run does not mean more than it ran.
#pragma once
#include <iostream>
#include <vector>

#include "dem/solver/isa.hpp"

namespace isostat {

inline std::vector<Isa> machine_isas() {
  static const std::vector<Isa> here = [] {
    std::vector<Isa> list;
    for (Isa isa : {Isa::scalar, Isa::avx2, Isa::avx512}) {
      if (isa <= best_isa())
        list.push_back(isa);
      else
        std::cout << "[ NOT RUN  ] kernels for " << name(isa) << ": not on this machine, or not asked for\n";
    }
    return list;
  }();
  return here;
}

}  // namespace isostat
