// Why a link can bear a force that nothing outside asks for.
#pragma once
#include <cstdint>
#include <vector>

#include "analysis/input.hpp"

namespace isostat {

enum class LinkClass : std::uint8_t {
  tree,    // it lies on no closed loop: it cannot
  loop,    // by moments alone, that is with rolling resistance
  cluster  // by forces alone: the links without their moments have a self-stress that passes here
};

// By link of a network of disks. law: rolling rows are left out of the third class, other laws stay as they are. Throws
// FactorisationFailed.
std::vector<LinkClass> link_classes(const LinkNetwork& network, NetworkLaw law, bool cell_free);

}  // namespace isostat
