#include "analysis/figure/picture_pen.hpp"

#include "dem/state/link_ends.hpp"

#include <algorithm>

#include "analysis/figure/nice_numbers.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

PicturePen::PicturePen(const Packing<2>& packing, double margin) : packing_(packing), frame_(packing, margin) {
  for (const double r : packing.bodies.radius) largest_diameter_ = std::max(largest_diameter_, 2 * r);
}

Stroke PicturePen::outline(const Color& color) const {
  return {diameter() < 6 ? blend(color, kWhite, 0.55) : color, std::clamp(0.04 * diameter(), 0.15, 0.8), {}};
}

void PicturePen::disks(Canvas& canvas, const std::vector<std::size_t>& style, const std::vector<Paint>& paints) const {
  const Bodies<2>& b = packing_.bodies;
  std::vector<std::vector<DiskMark>> batches(paints.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Vec2 r = frame_.wrap(b.position[i]), reach{{b.radius[i], b.radius[i]}};
    frame_.for_visible_images(r - reach, r + reach, [&](const Vec2& offset) {
      batches[style[i]].push_back({frame_.page(r + offset), b.radius[i] * frame_.scale()});
    });
  }
  for (std::size_t k = 0; k < batches.size(); ++k) canvas.disks(batches[k], paints[k]);
}

void PicturePen::links(Canvas& canvas, const std::vector<DrawnLink>& links, const Color& color) const {
  std::vector<SegmentMark> marks;
  for (const DrawnLink& drawn : links) {
    const Link<2>* link = drawn.link;
    const double width = drawn.width;  // [pt] no structured binding: clang 14 captures none in a lambda
    const Vec2 from = frame_.wrap(packing_.bodies.position[idx(link->i)]);
    const Vec2 to = from + ends(packing_, *link).branch;
    const double half = width / (2 * frame_.scale());
    Vec2 low, high;
    for (int k = 0; k < 2; ++k) low[k] = std::min(from[k], to[k]) - half, high[k] = std::max(from[k], to[k]) + half;
    frame_.for_visible_images(low, high, [&](const Vec2& offset) {
      marks.push_back({frame_.page(from + offset), frame_.page(to + offset), width});
    });
  }
  canvas.segments(marks, color);
}

void PicturePen::areas(Canvas& canvas, const std::vector<const Polygon*>& areas, const Color& fill) const {
  std::vector<Polygon> marks;
  for (const Polygon* area : areas) {
    if (area->empty()) continue;
    Vec2 low = area->front(), high = low;
    for (const Vec2& p : *area)
      for (int k = 0; k < 2; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    frame_.for_visible_images(low, high, [&](const Vec2& offset) {
      Polygon image;
      for (const Vec2& p : *area) image.push_back(frame_.page(p + offset));
      marks.push_back(std::move(image));
    });
  }
  canvas.polygons(marks, {fill, std::nullopt});
}

RichText number_with_unit(double x, const RichText& unit) {
  return unit.empty() ? number_text(x) : number_text(x) + plain("\u2009") + unit;
}

}  // namespace isostat
