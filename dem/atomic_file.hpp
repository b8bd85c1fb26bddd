// Files appear whole or not at all: written under a temporary name beside the target, synced, renamed.
#pragma once
#include <string>
#include <string_view>

namespace isostat {

// Throws InputError (path and the system's reason) and leaves the old file, if any, as it was.
void write_file_atomically(const std::string& path, std::string_view bytes);

// Throws InputError unless a file could be created at this path now: to be asked before a long run starts.
void require_writable(const std::string& path);

// The whole file; InputError if it cannot be read.
std::string read_whole_file(const std::string& path);

}  // namespace isostat
