// Numbers of a result's JSON as values and curves, shared by the plots of `analyze`.
#pragma once
#include <initializer_list>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/figure/chart.hpp"

namespace isostat {

[[noreturn]] void refuse_plot(const std::string& path, const std::string& key, const std::string& why);

const nlohmann::json* find(const nlohmann::json& json, std::initializer_list<const char*> keys);

// A number, null, or {"mean", "se"} of an ensemble.
struct Value {
  double mean = std::numeric_limits<double>::quiet_NaN(), error = std::numeric_limits<double>::quiet_NaN();
};
Value value_of(const nlohmann::json* json);

struct Values {
  std::vector<double> mean, error;
};
Values values_of(const nlohmann::json* json);

RichText force_unit(const nlohmann::json& result);
RichText over(const RichText& quantity, const RichText& unit);

bool is_histogram(const nlohmann::json* h);
Curve steps(const nlohmann::json& histogram);
Curve trimmed(Curve curve);  // without the empty bins at both ends

// Why a fit is no result; none: it is one, or an ensemble's mean over those that are.
std::optional<std::string> untold(const nlohmann::json* fit);

std::vector<double> log_steps(double low, double high);

// Steps down by one at each of these values, ascending.
Curve number_above(const std::vector<double>& sorted);

// x^-tau between the ends of its window, as the number above x; what is said where it is none.
void add_size_law(Chart& chart, const nlohmann::json* law, const std::vector<double>& sorted, const RichText& size);

}  // namespace isostat
