// The units of the keys of a report, for people: the JSON has them once, in `units`.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace isostat {

// Of a key such as "stress.tensor" or "equilibrium.tolerance.force", with the words of a report's `units`: "F0/a".
// Empty for a pure number, and for an input in units that nobody knows.
std::string unit_of(std::string_view key, const nlohmann::ordered_json& units);

}  // namespace isostat
