// G, K and M of a packing, and its modes, as Matrix Market files for linear algebra elsewhere; docs/rigidity.md says
// what the rows and columns are.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "analysis/input.hpp"

namespace isostat {

// Names and contents: G.mtx, K.mtx (lower triangle) and M.mtx, rows.csv and columns.csv, with_modes also modes.mtx (a
// dense column each). G has rows in which stiffness is diagonal, so that K = G^T k G with the k of rows.csv. Throws as
// the sections `stiffness` and `modes` do; the input is one that `stiffness` takes.
std::vector<std::pair<std::string, std::string>> matrix_files(const AnalysisInput& input,
                                                              const AnalysisOptions& options, bool with_modes);

}  // namespace isostat
