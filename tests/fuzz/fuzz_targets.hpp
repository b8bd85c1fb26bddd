// What the fuzzers call, and the tests on a small corpus: any bytes are read or refused by InputError; whatever is read
// must survive being written and read again. Anything else (a crash, another exception, a mismatch) is a bug. States
// are not sealed anew after a mutation: HDF5 1.10.8 reads past its buffers on some forged headers (seen in
// H5O__attr_exists), which is why damage has to be found by the seal first.
#pragma once
#include <string>
#include <string_view>

namespace isostat {

void fuzz_scene(std::string_view bytes);
void fuzz_network(std::string_view bytes);
void fuzz_state(std::string_view bytes);
// A file of grains in any format, and after a line with % alone the file of its contacts (docs/formats.md); what is
// read can be kept as a state.
void fuzz_packing(std::string_view bytes);

}  // namespace isostat
