#include "tests/fuzz/fuzz_targets.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "dem/disks/state_check.hpp"
#include "dem/files/formats/csv.hpp"
#include "dem/files/formats/dump.hpp"
#include "dem/files/network_file.hpp"
#include "dem/files/packing_file.hpp"
#include "dem/files/state_file.hpp"
#include "dem/input_error.hpp"
#include "dem/scene/file.hpp"
#include "dem/scene/text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

void require(bool condition, const char* what) {
  if (!condition) throw std::logic_error(what);
}

void write(const std::string& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

void fuzz_scene(std::string_view bytes) {
  Scene scene;
  try {
    scene = parse_scene(bytes, "fuzz");
  } catch (const InputError& error) {
    require(!error.faults().empty(), "an InputError without a fault");
    return;
  }
  require(parse_scene(scene_to_toml(scene), "again") == scene, "a scene changed on rewriting");
}

void fuzz_network(std::string_view bytes) {
  NetworkFile<2> file;
  try {
    file = parse_network<2>(bytes, "fuzz");
  } catch (const InputError& error) {
    require(!error.faults().empty(), "an InputError without a fault");
    return;
  }
  const std::string text = network_text(file.packing);
  require(network_text(parse_network<2>(text, "again").packing) == text, "a network changed on rewriting");
}

void fuzz_state(std::string_view bytes) {
  StateFile file;
  try {
    file = decode_state(bytes, "fuzz");
  } catch (const InputError& error) {
    require(!error.faults().empty(), "an InputError without a fault");
    return;
  }
  require(decode_state(encode_state(file.state, file.provenance), "again").hash == file.hash,
          "a state changed on rewriting");
}

void fuzz_packing(std::string_view bytes) {
  static const TemporaryFolder folder;
  const std::string grains = folder / "p";
  constexpr std::string_view kDivision = "\n%\n";
  const std::size_t end = bytes.find(kDivision);
  write(grains, bytes.substr(0, end));
  for (const std::string& contacts : {contacts_csv_path(grains), links_dump_path(grains)})
    if (end == std::string_view::npos)
      std::filesystem::remove(contacts);
    else
      write(contacts, bytes.substr(end + kDivision.size()));
  PackingFile file;
  try {
    file = read_packing(grains);
  } catch (const InputError& error) {
    require(!error.faults().empty(), "an InputError without a fault");
    return;
  }
  if (!file.packing_3d) require(!packing_fault(file.state.packing), "a packing with a fault");
}

}  // namespace isostat
