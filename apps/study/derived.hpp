// What a study computes from the numbers of its samples: derived columns, and slopes over the stages of a path.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/study/expression.hpp"

namespace isostat {

struct DerivedColumn {
  std::string name;
  Expression of;
};

// The slope of the straight line of y against x through the stages of a sample, by least squares.
struct PathSlope {
  std::string name;
  Expression x, y;
  std::vector<std::size_t> stages;
};

// The numbers of one sample after one stage, by the names of their columns.
using SampleNumbers = std::map<std::string, double>;

// Adds the derived ones in their order, each of which may need those before it. Names without a number give NaN.
void add_derived(const std::vector<DerivedColumn>& columns, SampleNumbers& numbers);

// NaN unless two stages at least have both numbers, at different x.
double slope_of(const PathSlope& slope, const std::vector<const SampleNumbers*>& stages);

struct Statistic {
  std::size_t n = 0;
  double mean = 0, sd = 0, se = 0;  // NaN where n is too small
};
Statistic statistic(const std::vector<double>& values);  // of those that are finite

}  // namespace isostat
