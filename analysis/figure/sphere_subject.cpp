#include "analysis/figure/sphere_subject.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "analysis/figure/sphere_outlines.hpp"

namespace isostat {

void SphereSubject::draw(Canvas& canvas, const PictureFrame& frame) const {
  const SpherePen pen(packing_, frame, seen_);
  draw_walls(canvas, pen, Side::back);
  draw_cell(canvas, pen, Side::back);
  content_->draw(canvas, pen);
  draw_cell(canvas, pen, Side::front);
  draw_walls(canvas, pen, Side::front);
}

std::vector<LegendItem> SphereSubject::legend(const PictureFrame& frame, double em) const {
  std::vector<LegendItem> items = content_->legend(SpherePen(packing_, frame, seen_), em);
  items.push_back(axes_item(em, seen_.view));
  return items;
}

LegendItem axes_item(double em, const View& view) {
  constexpr double kLength = 1.15, kGap = 0.4, kText = 0.75, kShortest = 0.05;  // [em], the last one of 1
  constexpr std::array<std::string_view, 3> kNames{"`x`", "`y`", "`z`"};
  struct Axis {
    Vec2 tip, label;  // [em] y downwards
    std::string_view name;
  };
  std::vector<Axis> axes;
  Vec2 low{}, high{};
  for (int k = 0; k < 3; ++k) {
    const Vec2 along{{view.right[k], -view.up[k]}};
    if (norm(along) < kShortest) continue;
    const Vec2 tip = kLength * along, label = tip + (kGap / norm(along)) * along;
    axes.push_back({tip, label, kNames[static_cast<std::size_t>(k)]});
    for (int c = 0; c < 2; ++c)
      low[c] = std::min(low[c], label[c] - 0.3 * kText), high[c] = std::max(high[c], label[c] + 0.3 * kText);
  }
  const Vec2 origin{{-low[0] * em, -0.5 * (low[1] + high[1]) * em}};
  return {(high[0] - low[0]) * em,
          [=](Canvas& canvas, const Vec2& p) {
            for (const Axis& axis : axes) {
              canvas.polyline(std::array{p + origin, p + origin + em * axis.tip}, {kInk, 0.08 * em, {}});
              const Vec2 label = p + origin + em * axis.label + Vec2{{0, 0.27 * kText * em}};
              canvas.text(label, rich(axis.name), {kText * em, Anchor::middle, kInk, false});
            }
          },
          {}};
}

}  // namespace isostat
