// libFuzzer entry, built with clang and -DISOSTAT_FUZZ=ON and run by .ci/fuzz.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/fuzz_targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isostat::fuzz_network({reinterpret_cast<const char*>(data), size});
  return 0;
}
