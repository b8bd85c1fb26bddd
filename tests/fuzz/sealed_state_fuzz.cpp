// libFuzzer entry; build with -DISOSTAT_FUZZ=ON and clang, run as `bin/sealed_state_fuzz CORPUS_DIRECTORY`.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/fuzz_targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isostat::fuzz_sealed_state({reinterpret_cast<const char*>(data), size});
  return 0;
}
