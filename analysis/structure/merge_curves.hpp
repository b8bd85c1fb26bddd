// Curves of samples of different size made comparable before analysis/ensemble.cpp averages them entry by entry.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace isostat {

// key "scattering": bins share their edges from the high end (k_max), smaller cells lack the lowest; "dacf": distances
// share their steps from 0, smaller cells end earlier. What a sample lacks becomes null (modes 0). Returns false, with
// the sections untouched, if they do not line up (different k_max or grain size) or the key is another.
bool align_curves(const std::string& key, std::vector<nlohmann::ordered_json>& sections);

// "scattering": adds "pooled", the curve of all modes of all samples together with its fit of Eq. 28.
void add_pooled(const std::string& key, const std::vector<nlohmann::ordered_json>& aligned,
                nlohmann::ordered_json& merged);

}  // namespace isostat
