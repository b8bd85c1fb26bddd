#include "dem/files/state_file.hpp"

#include <filesystem>
#include <span>
#include <stdexcept>

#include "dem/disks/physical_hash.hpp"
#include "dem/disks/state_check.hpp"
#include "dem/disks/state_layout.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/files/hdf5_image.hpp"
#include "dem/files/state_io.hpp"
#include "dem/files/state_layout.hpp"
#include "dem/files/state_seal.hpp"
#include "dem/input_error.hpp"
#include "dem/spheres/physical_hash.hpp"
#include "dem/spheres/state_check.hpp"
#include "dem/spheres/state_layout.hpp"
#include "dem/triangles/physical_hash.hpp"
#include "dem/triangles/state_check.hpp"
#include "dem/triangles/state_layout.hpp"

namespace isostat {
namespace {

#if defined(__clang__)
const char* const kCompiler = "clang " __clang_version__;
#else
const char* const kCompiler = "g++ " __VERSION__;
#endif

const char* const kFormat = "isostat state";
constexpr int kFirstWithSystem = 4;  // files of earlier format versions are of disks

template <class System>
StateFile decode(const Hdf5Reader& file, const std::string& path, int sealed_version) {
  if (const std::string format = file.text_attribute("/", "format"); format != kFormat)
    throw InputError(path, 0, "/@format", format, "expected \"" + std::string(kFormat) + "\"");
  if (const auto version = file.attribute<std::int64_t>("/", "format_version"); version != sealed_version)
    throw InputError(path, 0, "format_version", std::to_string(version),
                     "the seal says " + std::to_string(sealed_version));
  StateFile result;
  State<System> state;
  StateReader reader(file, path, sealed_version);
  transfer(reader, state);
  reader.value("/provenance", "version", result.provenance.version);
  reader.value("/provenance", "compiler", result.provenance.compiler);
  reader.value("/provenance", "command", result.provenance.command);
  if (const auto fault = state_fault(state)) throw InputError(path, 0, fault->field, "", fault->rule);
  result.hash = physical_hash(state);
  if (const std::string stored = file.text_attribute("/", "hash"); stored != result.hash)
    throw InputError(path, 0, "hash", stored, "the physical state has the hash " + result.hash);
  result.state = std::move(state);
  return result;
}

}  // namespace

template <class System>
std::string encode_state(const State<System>& state, Provenance provenance) {
  if (const auto fault = state_fault(state))
    throw std::invalid_argument("a state that cannot be kept: " + fault->field + ": " + fault->rule);
  if (provenance.compiler.empty()) provenance.compiler = kCompiler;
  std::string image;
  {
    Hdf5Writer file(kSealBytes);
    file.attribute("/", "format", std::string_view(kFormat));
    file.attribute("/", "format_version", std::int64_t{kStateFormatVersion});
    file.attribute("/", "system", System::name);
    file.attribute("/", "hash", std::string_view(physical_hash(state)));
    file.group("/h5md/author");
    file.group("/h5md/creator");
    constexpr std::int64_t kH5mdVersion[] = {1, 1};
    file.attribute("/h5md", "version", std::span<const std::int64_t>(kH5mdVersion));
    file.attribute("/h5md/author", "name", std::string_view("unknown"));  // H5MD wants one; we keep no names
    file.attribute("/h5md/creator", "name", std::string_view("isostat"));
    file.attribute("/h5md/creator", "version", std::string_view(provenance.version));
    StateWriter writer(file, file_units(System{}), state.time, state.step);
    transfer(writer, const_cast<State<System>&>(state));  // a writer only looks
    writer.value("/provenance", "version", provenance.version);
    writer.value("/provenance", "compiler", provenance.compiler);
    writer.value("/provenance", "command", provenance.command);
    image = file.finish();
  }
  seal_state(image);
  return image;
}

std::string encode_state(const AnyState& any, Provenance provenance) {
  return std::visit([&](const auto& state) { return encode_state(state, std::move(provenance)); }, any);
}

StateFile decode_state(std::string_view image, const std::string& path) {
  const int version = check_seal(image, path);
  try {
    const Hdf5Reader file(image);
    const std::string system(version < kFirstWithSystem ? Disks::name : file.text_attribute("/", "system"));
    if (system == Disks::name) return decode<Disks>(file, path, version);
    if (system == TriangleGrains::name) return decode<TriangleGrains>(file, path, version);
    if (system == Spheres::name) return decode<Spheres>(file, path, version);
    throw InputError(path, 0, "/@system", system, "this isostat knows disks, triangles and spheres");
  } catch (const Hdf5Error& error) {
    throw InputError(path, 0, error.path, "", error.what());
  }
}

template <class System>
void write_state(const State<System>& state, const std::string& path, Provenance provenance) {
  write_file_atomically(path, encode_state(state, std::move(provenance)));
}

StateFile read_state_file(const std::string& path) { return decode_state(read_whole_file(path), path); }

AnyState read_state(const std::string& path) { return read_state_file(path).state; }

template <class System>
State<System> read_state(const std::string& path) {
  AnyState any = read_state(path);
  if (auto* state = std::get_if<State<System>>(&any)) return std::move(*state);
  const auto found = std::visit([]<class Other>(const State<Other>&) { return Other::name; }, any);
  throw InputError(path, 0, "system", std::string(found), "a state of " + std::string(System::name) + " is wanted");
}

bool is_state_file(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored) && !std::filesystem::is_directory(path, ignored) &&
         begins_like_state(first_bytes(path, kSealBytes));
}

template std::string encode_state(const State<Disks>&, Provenance);
template void write_state(const State<Disks>&, const std::string&, Provenance);
template State<Disks> read_state(const std::string&);
template std::string encode_state(const State<TriangleGrains>&, Provenance);
template void write_state(const State<TriangleGrains>&, const std::string&, Provenance);
template State<TriangleGrains> read_state(const std::string&);
template std::string encode_state(const State<Spheres>&, Provenance);
template void write_state(const State<Spheres>&, const std::string&, Provenance);
template State<Spheres> read_state(const std::string&);

}  // namespace isostat
