// One file with many frames that plays without a network: an SVG that moves by itself (SMIL), or an HTML page with
// buttons and a slider.
#pragma once
#include <string>
#include <unordered_map>
#include <vector>

#include "analysis/figure/svg_canvas.hpp"

namespace isostat {

enum class FilmKind { svg, html };

class FilmCanvas final : public SvgCanvas {
 public:
  // frames: how many there will be. rate [1/s].
  FilmCanvas(FilmKind kind, const Vec2& size, std::size_t frames, double rate);

  // What is drawn between shows in this frame alone; the rest, always.
  void begin_frame();
  void end_frame() { raw("</g>\n"); }
  // A group that an earlier frame has had, such as walls at rest, is used again.
  void begin_group(std::string_view name) override;
  void end_group() override;
  std::string finish() override;

 private:
  struct Group {
    std::size_t begin, body, size = 0;  // where its tag begins, and its body, in what is written
    std::string id;
  };

  FilmKind kind_;
  std::vector<Group> open_;
  std::unordered_multimap<std::size_t, Group> seen_;  // by hash of the body
  std::size_t frames_, begun_ = 0;
  double rate_;
};

}  // namespace isostat
