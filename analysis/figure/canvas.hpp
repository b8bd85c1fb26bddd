// Where figures are drawn: SVG, PDF or PNG, or a recorder in the tests. Coordinates and sizes in points (1/72 inch),
// origin at the top left, y downwards.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/figure/color.hpp"
#include "analysis/figure/rich_text.hpp"
#include "geometry/vec.hpp"

namespace isostat {

struct Rect {
  double x = 0, y = 0, width = 0, height = 0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

struct Stroke {
  Color color = kInk;
  double width = 1;          // [pt]
  std::vector<double> dash;  // [pt] on, off, ...; empty: solid
};

struct Paint {
  std::optional<Color> fill;
  std::optional<Stroke> outline;
};

struct DiskMark {
  Vec2 center;
  double radius = 0;
};

struct SegmentMark {
  Vec2 from, to;
  double width = 0;
};

using Polygon = std::vector<Vec2>;

enum class Anchor { start, middle, end };

struct TextStyle {
  double size = 9;  // [pt]
  Anchor anchor = Anchor::start;
  Color color = kInk;
  bool upward = false;  // turned by 90 degrees, read from bottom to top
};

// Marks of one call share one style, which is what keeps a picture of 1e5 grains small.
class Canvas {
 public:
  virtual ~Canvas() = default;
  virtual void begin_group(std::string_view name) = 0;  // names a part of the figure (SVG: <g id="name">)
  virtual void end_group() = 0;
  virtual void clip(const Rect& rect) = 0;  // until unclip; clips do not nest
  virtual void unclip() = 0;
  virtual void disks(std::span<const DiskMark> marks, const Paint& paint) = 0;
  virtual void balls(std::span<const DiskMark> marks, const Color& color) = 0;  // shaded spheres, ball_shading.hpp
  virtual void segments(std::span<const SegmentMark> marks, const Color& color) = 0;
  virtual void polyline(std::span<const Vec2> points, const Stroke& stroke) = 0;
  virtual void polygons(std::span<const Polygon> marks, const Paint& paint) = 0;
  virtual void rectangle(const Rect& rect, const Paint& paint) = 0;
  virtual void text(const Vec2& baseline, const RichText& text, const TextStyle& style) = 0;
  virtual std::string finish() = 0;  // the file's bytes; nothing may be drawn after it
};

std::unique_ptr<Canvas> make_svg_canvas(const Vec2& size);
std::unique_ptr<Canvas> make_pdf_canvas(const Vec2& size);
std::unique_ptr<Canvas> make_png_canvas(const Vec2& size);  // 2 pixels a point (144 dpi)

}  // namespace isostat
