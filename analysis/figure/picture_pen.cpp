#include "analysis/figure/picture_pen.hpp"

#include "dem/state/link_ends.hpp"

#include <algorithm>

#include "analysis/figure/nice_numbers.hpp"
#include "geometry/base/index.hpp"

namespace isostat {

PicturePen::PicturePen(const Packing<2>& packing, const PictureFrame& frame) : FramePen(frame), packing_(packing) {
  for (std::size_t k = 0; k < packing.bodies.size(); ++k)
    if (isostat::is_free(packing.part, k))
      largest_diameter_ = std::max(largest_diameter_, 2 * packing.bodies.radius[k]);
}

Stroke FramePen::outline(const Color& color) const {
  return {diameter() < 6 ? blend(color, kWhite, 0.55) : color, std::clamp(0.04 * diameter(), 0.15, 0.8), {}};
}

void FramePen::bars(Canvas& canvas, const std::vector<Bar>& bars, const Color& color) const {
  std::vector<SegmentMark> marks;
  for (const Bar& bar : bars) {
    const Vec2 from = frame_.wrap(bar.from), to = from + (bar.to - bar.from);
    const double half = bar.width / (2 * frame_.scale());
    Vec2 low, high;
    for (int k = 0; k < 2; ++k) low[k] = std::min(from[k], to[k]) - half, high[k] = std::max(from[k], to[k]) + half;
    frame_.for_visible_images(low, high, [&](const Vec2& offset) {
      marks.push_back({frame_.page(from + offset), frame_.page(to + offset), bar.width});
    });
  }
  canvas.segments(marks, color);
}

void FramePen::areas(Canvas& canvas, const std::vector<const Polygon*>& areas, const Paint& paint) const {
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
  canvas.polygons(marks, paint);
}

void PicturePen::disks(Canvas& canvas, const std::vector<std::size_t>& style, const std::vector<Paint>& paints) const {
  const Bodies<2>& b = packing_.bodies;
  std::vector<std::vector<DiskMark>> batches(paints.size() + 2);  // walls and lids last
  for (std::size_t i = 0; i < packing_.grains(); ++i) {           // feet don't show
    const GrainPart part = packing_.part.empty() ? GrainPart::free : packing_.part[i];
    const std::size_t batch = part == GrainPart::free ? style[i] : paints.size() + (part == GrainPart::lid ? 1 : 0);
    const Vec2 r = frame().wrap(b.position[i]), reach{{b.radius[i], b.radius[i]}};
    frame().for_visible_images(r - reach, r + reach, [&](const Vec2& offset) {
      batches[batch].push_back({frame().page(r + offset), b.radius[i] * frame().scale()});
    });
  }
  for (std::size_t k = 0; k < paints.size(); ++k) canvas.disks(batches[k], paints[k]);
  const Stroke edge = outline(kInk);
  const double dash = 0.15 * diameter();
  canvas.disks(batches[paints.size()], {kWall, Stroke{blend(kWall, kBlack, 0.35), edge.width, {}}});
  canvas.disks(batches[paints.size() + 1], {std::nullopt, Stroke{kInk, edge.width, {dash, 0.6 * dash}}});
}

void PicturePen::links(Canvas& canvas, const std::vector<DrawnLink>& links, const Color& color) const {
  std::vector<Bar> bars;
  for (const DrawnLink& drawn : links) {
    const Vec2 from = frame().wrap(packing_.bodies.position[idx(drawn.link->i)]);
    bars.push_back({from, from + ends(packing_, *drawn.link).branch, drawn.width});
  }
  this->bars(canvas, bars, color);
}

RichText number_with_unit(double x, const RichText& unit) {
  return unit.empty() ? number_text(x) : number_text(x) + plain("\u2009") + unit;
}

}  // namespace isostat
