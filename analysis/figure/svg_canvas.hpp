// Our own SVG rather than Cairo's: disks stay circles, text stays text, and marks of one style share their attributes,
// a third of the size for a large packing.
#pragma once
#include <map>
#include <string>

#include "analysis/figure/canvas.hpp"

namespace isostat {

class SvgCanvas : public Canvas {
 public:
  explicit SvgCanvas(const Vec2& size, int decimals = 2);  // [pt], decimals of a coordinate in points

  void begin_group(std::string_view name) override;  // a name used before gets a number behind it
  void end_group() override { out_ += "</g>\n"; }
  void clip(const Rect& rect) override;
  void unclip() override { out_ += "</g>\n"; }
  void disks(std::span<const DiskMark> marks, const Paint& paint) override;
  void balls(std::span<const DiskMark> marks, const Color& color) override;
  void segments(std::span<const SegmentMark> marks, const Color& color) override;
  void polyline(std::span<const Vec2> points, const Stroke& stroke) override;
  void polygons(std::span<const Polygon> marks, const Paint& paint) override;
  void rectangle(const Rect& rect, const Paint& paint) override;
  void text(const Vec2& baseline, const RichText& text, const TextStyle& style) override;
  std::string finish() override { return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + element(); }

 protected:
  void raw(std::string_view markup) { out_ += markup; }
  const std::string& written() const { return out_; }
  void forget_from(std::size_t place) { out_.resize(place); }
  const std::string& last_id() const { return last_id_; }         // of the group begun last
  std::string element() { return std::move(out_) + "</svg>\n"; }  // <svg> ... </svg>

 private:
  std::string place(const Vec2& p) const;  // "12.5,7.25"
  static std::string box(const Rect& rect);
  void circles(std::span<const DiskMark> marks);

  std::string out_, last_id_;
  int decimals_, clips_ = 0;
  std::map<std::string, int, std::less<>> groups_;  // how often each name was given
  std::map<std::string, int> gradients_;            // of balls, by colour
};

}  // namespace isostat
