#include "analysis/figure/slice_subject.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "analysis/figure/sphere_pen.hpp"

namespace isostat {
namespace {

constexpr int kCircleSides = 180;

// The content measures its margin in circles, arrows are measured in spheres.
double margin_of(const Packing<2>& circles, const PictureContent& content, double sphere_diameter) {
  if (circles.bodies.size() == 0) return 0;
  return content.margin(circles) * sphere_diameter / extent_of(circles).diameter;
}

Extent extent_in(const SpherePacking& packing, const Slice& slice, const Packing<2>& circles,
                 const PictureContent& content) {
  const View view = view_along(slice.axis);
  const double diameter = extent_of(packing, view).diameter;
  Extent extent = extent_of(packing, view, margin_of(circles, content, diameter));
  if (circles.cell) set_cell(extent, *circles.cell);
  return extent;
}

}  // namespace

SliceSubject::SliceSubject(const SpherePacking& packing, const Slice& slice, SlicedSpheres sliced,
                           std::unique_ptr<PictureContent> content, RichText title)
    : slice_(slice),
      walls_(packing.walls),
      sliced_(std::move(sliced)),
      content_(std::move(content)),
      title_(std::move(title)),
      extent_(extent_in(packing, slice, sliced_.packing, *content_)) {}

void SliceSubject::draw(Canvas& canvas, const PictureFrame& frame) const {
  const View view = view_along(slice_.axis);
  const Stroke stroke{blend(kWall, kBlack, 0.35), 1, {}};
  if (!walls_.empty()) {
    canvas.begin_group("walls");
    if (!frame.cuts()) canvas.clip(frame.box());
    for (const SphereWall& wall : walls_) {
      const double d = slice_.at - wall.point[slice_.axis];
      const Vec2 point = view.flat(wall.point), normal = view.flat(wall.normal);
      std::vector<Vec2> line;
      if (wall.shape != WallShape::plane && std::abs(d) < wall.radius) {
        const double radius = std::sqrt((wall.radius - d) * (wall.radius + d));
        for (int k = 0; k <= kCircleSides; ++k) {
          const double angle = 2 * std::numbers::pi * k / kCircleSides;
          line.push_back(frame.page(point + radius * Vec2{{std::cos(angle), std::sin(angle)}}));
        }
      } else if (const double across = norm(normal); wall.shape == WallShape::plane && across > 1e-9) {
        const Vec2 along{{-normal[1] / across, normal[0] / across}};
        const Vec2 middle{{0.5 * (extent_.low[0] + extent_.high[0]), 0.5 * (extent_.low[1] + extent_.high[1])}};
        const Vec2 on_line = point - (d * wall.normal[slice_.axis] / (across * across)) * normal;
        const Vec2 near = on_line + dot(along, middle - on_line) * along;
        const double reach = norm(extent_.high - extent_.low);
        line = {frame.page(near - reach * along), frame.page(near + reach * along)};
      }
      canvas.polyline(line, stroke);
    }
    if (!frame.cuts()) canvas.unclip();
    canvas.end_group();
  }
  content_->draw(canvas, PicturePen(sliced_.packing, frame));
}

std::vector<LegendItem> SliceSubject::legend(const PictureFrame& frame, double em) const {
  std::vector<LegendItem> items = content_->legend(PicturePen(sliced_.packing, frame), em);
  items.push_back(text_item(title_));
  return items;
}

}  // namespace isostat
