#include "dem/run/container_series.hpp"

#include <array>
#include <numbers>
#include <string_view>

#include "dem/state/container_region.hpp"
#include "dem/state/density_profile.hpp"
#include "dem/state/inclination.hpp"

namespace isostat {
namespace {

constexpr std::array<std::string_view, 16> kDensityNames{"Phi_01", "Phi_02", "Phi_03", "Phi_04", "Phi_05", "Phi_06",
                                                         "Phi_07", "Phi_08", "Phi_09", "Phi_10", "Phi_11", "Phi_12",
                                                         "Phi_13", "Phi_14", "Phi_15", "Phi_16"};

void add_hopper(std::vector<SeriesColumn>& columns, const ContainerScene& c, const Surroundings& s,
                const Contents& in) {
  columns.push_back({"grains_left", static_cast<double>(s.grains_left)});
  columns.push_back({"mass_left", s.mass_left});
  columns.push_back({"grains_above", static_cast<double>(in.above)});
  const double top = region_top(c), slice = top / static_cast<double>(kDensityNames.size());
  const std::vector<double> area = density_profile(in.position, in.area, 0, top, kDensityNames.size());
  for (std::size_t k = 0; k < area.size(); ++k) {
    const double low = static_cast<double>(k) * slice;
    columns.push_back({kDensityNames[k], area[k] * slice / (area_below(c, low + slice) - area_below(c, low))});
  }
}

void add_drum(std::vector<SeriesColumn>& columns, const ContainerScene& c, double angle, const Contents& in) {
  constexpr double degrees = 180 / std::numbers::pi;
  const Inclination i = inclination(in.position, in.mass, {}, c.radius);
  columns.push_back({"angle", angle * degrees});
  columns.push_back({"inclination_surface", i.surface * degrees});
  columns.push_back({"inclination_mass", i.centre_of_mass * degrees});
}

}  // namespace

void add_container_columns(std::vector<SeriesColumn>& columns, const ContainerScene& container,
                           const Surroundings& surroundings, const ContainerPlacement& placement,
                           const Contents& contents) {
  if (container.shape == ContainerShape::hopper) add_hopper(columns, container, surroundings, contents);
  if (container.shape == ContainerShape::drum) add_drum(columns, container, placement.angle, contents);
}

}  // namespace isostat
