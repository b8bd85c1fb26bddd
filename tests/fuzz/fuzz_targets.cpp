#include "tests/fuzz/fuzz_targets.hpp"

#include <stdexcept>

#include "dem/input_error.hpp"
#include "dem/network_file.hpp"
#include "dem/scene_file.hpp"
#include "dem/scene_text.hpp"
#include "dem/state_file.hpp"

namespace isostat {
namespace {

void require(bool condition, const char* what) {
  if (!condition) throw std::logic_error(what);
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

}  // namespace isostat
