// What `analyze --only modes --density-of-states` asks for.
#pragma once
#include <algorithm>

namespace isostat {

struct DensityOptions {
  int bins = 100;                  // at the most
  int moments = 0;                 // 0: the default
  int vectors = 16;                // random ones
  int chebyshev_moments() const {  // by default eight a bin: the kernel is a fifth of a bin wide, or half of one
    return moments > 0 ? moments : std::max(8 * bins, 64);
  }
};

}  // namespace isostat
