// Which colour and width a link gets, and which disks are grey: Gilabert 2007, Fig. 2, and with a threshold Figs. 11,
// 12 and 19-22.
#pragma once
#include <optional>
#include <vector>

#include "analysis/network/force_measure.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

struct ForceConvention {
  ForceMeasure width = ForceMeasure::normal;  // what line width is proportional to
  std::optional<double> threshold;            // [force of the packing] links with |F| below it are blue
};

enum class LinkColor {
  compressive,  // red, N >= 0
  tensile,      // green, N < 0
  distant       // blue: not in contact; with a threshold instead: |F| below it
};
template <int D>
LinkColor link_color(const Link<D>& link, const ForceConvention& convention);

template <int D>
double total_force(const Link<D>& link);
template <int D>
double drawn_force(const Link<D>& link, const ForceConvention& convention);  // what the width shows

enum class DiskShade {
  plain,
  rattler,    // carries no force (given by the caller)
  unstressed  // with a threshold: no link of the disk reaches it
};
// One a body. `rattler` has one entry a body, or none at all.
template <int D>
std::vector<DiskShade> disk_shades(const Packing<D>& packing, const ForceConvention& convention,
                                   const std::vector<bool>& rattler);

}  // namespace isostat
