#include "dem/state/packing.hpp"

namespace isostat {

std::optional<LinkKind> link_kind_from_letters(std::string_view name) {
  for (auto kind :
       {LinkKind::closed, LinkKind::sliding, LinkKind::rolling_yielded, LinkKind::both_yielded, LinkKind::distant})
    if (letters(kind) == name) return kind;
  return std::nullopt;
}

}  // namespace isostat
