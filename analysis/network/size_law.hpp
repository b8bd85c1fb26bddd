// What law sizes follow above a lower end: a power law, x^-tau, against an exponential, exp(-x/s). Both by maximum
// likelihood, and told apart by the ratio of their likelihoods (Vuong's test, as in Clauset, Shalizi and Newman 2009).
#pragma once
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace isostat {

struct SizeLawFit {
  double from = 0, to = std::numeric_limits<double>::infinity();  // of the sizes used
  long count = 0;
  double exponent = 0, exponent_error = 0;  // tau, and its standard error
  double scale = 0, scale_error = 0;        // s of the exponential; may be negative or infinite in a closed window
  double log_ratio = 0;                     // ln of likelihood of the power law over that of the exponential
  double log_ratio_error = 0;               // what it scatters by, were both equally near to the truth
  bool identifiable = false;  // a power law may be read off: enough sizes, and the exponential is not better
  std::string message;
};

// Sizes in [from, to); below kFewestForFit (histogram.hpp) nothing is fitted. from > 0.
SizeLawFit continuous_size_law(const std::vector<double>& sizes, double from,
                               double to = std::numeric_limits<double>::infinity());
// Whole sizes from..to, both included: tau of n^-tau with the sum over them as normalisation.
SizeLawFit discrete_size_law(const std::vector<std::int64_t>& sizes, std::int64_t from, std::int64_t to);

// {"from", "to", "count", "exponent", "exponent_error", "scale", "scale_error", "log_ratio", "log_ratio_error",
// "identifiable", "message"}; an open end is null.
nlohmann::ordered_json size_law_json(const SizeLawFit& law);

}  // namespace isostat
