#include "analysis/figure/chart.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "analysis/figure/chart_range.hpp"
#include "analysis/figure/curve_marks.hpp"

namespace isostat {
namespace {

constexpr double kEdge = 12, kTitleLarger = 1;                                    // [pt]
constexpr double kTick = 4.5, kMinorTick = 2.5, kTickGap = 4, kTitleGap = 7;      // [pt]
constexpr double kPanelGap = 8, kLabelSpacingX = 62, kLabelSpacingY = 34;         // [pt]
constexpr double kBaseline = 0.36;                                                // [em]
constexpr double kSample = 20, kSampleGap = 6, kLegendPad = 6, kLegendRow = 1.5;  // [pt], row in em

// Low frames have their labels closer together.
double label_spacing_y(double height) { return height < 120 ? 24 : kLabelSpacingY; }

double widest_label(const Ticks& ticks, double font) {
  double width = 0;
  for (const Tick& t : ticks.ticks) width = std::max(width, text_width(t.label, font));
  return width;
}

struct LegendBox {
  double width = 0, height = 0;
};
LegendBox legend_box(const Chart& chart, double font) {
  double width = 0, rows = 0;
  for (const Curve& c : chart.curves)
    if (!c.label.empty()) width = std::max(width, kSample + kSampleGap + text_width(c.label, font)), rows += 1;
  for (const RichText& note : chart.notes) width = std::max(width, text_width(note, font)), rows += 1;
  if (rows == 0) return {};
  return {width + 2 * kLegendPad, rows * kLegendRow * font + kLegendPad};
}

bool contains(const Rect& r, const Vec2& p) {
  return p[0] >= r.x && p[0] <= r.right() && p[1] >= r.y && p[1] <= r.bottom();
}

// The first corner or side of the frame where it covers no data; none: it goes beside the frame.
std::optional<Vec2> free_place(const ChartFrame& frame, const Chart& chart, const LegendBox& legend) {
  constexpr double kInset = 6;
  const Rect& box = frame.box;
  if (legend.width + 2 * kInset > box.width || legend.height + 2 * kInset > box.height) return std::nullopt;
  std::vector<Vec2> points;
  for (std::size_t c = 0; c < chart.curves.size(); ++c)
    for (const Vec2& p : covered_points(frame, chart, c)) points.push_back(p);
  const double left = box.x + kInset, right = box.right() - kInset - legend.width, top = box.y + kInset,
               bottom = box.bottom() - kInset - legend.height;
  const double center = (left + right) / 2, middle = (top + bottom) / 2;
  for (const Vec2& corner :
       {Vec2{{right, top}}, Vec2{{left, top}}, Vec2{{right, bottom}}, Vec2{{left, bottom}}, Vec2{{right, middle}},
        Vec2{{left, middle}}, Vec2{{center, top}}, Vec2{{center, bottom}}}) {
    const Rect place{corner[0] - 2, corner[1] - 2, legend.width + 4, legend.height + 4};
    if (std::none_of(points.begin(), points.end(), [&](const Vec2& p) { return contains(place, p); })) return corner;
  }
  return std::nullopt;
}

void draw_legend(Canvas& canvas, const Chart& chart, const Vec2& top_left, double font) {
  double y = top_left[1] + kLegendPad / 2 + kLegendRow * font / 2;
  const double x = top_left[0] + kLegendPad;
  const TextStyle style{font, Anchor::start, kInk, false};
  for (std::size_t c = 0; c < chart.curves.size(); ++c) {
    if (chart.curves[c].label.empty()) continue;
    draw_sample(canvas, {{x, y}}, kSample, chart, c);
    canvas.text({{x + kSample + kSampleGap, y + kBaseline * font}}, chart.curves[c].label, style);
    y += kLegendRow * font;
  }
  for (const RichText& note : chart.notes) {
    canvas.text({{x, y + kBaseline * font}}, note, style);
    y += kLegendRow * font;
  }
}

void tick_line(Canvas& canvas, const Vec2& from, const Vec2& inwards) {
  canvas.polyline(std::array{from, from + inwards}, {kInk, 0.7, {}});
}

void draw_axes(Canvas& canvas, const ChartFrame& frame, bool labels_x, double title_x, double font) {
  const double title_font = font + kTitleLarger;
  const Rect& box = frame.box;
  const Ticks along = ticks(frame.x, box.width, kLabelSpacingX),
              up = ticks(frame.y, box.height, label_spacing_y(box.height));
  for (const Tick& t : along.ticks) {
    const double x = box.x + box.width * frame.x.fraction(t.value), size = t.label.empty() ? kMinorTick : kTick;
    tick_line(canvas, {{x, box.bottom()}}, {{0, -size}});
    tick_line(canvas, {{x, box.y}}, {{0, size}});
    if (labels_x && !t.label.empty())
      canvas.text({{x, box.bottom() + kTickGap + font}}, t.label, {font, Anchor::middle, kInk, false});
  }
  for (const Tick& t : up.ticks) {
    const double y = box.bottom() - box.height * frame.y.fraction(t.value), size = t.label.empty() ? kMinorTick : kTick;
    tick_line(canvas, {{box.x, y}}, {{size, 0}});
    tick_line(canvas, {{box.right(), y}}, {{-size, 0}});
    if (!t.label.empty())
      canvas.text({{box.x - kTickGap, y + kBaseline * font}}, t.label, {font, Anchor::end, kInk, false});
  }
  canvas.rectangle(box, {std::nullopt, Stroke{kInk, 0.9, {}}});
  const auto with_factor = [](const RichText& title, const Ticks& t) {
    return t.factor.empty() ? title : title + plain("   (") + t.factor + plain(")");
  };
  if (labels_x)
    canvas.text({{box.x + box.width / 2, box.bottom() + kTickGap + font + kTitleGap + title_font}},
                with_factor(frame.x.title, along), {title_font, Anchor::middle, kInk, false});
  const RichText title_y = with_factor(frame.y.title, up);
  const double fits = std::min(1.0, box.height / std::max(1.0, text_width(title_y, title_font)));
  canvas.text({{title_x, box.y + box.height / 2}}, title_y, {title_font * fits, Anchor::middle, kInk, true});
}

}  // namespace

ChartFigure::ChartFigure(std::vector<Chart> charts, bool share_x, const ChartStyle& style) : style_(style) {
  const double font = style.text, title_font = font + kTitleLarger;
  if (charts.empty()) throw std::invalid_argument("no value to show");
  for (Chart& chart : charts) {
    if (style.height) chart.height = *style.height;
    Panel panel;
    panel.x = fitted_x_axis(chart);
    panel.y = fitted_y_axis(chart, panel.x);
    panel.chart = std::move(chart);
    panels_.push_back(std::move(panel));
  }
  if (share_x) {
    for (const Panel& p : panels_)
      panels_[0].x.low = std::min(panels_[0].x.low, p.x.low), panels_[0].x.high = std::max(panels_[0].x.high, p.x.high);
    for (std::size_t k = 0; k < panels_.size(); ++k) {
      panels_[k].x = panels_[0].x;
      panels_[k].labels_x = k + 1 == panels_.size();
    }
  }
  double left = 0, beside = 0, y = kEdge;
  for (const Panel& p : panels_)
    left = std::max(left, widest_label(ticks(p.y, p.chart.height, label_spacing_y(p.chart.height)), font));
  left += kEdge + title_font + kTitleGap + kTickGap;
  for (Panel& p : panels_) {
    double height = p.chart.height;
    if (p.chart.equal_units)
      height = std::clamp(style.width * (p.y.high - p.y.low) / (p.x.high - p.x.low), 120.0, 760.0);
    p.frame = {left, y, style.width, height};
    y += height + (p.labels_x ? kTickGap + font + kTitleGap + title_font + kEdge : kPanelGap);
    const LegendBox legend = legend_box(p.chart, font);
    if (!free_place({p.frame, p.x, p.y}, p.chart, legend)) {
      beside = std::max(beside, legend.width);
      y = std::max(y, p.frame.y + legend.height + kEdge);
    }
  }
  // half a tick label may stick out at the right end of the x axis
  size_ = {{left + style.width + (beside > 0 ? beside + kEdge : 1.6 * kEdge), y}};
}

void ChartFigure::draw(Canvas& canvas) const {
  const double font = style_.text;
  for (std::size_t k = 0; k < panels_.size(); ++k) {
    const Panel& p = panels_[k];
    const ChartFrame frame{p.frame, p.x, p.y};
    canvas.begin_group("chart" + std::to_string(k + 1));
    canvas.clip(p.frame);
    for (std::size_t c = 0; c < p.chart.curves.size(); ++c) {
      canvas.begin_group("curve" + std::to_string(k + 1) + "." + std::to_string(c + 1));
      draw_curve(canvas, frame, p.chart, c);
      canvas.end_group();
    }
    canvas.unclip();
    draw_axes(canvas, frame, p.labels_x, kEdge + 0.8 * (font + kTitleLarger), font);
    const LegendBox legend = legend_box(p.chart, font);
    if (legend.width > 0) {
      const auto corner = free_place(frame, p.chart, legend);
      draw_legend(canvas, p.chart, corner.value_or(Vec2{{p.frame.right() + 4, p.frame.y - 4}}), font);
    }
    canvas.end_group();
  }
}

}  // namespace isostat
