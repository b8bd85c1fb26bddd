// A canvas that keeps what is drawn on it, mark by mark, for tests to look at.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/figure/canvas.hpp"

namespace isostat::oracle {

class RecordingCanvas final : public Canvas {
 public:
  struct Context {
    std::string group;  // innermost
    std::optional<Rect> clip;
  };
  struct Disk : Context {
    DiskMark mark;
    Paint paint;
  };
  struct Ball : Context {
    DiskMark mark;
    Color color;
  };
  struct Segment : Context {
    SegmentMark mark;
    Color color;
  };
  struct Line : Context {
    std::vector<Vec2> points;
    Stroke stroke;
  };
  struct Area : Context {
    Polygon corners;
    Paint paint;
  };
  struct Box : Context {
    Rect rect;
    Paint paint;
  };
  struct Text : Context {
    Vec2 at;
    RichText text;
    TextStyle style;
    std::string plain() const {
      std::string s;
      for (const TextRun& run : text) s += run.text;
      return s;
    }
  };

  std::vector<Disk> drawn_disks;
  std::vector<Ball> drawn_balls;
  std::vector<Segment> drawn_segments;
  std::vector<Line> lines;
  std::vector<Area> areas;
  std::vector<Box> boxes;
  std::vector<Text> texts;

  void begin_group(std::string_view name) override { groups_.emplace_back(name); }
  void end_group() override {
    if (groups_.empty()) throw std::logic_error("end_group without begin_group");
    groups_.pop_back();
  }
  void clip(const Rect& rect) override {
    if (clip_) throw std::logic_error("clips do not nest");
    clip_ = rect;
  }
  void unclip() override {
    if (!clip_) throw std::logic_error("unclip without clip");
    clip_.reset();
  }
  void disks(std::span<const DiskMark> marks, const Paint& paint) override {
    for (const DiskMark& m : marks) drawn_disks.push_back({context(), m, paint});
  }
  void balls(std::span<const DiskMark> marks, const Color& color) override {
    for (const DiskMark& m : marks) drawn_balls.push_back({context(), m, color});
  }
  void segments(std::span<const SegmentMark> marks, const Color& color) override {
    for (const SegmentMark& m : marks) drawn_segments.push_back({context(), m, color});
  }
  void polyline(std::span<const Vec2> points, const Stroke& stroke) override {
    lines.push_back({context(), {points.begin(), points.end()}, stroke});
  }
  void polygons(std::span<const Polygon> marks, const Paint& paint) override {
    for (const Polygon& m : marks) areas.push_back({context(), m, paint});
  }
  void rectangle(const Rect& rect, const Paint& paint) override { boxes.push_back({context(), rect, paint}); }
  void text(const Vec2& at, const RichText& text, const TextStyle& style) override {
    texts.push_back({context(), at, text, style});
  }
  std::string finish() override {
    if (!groups_.empty() || clip_) throw std::logic_error("a group or clip was left open");
    return {};
  }

 private:
  Context context() const { return {groups_.empty() ? std::string() : groups_.back(), clip_}; }
  std::vector<std::string> groups_;
  std::optional<Rect> clip_;
};

}  // namespace isostat::oracle
