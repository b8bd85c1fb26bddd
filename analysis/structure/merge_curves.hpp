// Curves of samples of different size made comparable before analysis/ensemble.cpp averages them entry by entry.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace isostat {

// Section::align of "scattering" and "dacf". Bins share their edges from the high end (k_max), smaller cells lack the
// lowest; distances share their steps from 0, smaller cells end earlier. What a sample lacks becomes null (modes 0).
// False, with the sections untouched, if they do not line up (different k_max or grain size).
bool align_scattering(std::vector<nlohmann::ordered_json>& sections);
bool align_dacf(std::vector<nlohmann::ordered_json>& sections);

// The curve of all modes of all samples together, with its fit of Eq. 28; errors by bootstrap over samples.
nlohmann::ordered_json pooled_scattering(const std::vector<nlohmann::ordered_json>& aligned);

// The mean of C - Phi^2, each sample by the area of its cell, with its fit of Eq. 27; errors by bootstrap.
nlohmann::ordered_json pooled_dacf(const std::vector<nlohmann::ordered_json>& aligned);

}  // namespace isostat
