#include "tests/fuzz/seeds.hpp"

#include <algorithm>
#include <filesystem>

#include "dem/files/atomic_file.hpp"
#include "dem/files/formats/csv.hpp"
#include "dem/files/formats/dump.hpp"
#include "dem/files/network_file.hpp"
#include "dem/files/state_file.hpp"

namespace isostat {
namespace {

constexpr std::size_t kLargest = 4000;  // [bytes] of a shipped file

std::vector<std::string> files(const std::string& folder, const std::string& extension) {
  std::vector<std::string> paths, all;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == extension && entry.file_size() < kLargest) paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());  // a directory has no order
  for (const std::string& path : paths) all.push_back(read_whole_file(path));
  return all;
}

std::vector<Packing<2>> clusters(const std::string& data) {  // what any format can hold: no beams
  std::vector<Packing<2>> all;
  for (const std::string& text : network_seeds(data)) all.push_back(parse_network<2>(text, "cluster").packing);
  std::erase_if(all, [](const Packing<2>& p) { return !p.beams.empty(); });
  return all;
}

}  // namespace

std::vector<std::string> scene_seeds(const std::string& data) { return files(data + "/scenes", ".toml"); }
std::vector<std::string> network_seeds(const std::string& data) { return files(data + "/clusters", ".net"); }

std::vector<std::string> state_seeds(const std::string& data) {
  std::vector<std::string> all;
  for (const Packing<2>& packing : clusters(data)) {
    State<Disks> state;
    state.packing = packing;
    state.scene.stages.resize(1);
    const std::size_t n = state.packing.bodies.size();
    state.memory.half_velocity.resize(n), state.memory.half_spin.resize(n);
    state.memory.pairs.resize(1);
    state.memory.pairs[0].j = 1;
    all.push_back(encode_state(state));
  }
  return all;
}

std::vector<std::string> packing_seeds(const std::string& data) {
  const std::string division = "\n%\n";
  std::vector<std::string> all = network_seeds(data);
  for (const Packing<2>& p : clusters(data)) {
    if (!p.cell) all.push_back(grains_csv(p) + division + contacts_csv(p));  // the cell would be an option
    all.push_back(grains_dump(p, 0) + division + links_dump(p, 0));
    all.push_back(grains_dump(p, 0));
  }
  return all;
}

}  // namespace isostat
