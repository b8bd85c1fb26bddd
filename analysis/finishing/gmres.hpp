// Generalised minimal residuals with a preconditioner from the right (Saad and Schultz 1986), one cycle.
#pragma once
#include <functional>
#include <vector>

namespace isostat {

using LinearMap = std::function<std::vector<double>(const std::vector<double>&)>;

struct LinearSolution {
  std::vector<double> x;
  double residual = 1;  // |b - A x| / |b|, Euclidean
  int iterations = 0;
};

// Some x with |b - A x| <= tolerance |b| after at most `most` iterations; fewer digits are reported, not hidden.
LinearSolution gmres(const LinearMap& apply, const LinearMap& precondition, const std::vector<double>& b,
                     double tolerance, int most);

}  // namespace isostat
