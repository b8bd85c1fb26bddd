// "Did you mean ...?" for misspelt keys, options and commands.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace isostat {

// The candidate nearest to `name` by edit distance (insert, delete, replace, swap of neighbours), or, failing that, one
// that begins with it or has the same last dotted component; empty if none is near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

// "did you mean X?", or empty.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace isostat
