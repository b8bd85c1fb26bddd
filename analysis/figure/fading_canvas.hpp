// A canvas that draws on another in paler colours.
#pragma once
#include "analysis/figure/canvas.hpp"

namespace isostat {

class FadingCanvas final : public Canvas {
 public:
  // white: its part in every colour. Keeps a reference to the canvas.
  FadingCanvas(Canvas& on, double white) : on_(on), white_(white) {}

  void begin_group(std::string_view name) override { on_.begin_group(name); }
  void end_group() override { on_.end_group(); }
  void clip(const Rect& rect) override { on_.clip(rect); }
  void unclip() override { on_.unclip(); }
  void disks(std::span<const DiskMark> marks, const Paint& p) override { on_.disks(marks, pale(p)); }
  void balls(std::span<const DiskMark> marks, const Color& c) override { on_.balls(marks, pale(c)); }
  void segments(std::span<const SegmentMark> marks, const Color& c) override { on_.segments(marks, pale(c)); }
  void polyline(std::span<const Vec2> points, const Stroke& s) override { on_.polyline(points, pale(s)); }
  void polygons(std::span<const Polygon> marks, const Paint& p) override { on_.polygons(marks, pale(p)); }
  void rectangle(const Rect& rect, const Paint& p) override { on_.rectangle(rect, pale(p)); }
  void text(const Vec2& at, const RichText& text, const TextStyle& style) override {
    on_.text(at, text, {style.size, style.anchor, pale(style.color), style.upward});
  }
  std::string finish() override { return on_.finish(); }

 private:
  Color pale(const Color& c) const { return blend(c, kWhite, white_); }
  Stroke pale(const Stroke& s) const { return {pale(s.color), s.width, s.dash}; }
  Paint pale(const Paint& p) const {
    Paint faded;
    if (p.fill) faded.fill = pale(*p.fill);
    if (p.outline) faded.outline = pale(*p.outline);
    return faded;
  }

  Canvas& on_;
  double white_;
};

}  // namespace isostat
