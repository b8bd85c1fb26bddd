#include "analysis/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;
using Values = std::vector<const Json*>;  // one an input; null pointer: absent there

Json merge(const std::string& key, const Values& values);

bool all_of(const Values& values, bool (*is)(const Json&)) {
  return std::all_of(values.begin(), values.end(), [is](const Json* v) { return v && is(*v); });
}
bool all_equal(const Values& values) {
  return std::all_of(values.begin(), values.end(), [&](const Json* v) { return v && *v == *values.front(); });
}
Values defined(const Values& values) {
  Values some;
  for (const Json* v : values)
    if (v && !v->is_null()) some.push_back(v);
  return some;
}

Json one_per_input(const Values& values) {
  Json list = Json::array();
  for (const Json* v : values) list.push_back(v ? *v : Json());
  return list;
}

Json statistics(const std::vector<double>& sample, std::size_t inputs) {
  const auto n = static_cast<double>(sample.size());
  double mean = 0, squares = 0;
  for (const double v : sample) mean += v / n;
  for (const double v : sample) squares += (v - mean) * (v - mean);
  const double sd = std::sqrt(squares / (n - 1));  // NaN, written as null, for one
  Json json{{"mean", mean}, {"sd", sd}, {"se", sd / std::sqrt(n)}};
  if (sample.size() != inputs) json["n"] = sample.size();
  return json;
}

Json merge_numbers(const Values& values) {
  std::vector<double> sample;
  for (const Json* v : defined(values)) sample.push_back(v->is_boolean() ? double(v->get<bool>()) : v->get<double>());
  return statistics(sample, values.size());
}

// A quantity with a standard error beside it, in a fit that is not identifiable: no result, and so no part of a mean.
bool is_untold(const Json& fit, const std::string& key) {
  if (!fit.contains("identifiable") || fit["identifiable"] != false) return false;
  return key.ends_with("_error") || key == "correlation" || fit.contains(key + "_error");
}

Json merge_objects(const Values& values) {
  static const Json untold;
  std::vector<std::string> keys;
  for (const Json* v : defined(values))
    for (const auto& [k, unused] : v->items())
      if (std::find(keys.begin(), keys.end(), k) == keys.end()) keys.push_back(k);
  Json json = Json::object();
  for (const std::string& k : keys) {
    Values members;
    for (const Json* v : values)
      members.push_back(!v || !v->is_object() || !v->contains(k) ? nullptr : is_untold(*v, k) ? &untold : &v->at(k));
    json[k] = merge(k, members);
  }
  return json;
}

// Positions of a histogram's bins on a common lattice of bins k w .. (k + 1) w.
struct Lattice {
  double width = 0;
  long first = 0, last = -1;  // bins
};
std::optional<Lattice> lattice_of(const Json& edges) {
  if (!edges.is_array() || edges.size() < 2 || !edges.front().is_number()) return std::nullopt;
  const auto bins = static_cast<double>(edges.size() - 1);
  const double width = (edges.back().get<double>() - edges.front().get<double>()) / bins;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const double off = edges[k].get<double>() / width - std::round(edges.front().get<double>() / width) - double(k);
    if (!(std::abs(off) < 1e-6)) return std::nullopt;  // other bins than k w
  }
  const long first = std::lround(edges.front().get<double>() / width);
  return Lattice{width, first, first + static_cast<long>(bins) - 1};
}
// Smallest lattice that covers all, if they share their width.
std::optional<Lattice> common_lattice(const std::vector<const Json*>& edges) {
  std::optional<Lattice> common;
  for (const Json* e : edges) {
    const auto l = lattice_of(*e);
    if (!l || (common && std::abs(l->width - common->width) > 1e-9 * common->width)) return std::nullopt;
    if (!common) common = l;
    common->first = std::min(common->first, l->first);
    common->last = std::max(common->last, l->last);
  }
  return common;
}
Json edges_of(const Lattice& l) {
  Json edges = Json::array();
  for (long k = l.first; k <= l.last + 1; ++k) edges.push_back(double(k) * l.width);
  return edges;
}
// What a histogram says of its bins, with `empty` in those of `to` that it lacks.
Json padded(const Json& density, const Json& edges, const Lattice& to, const Json& empty) {
  const Lattice from = *lattice_of(edges);
  Json out = Json::array();
  for (long k = to.first; k <= to.last; ++k)
    out.push_back(k < from.first || k > from.last ? empty : density.at(static_cast<std::size_t>(k - from.first)));
  return out;
}

// Further numbers of each bin (an error, a count): undefined where a sample has no bin.
void merge_columns(Json& merged, const Values& histograms) {
  const auto common = lattice_of(merged["edges"]);
  for (const auto& [key, unused] : histograms.front()->items()) {
    if (key == "edges" || key == "density") continue;
    std::vector<Json> columns;
    for (const Json* h : histograms)
      if (h->contains(key) && h->at(key).size() + 1 == h->at("edges").size())
        columns.push_back(common ? padded(h->at(key), h->at("edges"), *common, Json()) : h->at(key));
    if (columns.size() != histograms.size()) continue;
    Values values;
    for (const Json& c : columns) values.push_back(&c);
    merged[key] = merge(key, values);
  }
}

