// write_seeds DATA DIRECTORY: the seeds of each fuzzer as files, in DIRECTORY/scene, /network, /packing and /state.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "dem/files/atomic_file.hpp"
#include "tests/fuzz/seeds.hpp"

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: write_seeds DATA DIRECTORY\n");
    return 2;
  }
  const std::string data = argv[1], directory = argv[2];
  const auto write = [&](const std::string& name, const std::vector<std::string>& seeds) {
    std::filesystem::create_directories(directory + "/" + name);
    for (std::size_t k = 0; k < seeds.size(); ++k)
      isostat::write_file_atomically(directory + "/" + name + "/" + std::to_string(k), seeds[k]);
  };
  write("scene", isostat::scene_seeds(data));
  write("network", isostat::network_seeds(data));
  write("packing", isostat::packing_seeds(data));
  write("state", isostat::state_seeds(data));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "write_seeds: %s\n", error.what());
  return 1;
}
