#include "analysis/figure/force_convention.hpp"

#include <cmath>

namespace isostat {

double total_force(const Link<2>& link) { return std::hypot(link.normal_force, link.tangential_force); }

double drawn_force(const Link<2>& link, const ForceConvention& convention) {
  return convention.width == ForceMeasure::total ? total_force(link) : std::abs(link.normal_force);
}

LinkColor link_color(const Link<2>& link, const ForceConvention& convention) {
  const bool blue = convention.threshold ? total_force(link) < *convention.threshold : link.kind == LinkKind::distant;
  if (blue) return LinkColor::distant;
  return link.normal_force < 0 ? LinkColor::tensile : LinkColor::compressive;
}

std::vector<DiskShade> disk_shades(const Packing<2>& packing, const ForceConvention& convention,
                                   const std::vector<bool>& rattler) {
  std::vector<DiskShade> shade(packing.bodies.size(), DiskShade::plain);
  if (!convention.threshold) {
    for (std::size_t i = 0; i < rattler.size(); ++i)
      if (rattler[i]) shade[i] = DiskShade::rattler;
    return shade;
  }
  for (std::size_t i = 0; i < shade.size(); ++i)
    if (is_free(packing.part, i)) shade[i] = DiskShade::unstressed;
  for (const Link<2>& link : packing.links)
    if (total_force(link) >= *convention.threshold)
      for (const auto i : {link.i, link.j}) shade[static_cast<std::size_t>(i)] = DiskShade::plain;
  return shade;
}

}  // namespace isostat
