#include "analysis/structure/merge_curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/structure/fit_json.hpp"
#include "analysis/structure/intensity.hpp"
#include "analysis/structure/scattering_section.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kSame = 1e-12;  // relative difference of two edges or distances that are the same by construction

const Json& longest(const std::vector<Json>& sections, const char* key) {
  return std::max_element(sections.begin(), sections.end(),
                          [&](const Json& a, const Json& b) { return a[key].size() < b[key].size(); })
      ->at(key);
}

bool same(const Json& a, const Json& b) {
  const double x = a.get<double>(), y = b.get<double>();
  return std::abs(x - y) <= kSame * std::abs(y);
}

void pad(Json& array, std::size_t size, bool in_front, const Json& filler) {
  Json padded = Json::array();
  for (std::size_t n = array.size(); in_front && n < size; ++n) padded.push_back(filler);
  for (const auto& v : array) padded.push_back(v);
  while (padded.size() < size) padded.push_back(filler);
  array = std::move(padded);
}

std::vector<double> numbers(const Json& j) {
  std::vector<double> out;
  for (const auto& v : j) out.push_back(v.is_number() ? v.get<double>() : std::numeric_limits<double>::quiet_NaN());
  return out;
}

}  // namespace

bool align_scattering(std::vector<Json>& sections) {
  const Json edges = longest(sections, "k_edges");
  for (const auto& s : sections) {
    const auto offset = edges.size() - s["k_edges"].size();
    for (std::size_t k = 0; k < s["k_edges"].size(); ++k)
      if (!same(s["k_edges"][k], edges[k + offset])) return false;
  }
  for (auto& s : sections) {
    for (const char* key : {"k", "I", "sigma"}) pad(s[key], edges.size() - 1, true, Json());
    pad(s["modes"], edges.size() - 1, true, 0);
    s["k_edges"] = edges;
  }
  return true;
}

bool align_dacf(std::vector<Json>& sections) {
  const Json r = longest(sections, "r");
  for (const auto& s : sections)
    for (std::size_t k = 0; k < s["r"].size(); ++k)
      if (!same(s["r"][k], r[k])) return false;
  for (auto& s : sections) {
    pad(s["C"], r.size(), false, Json());
    for (const char* key : {"M", "local_dimension"}) pad(s["mass_radius"][key], r.size(), false, Json());
    s["r"] = r;
  }
  return true;
}

Json pooled_scattering(const std::vector<Json>& aligned) {
  std::vector<IntensityCurve> curves;
  double limit = std::numeric_limits<double>::infinity();
  for (const auto& s : aligned) {
    curves.push_back({numbers(aligned.front()["k_edges"]), numbers(s["k"]), numbers(s["I"]), numbers(s["sigma"]),
                      s["modes"].get<std::vector<std::int64_t>>()});
    limit = std::min(limit, s["fit"]["k_limit"].get<double>());
  }
  const auto pooled = pooled_intensity(curves);
  return scattering_json(pooled, fit_curve(pooled, 0, limit), limit);
}

}  // namespace isostat
