#include "analysis/network/size_law.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "analysis/network/histogram.hpp"

namespace isostat {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kSteepest = 50;  // rate of a law over whole numbers
constexpr double kVerdict = 2;    // [sd] by which a ratio of likelihoods decides

// A member of the family p(t) ~ exp(-rate t) on a given set of t, found from the mean of t: its maximum of likelihood.
struct Member {
  double rate = 0, error = 0;  // error by the Fisher information, count times the variance of t
  double log_norm = 0;         // ln of the sum or integral of exp(-rate t)
};

// ln of int_0^1 exp(-s u) du, mean and variance of u.
struct Unit {
  double log_norm, mean, variance;
};
Unit unit(double s) {
  if (std::abs(s) < 1e-3) return {-s / 2 + s * s / 24, 0.5 - s / 12, 1.0 / 12 - s * s / 240};
  const double half = 2 * std::sinh(s / 2);
  return {s > 0 ? std::log(-std::expm1(-s) / s) : -s + std::log(std::expm1(s) / s), 1 / s - 1 / std::expm1(s),
          1 / (s * s) - 1 / (half * half)};
}

// t in [low, high); high may be infinite.
Member of_interval(double mean, long count, double low, double high) {
  const auto n = static_cast<double>(count);
  if (std::isinf(high)) {
    const double rate = 1 / (mean - low);
    return {rate, rate / std::sqrt(n), -rate * low - std::log(rate)};
  }
  const double width = high - low, u = (mean - low) / width;
  double lower = -700, upper = 700;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (lower + upper);
    (unit(middle).mean > u ? lower : upper) = middle;
  }
  const double s = 0.5 * (lower + upper);
  const Unit at = unit(s);
  return {s / width, 1 / (width * std::sqrt(n * at.variance)), std::log(width) - s / width * low + at.log_norm};
}

// t(n) of the whole numbers n = from..to.
Member of_set(double mean, long count, const std::vector<double>& t) {
  struct Moments {
    double log_norm, mean, variance;
  };
  const auto moments = [&](double rate) {
    double top = -std::numeric_limits<double>::infinity(), sum = 0, first = 0, second = 0;
    for (const double x : t) top = std::max(top, -rate * x);
    for (const double x : t) {
      const double w = std::exp(-rate * x - top);
      sum += w, first += w * x, second += w * x * x;
    }
    first /= sum, second /= sum;
    return Moments{top + std::log(sum), first, second - first * first};
  };
  double lower = -kSteepest, upper = kSteepest;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (lower + upper);
    (moments(middle).mean > mean ? lower : upper) = middle;
  }
  const double rate = 0.5 * (lower + upper);
  const Moments at = moments(rate);
  return {rate, 1 / std::sqrt(static_cast<double>(count) * at.variance), at.log_norm};
}

// ln p of the power law minus ln p of the exponential, of each size.
void judge(SizeLawFit& law, const std::vector<double>& sizes, const std::function<double(double)>& log_ratio) {
  double sum = 0, squares = 0;
  const auto n = static_cast<double>(sizes.size());
  for (const double x : sizes) sum += log_ratio(x);
  for (const double x : sizes) squares += (log_ratio(x) - sum / n) * (log_ratio(x) - sum / n);
  law.log_ratio = sum, law.log_ratio_error = std::sqrt(squares);
  if (law.message.empty() && law.log_ratio < -kVerdict * law.log_ratio_error)
    law.message = "no power law: an exponential is significantly more likely";
  law.identifiable = law.message.empty();
}

bool too_few(SizeLawFit& law, std::size_t count) {
  law.count = static_cast<long>(count);
  law.exponent = law.exponent_error = law.scale = law.scale_error = law.log_ratio = law.log_ratio_error = kNaN;
  if (law.count >= kFewestForFit) return false;
  law.message = "fewer than " + std::to_string(kFewestForFit) + " sizes in the window";
  return true;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

void set_scale(SizeLawFit& law, const Member& exponential) {
  law.scale = 1 / exponential.rate, law.scale_error = exponential.error / (exponential.rate * exponential.rate);
}

}  // namespace

SizeLawFit continuous_size_law(const std::vector<double>& sizes, double from, double to) {
  SizeLawFit law;
  law.from = from, law.to = to;
  std::vector<double> in, logs;
  for (const double x : sizes)
    if (x >= from && x < to) in.push_back(x), logs.push_back(std::log(x));
  if (too_few(law, in.size())) return law;
  // Of u = ln x the density is exp(-(tau - 1) u): one power of x more.
  const Member power = of_interval(mean_of(logs), law.count, std::log(from), std::log(to));
  const Member exponential = of_interval(mean_of(in), law.count, from, to);
  law.exponent = power.rate + 1, law.exponent_error = power.error;
  set_scale(law, exponential);
  judge(law, in, [&](double x) {
    return -(power.rate + 1) * std::log(x) - power.log_norm + exponential.rate * x + exponential.log_norm;
  });
  return law;
}

SizeLawFit discrete_size_law(const std::vector<std::int64_t>& sizes, std::int64_t from, std::int64_t to) {
  SizeLawFit law;
  law.from = static_cast<double>(from), law.to = static_cast<double>(to);
  std::vector<double> in, logs, all, all_logs;
  for (const std::int64_t n : sizes)
    if (n >= from && n <= to) in.push_back(static_cast<double>(n)), logs.push_back(std::log(static_cast<double>(n)));
  if (too_few(law, in.size())) return law;
  for (std::int64_t n = from; n <= to; ++n)
    all.push_back(static_cast<double>(n)), all_logs.push_back(std::log(static_cast<double>(n)));
  const Member power = of_set(mean_of(logs), law.count, all_logs), exponential = of_set(mean_of(in), law.count, all);
  law.exponent = power.rate, law.exponent_error = power.error;
  set_scale(law, exponential);
  if (!(std::abs(power.rate) < 0.99 * kSteepest)) law.message = "all sizes at one end: no exponent";
  judge(law, in, [&](double n) {
    return -power.rate * std::log(n) - power.log_norm + exponential.rate * n + exponential.log_norm;
  });
  return law;
}

nlohmann::ordered_json size_law_json(const SizeLawFit& law) {
  const auto number = [](double v) { return std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(); };
  return {{"from", law.from},
          {"to", number(law.to)},
          {"count", law.count},
          {"exponent", number(law.exponent)},
          {"exponent_error", number(law.exponent_error)},
          {"scale", number(law.scale)},
          {"scale_error", number(law.scale_error)},
          {"log_ratio", number(law.log_ratio)},
          {"log_ratio_error", number(law.log_ratio_error)},
          {"identifiable", law.identifiable},
          {"message", law.message}};
}

}  // namespace isostat
