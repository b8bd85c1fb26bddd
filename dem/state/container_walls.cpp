#include "dem/state/container_walls.hpp"

#include "dem/state/container_region.hpp"

namespace isostat {

std::vector<FlatWall> flat_walls(const ContainerScene& c) {
  const double x = 0.5 * c.width, top = region_top(c), knee = slope_height(c), o = 0.5 * c.opening;
  switch (c.shape) {
    case ContainerShape::box:
      return {{{{-x, top}}, {{-x, 0}}, false, true}, {{{-x, 0}}, {{x, 0}}}, {{{x, 0}}, {{x, top}}, true, false}};
    case ContainerShape::hopper:
      return {{{{-x, top}}, {{-x, knee}}, false, true},
              {{{-x, knee}}, {{-o, 0}}, true, false},
              {{{-o, 0}}, {{o, 0}}, true, true, GrainPart::lid},
              {{{o, 0}}, {{x, knee}}, false, true},
              {{{x, knee}}, {{x, top}}, true, false}};
    case ContainerShape::drum:
    case ContainerShape::none:
      break;
  }
  return {};
}

}  // namespace isostat
