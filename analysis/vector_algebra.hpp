// The few operations on plain vectors of numbers that are wanted in more than one place.
#pragma once
#include <cmath>
#include <numeric>
#include <vector>

namespace isostat {

inline double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

// Largest |x|; NaN if one is NaN.
inline double largest(const std::vector<double>& v) {
  double m = 0;
  for (double x : v) m = std::isnan(x) || std::abs(x) > m ? std::abs(x) : m;
  return m;
}

}  // namespace isostat
