#include "analysis/figure/force_convention.hpp"

#include <cmath>

namespace isostat {

template <>
double total_force(const Link<2>& link) {
  return std::hypot(link.normal_force, link.tangential_force);
}
template <>
double total_force(const Link<3>& link) {
  return std::hypot(link.normal_force, norm(link.tangential_force));
}

template <int D>
double drawn_force(const Link<D>& link, const ForceConvention& convention) {
  return convention.width == ForceMeasure::total ? total_force(link) : std::abs(link.normal_force);
}

template <int D>
LinkColor link_color(const Link<D>& link, const ForceConvention& convention) {
  const bool blue = convention.threshold ? total_force(link) < *convention.threshold : link.kind == LinkKind::distant;
  if (blue) return LinkColor::distant;
  return link.normal_force < 0 ? LinkColor::tensile : LinkColor::compressive;
}

template <int D>
std::vector<DiskShade> disk_shades(const Packing<D>& packing, const ForceConvention& convention,
                                   const std::vector<bool>& rattler) {
  std::vector<DiskShade> shade(packing.bodies.size(), DiskShade::plain);
  if (!convention.threshold) {
    for (std::size_t i = 0; i < rattler.size(); ++i)
      if (rattler[i]) shade[i] = DiskShade::rattler;
    return shade;
  }
  for (std::size_t i = 0; i < shade.size(); ++i)
    if (is_free(packing.part, i)) shade[i] = DiskShade::unstressed;
  for (const Link<D>& link : packing.links)
    if (total_force(link) >= *convention.threshold)
      for (const auto i : {link.i, link.j}) shade[static_cast<std::size_t>(i)] = DiskShade::plain;
  return shade;
}

template double drawn_force(const Link<2>&, const ForceConvention&);
template double drawn_force(const Link<3>&, const ForceConvention&);
template LinkColor link_color(const Link<2>&, const ForceConvention&);
template LinkColor link_color(const Link<3>&, const ForceConvention&);
template std::vector<DiskShade> disk_shades(const Packing<2>&, const ForceConvention&, const std::vector<bool>&);
template std::vector<DiskShade> disk_shades(const Packing<3>&, const ForceConvention&, const std::vector<bool>&);

}  // namespace isostat
