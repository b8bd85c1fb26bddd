// A maximal set of independent columns of G, chosen exactly: what makes singular stiffness matrices solvable without a
// threshold. The columns left out number K; with them fixed at zero, Gt W G of the rest is nonsingular.
#pragma once
#include <vector>

#include "analysis/input.hpp"
#include "analysis/sphere_network.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

// By column of G (link_rows.hpp, link_rows_3d.hpp): 1 where it depends on the columns eliminated before it.
std::vector<char> dependent_columns(const LinkNetwork& network, NetworkLaw law, bool cell_free);
std::vector<char> dependent_columns(const SphereNetwork& network, NetworkLaw law, bool cell_free);

}  // namespace isostat
