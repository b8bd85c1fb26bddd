// C(r) without a transform: the union of the disks and of the disks moved by r has the area (2 Phi - C(r)) A. The mean
// over directions by the trapezoidal rule.
#pragma once
#include "tests/support/disk_packings.hpp"

namespace isostat::oracle {

double exact_correlation(const Disks& disks, double r, int directions);

}  // namespace isostat::oracle
