#include "analysis/structure/merge_curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/structure/bootstrap.hpp"
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

// A window that all samples have.
void narrow(std::array<double, 2>& window, const std::array<double, 2>& other) {
  window = {std::max(window[0], other[0]), std::min(window[1], other[1])};
}

struct Sample {
  std::vector<double> c;  // C(r); NaN beyond the end of a small cell
  double solid_fraction, area;
};

// Mean of C - Phi^2 of the samples drawn, each by the area of its cell and about its own Phi, as far as all have it.
Excess mean_excess(const std::vector<double>& r, const std::vector<Sample>& samples,
                   const std::vector<std::size_t>& drawn) {
  Excess mean;
  for (std::size_t n = 0; n < r.size(); ++n) {
    double sum = 0, area = 0;
    for (const std::size_t d : drawn) {
      const Sample& s = samples[d];
      sum += s.area * (s.c[n] - s.solid_fraction * s.solid_fraction), area += s.area;
    }
    if (!std::isfinite(sum)) break;
    mean.r.push_back(r[n]), mean.value.push_back(sum / area);
  }
  return mean;
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
  ScatteringFits fits = scattering_fits(aligned.front());
  for (const auto& s : aligned) {
    curves.push_back({numbers(aligned.front()["k_edges"]), numbers(s["k"]), numbers(s["I"]), numbers(s["sigma"]),
                      s["modes"].get<std::vector<std::int64_t>>()});
    narrow(fits.window, scattering_fits(s).window), narrow(fits.power_window, scattering_fits(s).power_window);
  }
  const auto pooled = pooled_intensity(curves);
  const FractalFit fit = fit_curve(pooled, fits.window[0], fits.window[1], fits.constant);
  Json json = scattering_json(pooled, fit, fits);
  add_bootstrap(json["fit"], fit, curves.size(), [&](const std::vector<std::size_t>& drawn) {
    std::vector<IntensityCurve> again;
    for (const std::size_t d : drawn) again.push_back(curves[d]);
    return refit_curve(pooled_intensity(again), fits.window[0], fits.window[1], fits.constant, fit);
  });
  return json;
}

Json pooled_dacf(const std::vector<Json>& aligned) {
  ExcessFits fits = excess_fits(aligned.front());
  std::vector<Sample> samples;
  for (const Json& s : aligned) {
    samples.push_back({numbers(s["C"]), s["solid_fraction"].get<double>(), s["cell_area"].get<double>()});
    narrow(fits.window, excess_fits(s).window);
  }
  const std::vector<double> r = numbers(aligned.front()["r"]);
  std::vector<std::size_t> each(samples.size());
  for (std::size_t k = 0; k < each.size(); ++k) each[k] = k;
  const Excess excess = mean_excess(r, samples, each), in = excess_in(excess, fits.window, fits.to_first_zero);
  const FractalFit fit = fit_correlation(in.r, in.value);
  Json json;
  json["r"] = excess.r, json["excess"] = excess.value;
  json["fit"] = excess_fit_json(fit, fits);
  if (fits.scan) json["windows"] = excess_windows(excess, fits);
  add_bootstrap(json["fit"], fit, samples.size(), [&](const std::vector<std::size_t>& drawn) {
    const Excess again = excess_in(mean_excess(r, samples, drawn), fits.window, fits.to_first_zero);
    return refit_correlation(again.r, again.value, fit);
  });
  return json;
}

}  // namespace isostat
