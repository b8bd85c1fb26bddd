// What a picture of spheres shows.
#pragma once
#include <memory>
#include <vector>

#include "analysis/figure/picture_content.hpp"
#include "analysis/figure/sphere_pen.hpp"

namespace isostat {

using SphereContent = ContentOf<SpherePacking, SpherePen>;

// Shaded spheres, each of one of several styles: groups, rigid clusters.
struct BallStyle {
  Color color;
  RichText label;  // empty: not in the legend
};
// style[i]: of body i, an index into styles.
std::unique_ptr<SphereContent> balls_content(std::vector<std::size_t> style, std::vector<BallStyle> styles);

// [a] width of a force a^2 P: there are more lines over one another than in the plane, and P pushes on a larger area.
inline constexpr double kSphereWidthAtAP = 0.06;

// Lines between centres over pale spheres; contacts with walls from the centre to the wall.
std::unique_ptr<SphereContent> sphere_forces_content(ForceOptions options);

// Arrows for the velocity across the line of sight, colours for the velocity along it. Each arrow lies on its sphere
// and is hidden by nearer ones. speed_unit may be empty.
struct SphereMotion {
  std::vector<Vec3> velocity;  // one a body
  RichText speed_unit;
};
// What makes pictures of a series comparable: of speeds, and of the velocity along the line of sight.
MotionScale motion_scale(const SphereMotion& motion, const View& view);
std::unique_ptr<SphereContent> sphere_motion_content(const SphereMotion& motion, const View& view,
                                                     const MotionScale& scale);

}  // namespace isostat
