// Round numbers for scale bars and ticks, and numbers as text.
#pragma once
#include "analysis/figure/rich_text.hpp"

namespace isostat {

// Largest of 1, 2, 5 times a power of ten that is not above x > 0.
double nice_below(double x);
double nice_above(double x);  // the smallest that is not below

// 0.05, 1200, 3 x 10^{-5}: up to `digits` significant ones, no trailing zeros.
RichText number_text(double x, int digits = 4);

// 1.53 +- 0.04: both to the second significant digit of the error (first from 0.3 of its decade on, as usual in print);
// the plain number where the error is not positive and finite.
RichText number_text_with_error(double x, double error);

}  // namespace isostat
