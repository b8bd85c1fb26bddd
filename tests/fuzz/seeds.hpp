// What the fuzzers and their tests start from: small shipped files (folder `data` of the repository), and states and
// packings made from the shipped clusters.
#pragma once
#include <string>
#include <vector>

namespace isostat {

std::vector<std::string> scene_seeds(const std::string& data);
std::vector<std::string> network_seeds(const std::string& data);
// Sealed states with a cell motion, a stage and solver memory, so that every part of the format is there.
std::vector<std::string> state_seeds(const std::string& data);
// Grains and contacts as fuzz_packing takes them: networks, CSV, dumps.
std::vector<std::string> packing_seeds(const std::string& data);

}  // namespace isostat
