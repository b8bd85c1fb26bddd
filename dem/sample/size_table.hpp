// A measured distribution of sizes, as a CSV file with a header: `diameter` in any one unit, ascending, and either
//   share     the part of the grains that have this diameter; all of them are 1 together, or
//   passing   the part that is smaller, as of sieves: from 0 to 1, sizes being spread evenly between two rows.
// An optional column `density` is that of the grains of this row (with `passing`: of those up to the row's diameter)
// over that of other grains.
#pragma once
#include <string>
#include <vector>

#include "dem/sample/grain_sizes.hpp"

namespace isostat {

// Shares by number, diameters scaled so that the largest is `largest`. Throws InputError with the faults and lines.
std::vector<SizeClass> read_size_table(const std::string& path, ShareOf share_of, int dimension, double largest);

}  // namespace isostat
