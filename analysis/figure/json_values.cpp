#include "analysis/figure/json_values.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/figure/nice_numbers.hpp"
#include "dem/input_error.hpp"

namespace isostat {

namespace {

using Json = nlohmann::json;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void refuse_plot(const std::string& path, const std::string& key, const std::string& why) {
  throw InputError(path, 0, key, "", why);
}

const Json* find(const Json& json, std::initializer_list<const char*> keys) {
  const Json* at = &json;
  for (const char* key : keys) {
    if (!at->is_object() || !at->contains(key)) return nullptr;
    at = &(*at)[key];
  }
  return at;
}

Value value_of(const Json* json) {
  if (!json) return {};
  if (json->is_number()) return {json->get<double>(), kNaN};
  if (json->is_object()) return {value_of(find(*json, {"mean"})).mean, value_of(find(*json, {"se"})).mean};
  return {};
}

Values values_of(const Json* json) {
  Values values;
  if (!json || !json->is_array()) return values;
  for (const Json& entry : *json) {
    const Value v = value_of(&entry);
    values.mean.push_back(v.mean), values.error.push_back(v.error);
  }
  return values;
}

RichText force_unit(const Json& result) {
  const Json* force = find(result, {"units", "force"});
  if (!force || !force->is_string()) return {};
  return *force == "F0" ? rich("`F`_{0}") : *force == "a P" ? rich("`aP`") : plain(force->get<std::string>());
}
RichText over(const RichText& quantity, const RichText& unit) {
  return unit.empty() ? quantity : quantity + plain(" / ") + unit;
}

bool is_histogram(const Json* h) {
  const Json *edges = h ? find(*h, {"edges"}) : nullptr, *density = h ? find(*h, {"density"}) : nullptr;
  return edges && density && edges->is_array() && density->is_array() && !density->empty() &&
         edges->size() == density->size() + 1;
}

Curve steps(const Json& histogram) {
  Curve curve;
  curve.style = CurveStyle::steps;
  curve.x = values_of(find(histogram, {"edges"})).mean;
  const Values density = values_of(find(histogram, {"density"}));
  curve.y = density.mean, curve.error = density.error;
  return curve;
}

Curve trimmed(Curve curve) {
  const auto filled = [](double d) { return d > 0; };
  const auto first = std::find_if(curve.y.begin(), curve.y.end(), filled) - curve.y.begin();
  const auto after = curve.y.rend() - std::find_if(curve.y.rbegin(), curve.y.rend(), filled);
  if (first >= after) return curve;
  curve.x = std::vector<double>(curve.x.begin() + first, curve.x.begin() + after + 1);
  curve.y = std::vector<double>(curve.y.begin() + first, curve.y.begin() + after);
  if (!curve.error.empty()) curve.error = std::vector<double>(curve.error.begin() + first, curve.error.begin() + after);
  return curve;
}

std::optional<std::string> untold(const Json* fit) {
  const Json* told = fit ? find(*fit, {"identifiable"}) : nullptr;
  if (!told || *told != false) return std::nullopt;
  const Json* message = find(*fit, {"message"});
  return message && message->is_string() ? message->get<std::string>() : std::string("no reason given");
}

std::vector<double> log_steps(double low, double high) {
  constexpr int kPoints = 200;
  std::vector<double> steps;
  for (int p = 0; p <= kPoints; ++p) steps.push_back(low * std::pow(high / low, static_cast<double>(p) / kPoints));
  return steps;
}

Curve number_above(const std::vector<double>& sorted) {
  Curve curve;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double before = static_cast<double>(sorted.size() - i), after = before - 1;
    curve.x.insert(curve.x.end(), {sorted[i], sorted[i]});
    curve.y.insert(curve.y.end(), {before, after});
  }
  return curve;
}

void add_size_law(Chart& chart, const Json* law, const std::vector<double>& sorted, const RichText& size) {
  if (!law) return;
  if (const auto why = untold(law)) {
    chart.notes.push_back(plain("size law not identifiable: " + *why));
    return;
  }
  const Value tau = value_of(find(*law, {"exponent"}));
  const double from = value_of(find(*law, {"from"})).mean, end = value_of(find(*law, {"to"})).mean;
  if (!std::isfinite(tau.mean) || !std::isfinite(from) || sorted.empty() || tau.mean == 1) return;
  const double to = std::isfinite(end) ? std::min(end, sorted.back()) : sorted.back();
  const auto above = [&](double x) {
    return static_cast<double>(sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), x));
  };
  const double e = 1 - tau.mean, beyond = std::isfinite(end) ? above(end) : 0, inside = above(from) - beyond;
  const double low = std::pow(from, e), high = std::isfinite(end) ? std::pow(end, e) : tau.mean > 1 ? 0 : INFINITY;
  if (!(to > from) || !std::isfinite(high)) return;
  Curve curve;
  curve.color = curve_color(1);
  curve.label = rich("density ~ ") + size + rich("^{-τ}");
  for (const double x : log_steps(from, to))
    if (const double n = beyond + inside * (std::pow(x, e) - high) / (low - high); n > 0)
      curve.x.push_back(x), curve.y.push_back(n);
  if (curve.x.size() > 1) chart.curves.push_back(std::move(curve));
  const double error = std::isfinite(tau.error) ? tau.error : value_of(find(*law, {"exponent_error"})).mean;
  chart.notes.push_back(rich("τ = ") + number_text_with_error(tau.mean, error));
}

}  // namespace isostat
