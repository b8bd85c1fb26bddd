// Histograms as probability densities, with bins anchored so that those of several samples line up.
#pragma once
#include <vector>

namespace isostat {

struct Histogram {
  std::vector<double> edges;    // n + 1, increasing
  std::vector<double> density;  // n, per unit of the variable; sums to 1 with the widths
};

// Bins [k w, (k + 1) w) covering all values; w is doubled until at most kMostBins are needed. No values: no bins.
inline constexpr int kMostBins = 4000;
Histogram anchored_histogram(const std::vector<double>& values, double width);

// Given edges; a value equal to the last edge belongs to the last bin. Normalised by all values, also those outside.
Histogram histogram_over(const std::vector<double>& values, std::vector<double> edges);

// Bins of two variables, as anchored_histogram; density[x][y] per unit of both.
struct Histogram2 {
  std::vector<double> x_edges, y_edges;
  std::vector<std::vector<double>> density;
};
Histogram2 anchored_histogram_2(const std::vector<double>& x, const std::vector<double>& y, double width);

// Maximum-likelihood exponent of p(v) ~ v^-q for the values in [low, high), and its standard error (inverse Fisher
// information). Undefined (NaN) below kFewestForFit values.
struct PowerLaw {
  double exponent, error;
  long count;
};
inline constexpr long kFewestForFit = 20;
PowerLaw fit_power_law(const std::vector<double>& values, double low, double high);

}  // namespace isostat
