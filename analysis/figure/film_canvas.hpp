// One file with many frames that plays without a network: an SVG that moves by itself (SMIL), or an HTML page with
// buttons and a slider.
#pragma once
#include <memory>

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
  std::string finish() override;

 private:
  FilmKind kind_;
  std::size_t frames_, begun_ = 0;
  double rate_;
};

}  // namespace isostat
