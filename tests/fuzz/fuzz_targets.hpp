// What the fuzzers call, and the tests on a small corpus: any bytes are read or refused by InputError; whatever is read
// must survive being written and read again. Anything else (a crash, another exception, a mismatch) is a bug.
#pragma once
#include <string>
#include <string_view>

namespace isostat {

void fuzz_scene(std::string_view bytes);
void fuzz_network(std::string_view bytes);
void fuzz_state(std::string_view bytes);         // as they are: mostly what the seal does
void fuzz_sealed_state(std::string_view bytes);  // sealed first: what HDF5 and the inner checks do

}  // namespace isostat
