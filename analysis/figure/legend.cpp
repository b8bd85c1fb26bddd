#include "analysis/figure/legend.hpp"

#include <array>

namespace isostat {
namespace {

constexpr double kGap = 0.55;       // [em] between symbol and label
constexpr double kSpace = 1.9;      // [em] between items
constexpr double kBaseline = 0.36;  // [em] from the middle of a line of text down to its baseline

double item_width(const LegendItem& item, double em) {
  const double gap = item.width > 0 && !item.label.empty() ? kGap * em : 0;
  return item.width + gap + text_width(item.label, em);
}

void segment(Canvas& canvas, const Vec2& from, const Vec2& to, const Stroke& stroke) {
  canvas.polyline(std::array{from, to}, stroke);
}

}  // namespace

LegendItem line_item(double em, const Color& color, RichText label) {
  return {2.2 * em,
          [=](Canvas& canvas, const Vec2& p) {
            const SegmentMark mark{p + Vec2{{0.15 * em, 0}}, p + Vec2{{2.05 * em, 0}}, 0.3 * em};
            canvas.segments({&mark, 1}, color);
          },
          std::move(label)};
}

LegendItem force_scale_item(double thickness, double em, RichText label) {
  return {2.2 * em,
          [=](Canvas& canvas, const Vec2& p) {
            canvas.rectangle({p[0], p[1] - thickness / 2, 2.2 * em, thickness}, {kInk, std::nullopt});
          },
          std::move(label)};
}

LegendItem disk_item(double em, const Paint& paint, RichText label) {
  return {em,
          [=](Canvas& canvas, const Vec2& p) {
            const DiskMark mark{p + Vec2{{em / 2, 0}}, em / 2};
            canvas.disks({&mark, 1}, paint);
          },
          std::move(label)};
}

LegendItem ball_item(double em, const Color& color, RichText label) {
  return {em,
          [=](Canvas& canvas, const Vec2& p) {
            const DiskMark mark{p + Vec2{{em / 2, 0}}, em / 2};
            canvas.balls({&mark, 1}, color);
          },
          std::move(label)};
}

LegendItem length_scale_item(double length, RichText label) {
  return {length,
          [=](Canvas& canvas, const Vec2& p) {
            const double tick = 3;
            segment(canvas, p, p + Vec2{{length, 0}}, {kInk, 1, {}});
            for (const double x : {0.0, length})
              segment(canvas, p + Vec2{{x, -tick}}, p + Vec2{{x, tick}}, {kInk, 1, {}});
          },
          std::move(label)};
}

LegendItem text_item(RichText label) {
  return {0, [](Canvas&, const Vec2&) {}, std::move(label)};
}

LegendItem color_bar_item(double em, std::function<Color(double)> map, RichText low, RichText high) {
  constexpr int kSteps = 48;
  const double bar = 8 * em, left = text_width(low, em) + 0.4 * em, right = text_width(high, em) + 0.4 * em;
  return {left + bar + right,
          [=, map = std::move(map), low = std::move(low), high = std::move(high)](Canvas& canvas, const Vec2& p) {
            const double x = p[0] + left, height = 0.9 * em;
            for (int s = 0; s < kSteps; ++s)  // half a step of overlap hides the seams of antialiasing
              canvas.rectangle(
                  {x + s * bar / kSteps, p[1] - height / 2, (s + 1 < kSteps ? 1.5 : 1) * bar / kSteps, height},
                  {map((s + 0.5) / kSteps * 2 - 1), std::nullopt});
            canvas.rectangle({x, p[1] - height / 2, bar, height}, {std::nullopt, Stroke{kFaint, 0.5, {}}});
            canvas.text({{p[0], p[1] + kBaseline * em}}, low, {em, Anchor::start, kInk, false});
            canvas.text({{x + bar + 0.4 * em, p[1] + kBaseline * em}}, high, {em, Anchor::start, kInk, false});
          },
          {}};
}

Legend::Legend(std::vector<LegendItem> items, double text_size, double width)
    : items_(std::move(items)), size_(text_size) {
  double x = 0;
  if (!items_.empty()) rows_ = 1;
  for (const LegendItem& item : items_) {
    const double w = item_width(item, size_);
    if (x > 0 && x + w > width) x = 0, ++rows_;
    places_.push_back({x, rows_ - 1});
    x += w + kSpace * size_;
  }
}

void Legend::draw(Canvas& canvas, const Vec2& top_left) const {
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const LegendItem& item = items_[i];
    const Vec2 left = top_left + Vec2{{places_[i].x, (places_[i].row + 0.5) * row_height()}};
    item.draw_symbol(canvas, left);
    const double gap = item.width > 0 ? kGap * size_ : 0;
    if (!item.label.empty())
      canvas.text(left + Vec2{{item.width + gap, kBaseline * size_}}, item.label, {size_, Anchor::start, kInk, false});
  }
}

}  // namespace isostat