// {"edges", "density"} in one variable or in two (edges a pair, density[x][y]); none if the bins cannot be aligned.
std::optional<Json> merge_histograms(const Values& values) {
  const Values some = defined(values);
  const bool planar = some.front()->at("edges").size() == 2 && some.front()->at("edges").at(0).is_array();
  std::vector<Values> edges(planar ? 2 : 1);
  for (const Json* v : some)
    for (std::size_t a = 0; a < edges.size(); ++a) edges[a].push_back(planar ? &v->at("edges").at(a) : &v->at("edges"));
  std::vector<Json> aligned;
  Json common_edges;
  if (std::all_of(edges.begin(), edges.end(), all_equal)) {
    for (const Json* v : some) aligned.push_back(v->at("density"));
    common_edges = some.front()->at("edges");
  } else {
    std::vector<Lattice> lattices;
    for (const Values& e : edges) {
      const auto l = common_lattice(e);
      if (!l) return std::nullopt;
      lattices.push_back(*l);
    }
    for (std::size_t n = 0; n < some.size(); ++n) {
      Json density = some[n]->at("density"), empty = 0.0;
      if (planar) {
        for (Json& row : density) row = padded(row, *edges[1][n], lattices[1], 0.0);
        empty = Json(std::vector<double>(static_cast<std::size_t>(lattices[1].last - lattices[1].first + 1), 0.0));
      }
      aligned.push_back(padded(density, *edges[0][n], lattices[0], empty));
    }
    common_edges = planar ? Json::array({edges_of(lattices[0]), edges_of(lattices[1])}) : edges_of(lattices[0]);
  }
  Values densities;
  for (const Json& d : aligned) densities.push_back(&d);
  Json merged{{"edges", common_edges}, {"density", merge("density", densities)}};
  if (!planar) merge_columns(merged, some);
  return merged;
}

Json merge_arrays(const std::string& key, const Values& values) {
  if (key == "one_coordinated") return one_per_input(values);
  std::vector<Json> arrays;
  std::size_t longest = 0;
  for (const Json* v : values) arrays.push_back(*v), longest = std::max(longest, v->size());
  for (Json& a : arrays)
    while (key == "x" && a.size() < longest) a.push_back(0.0);
  for (const Json& a : arrays)
    if (a.size() != longest || (!a.empty() && a.front().is_object())) return one_per_input(values);
  Json json = Json::array();
  for (std::size_t k = 0; k < longest; ++k) {
    Values entries;
    for (const Json& a : arrays) entries.push_back(&a.at(k));
    json.push_back(merge("", entries));
  }
  return json;
}

Json merge(const std::string& key, const Values& values) {
  const Values some = defined(values);
  if (some.empty()) return Json();
  if (key.ends_with("edges") && all_equal(values)) return *some.front();
  if (all_of(some, [](const Json& v) { return v.is_boolean(); }) && all_equal(some)) return *some.front();
  if (all_of(some, [](const Json& v) { return v.is_number() || v.is_boolean(); })) return merge_numbers(values);
  if (all_of(some, [](const Json& v) { return v.is_string(); }))
    return all_equal(values) ? *some.front() : one_per_input(values);
  if (all_of(some, [](const Json& v) { return v.is_object() && v.contains("edges") && v.contains("density"); })) {
    if (auto merged = merge_histograms(values)) return *merged;
    return one_per_input(values);
  }
  if (all_of(some, [](const Json& v) { return v.is_object(); })) return merge_objects(values);
  if (all_of(values, [](const Json& v) { return v.is_array(); })) return merge_arrays(key, values);
  return one_per_input(values);
}

// A section whose values have to be aligned, over the inputs that have it; none: it is merged like any object.
std::optional<Json> merge_aligned(const Section& section, const Values& values) {
  if (!section.align) return std::nullopt;
  std::vector<Json> parts;
  for (const Json* v : defined(values)) parts.push_back(*v);
  if (parts.empty() || !section.align(parts)) return std::nullopt;
  Values aligned;
  for (const Json& p : parts) aligned.push_back(&p);
  Json merged = merge_objects(aligned);
  if (section.pooled) merged["pooled"] = section.pooled(parts);
  return merged;
}

}  // namespace

nlohmann::ordered_json merge_reports(const std::vector<nlohmann::ordered_json>& reports) {
  if (reports.size() == 1) return reports.front();
  Values values;
  Json inputs = Json::array();
  for (const Json& r : reports) {
    values.push_back(&r);
    for (const Json& path : r.at("inputs")) inputs.push_back(path);
  }
  Json json = merge_objects(values);
  json["inputs"] = inputs;
  json.erase("warnings");
  for (const Json& r : reports)
    for (const Json& warning : r.value("warnings", Json::array())) json["warnings"].push_back(warning);
  for (const Section& section : sections()) {
    const std::string name(section.name);
    if (!json.contains(name)) continue;
    Values parts;
    for (const Json& r : reports) parts.push_back(r.contains(name) ? &r.at(name) : nullptr);
    if (auto merged = merge_aligned(section, parts)) json[name] = std::move(*merged);
  }
  if (json.contains("units")) {  // numbers of the unit table are no sample
    Values units;
    for (const Json& r : reports) units.push_back(&r.at("units"));
    json["units"] = all_equal(units) ? *units.front() : one_per_input(units);
  }
  return json;
}

}  // namespace isostat
