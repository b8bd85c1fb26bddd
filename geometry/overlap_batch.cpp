#include "geometry/overlap_batch.hpp"

#include "geometry/overlap_batch_impl.hpp"

namespace isostat {

OverlapBatch overlap_batch(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return kernel::overlap_batch_avx512;
    case Isa::avx2:
      return kernel::overlap_batch_avx2;
    default:
      return kernel::overlap_batch_scalar;
  }
}

}  // namespace isostat
