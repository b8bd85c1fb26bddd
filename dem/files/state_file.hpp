// State files: one complete State in one HDF5 file, described in docs/formats.md (format version: kStateFormatVersion).
#pragma once
#include <string>
#include <string_view>

#include "dem/state/state.hpp"

namespace isostat {

// How a state came to be; no part of the physical state. The same run gives the same bytes, so there is no date and no
// host in it, and the caller leaves out of `command` what does not matter (output name, number of threads).
struct Provenance {
  std::string version;   // of isostat
  std::string compiler;  // default: this build's
  std::string command;   // arguments that made the state
  friend bool operator==(const Provenance&, const Provenance&) = default;
};

struct StateFile {
  State state;
  Provenance provenance;
  std::string hash;  // physical_hash of the state
};

// Writes atomically (temporary name, sync, rename). Throws InputError if the path cannot be written, and
// std::invalid_argument for a State that read_state would refuse (state_faults): nothing is written then.
void write_state(const State& state, const std::string& path, Provenance provenance = {});

// Throws one InputError for whatever is wrong: missing, no state file, truncated, damaged, of another format version,
// incomplete, or inconsistent.
State read_state(const std::string& path);
StateFile read_state_file(const std::string& path);

// Whether the file is there and begins like a state of isostat of any version.
bool is_state_file(const std::string& path);

// The same in memory; `path` names the bytes in faults.
std::string encode_state(const State& state, Provenance provenance = {});
StateFile decode_state(std::string_view image, const std::string& path);

}  // namespace isostat
