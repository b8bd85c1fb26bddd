#include "dem/scene/suggestion.hpp"

#include <algorithm>

namespace isostat {
namespace {

// Optimal string alignment distance, by the full table: names are short.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

std::string_view last_component(std::string_view name) { return name.substr(name.rfind('.') + 1); }

constexpr std::size_t kLongestName = 200;  // longer ones are no misspelling, and the table is quadratic

}  // namespace

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  if (name.size() > kLongestName) return {};
  const std::size_t near = std::max<std::size_t>(2, name.size() / 4);
  std::size_t best = near + 1;
  std::string nearest;
  for (const std::string& candidate : candidates)
    if (const std::size_t distance = edit_distance(name, candidate); distance < best) {
      best = distance;
      nearest = candidate;
    }
  if (!nearest.empty()) return nearest;
  for (const std::string& candidate : candidates)
    if (name.size() > 2 && candidate.starts_with(name)) return candidate;
  for (const std::string& candidate : candidates)
    if (last_component(candidate) == last_component(name)) return candidate;
  return {};
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? std::string{} : "did you mean " + nearest + "?";
}

}  // namespace isostat
