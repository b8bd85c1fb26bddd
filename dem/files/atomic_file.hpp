// Files appear whole or not at all: written under a temporary name beside the target, synced, renamed.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isostat {

// Throws InputError (path and the system's reason) and leaves the old file, if any, as it was. A symbolic link keeps
// pointing where it did, be its target there or not; to a device or a pipe the bytes are simply written.
void write_file_atomically(const std::string& path, std::string_view bytes);

// Several files that belong together: all are written in full before the first appears under its name.
void write_files_atomically(const std::vector<std::pair<std::string, std::string>>& path_and_bytes);

// Throws InputError unless a file could be created at each path now: to be asked before a long run starts.
void require_writable(const std::string& path);
void require_writable(const std::vector<std::string>& paths);

// Removes the temporary files that killed programs have left of these files, and nothing that is still being written.
void remove_abandoned(const std::vector<std::string>& paths);

// Where a symbolic link points in the end, be there a file or not; other paths as they are. InputError if it goes
// round.
std::string link_target(std::string path);

// The whole file; InputError if it cannot be read. Of a pipe what came out of it the first time.
std::string read_whole_file(const std::string& path);
// At most so many bytes of its beginning.
std::string first_bytes(const std::string& path, std::size_t most);

}  // namespace isostat
