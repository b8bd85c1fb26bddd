#include <cairo-pdf.h>
#include <cairo.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/figure/ball_shading.hpp"
#include "analysis/figure/canvas.hpp"

namespace isostat {
namespace {

constexpr double kPixelsPerPoint = 2;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void select_font(cairo_t* cr, const TextRun& run, double size) {
  cairo_select_font_face(cr, "DejaVu Sans", run.italic ? CAIRO_FONT_SLANT_OBLIQUE : CAIRO_FONT_SLANT_NORMAL,
                         CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, run.script == 0 ? size : size * kScriptSize);
}

// Advance widths without hinting, so that they are the same for every backend and scale.
double run_width(cairo_t* cr, const TextRun& run, double size) {
  select_font(cr, run, size);
  cairo_text_extents_t extents;
  cairo_text_extents(cr, run.text.c_str(), &extents);
  return extents.x_advance;
}

void unhinted(cairo_t* cr) {
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(cr, options);
  cairo_font_options_destroy(options);
}

class CairoCanvas final : public Canvas {
 public:
  enum class Kind { pdf, png };

  CairoCanvas(Kind kind, const Vec2& size) : kind_(kind) {
    if (kind == Kind::pdf) {
      surface_ = cairo_pdf_surface_create_for_stream(append, &bytes_, size[0], size[1]);
    } else {
      surface_ = cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(kPixelsPerPoint * size[0])),
                                            static_cast<int>(std::ceil(kPixelsPerPoint * size[1])));
    }
    cr_ = cairo_create(surface_);
    unhinted(cr_);
    if (kind == Kind::png) {
      color(kWhite);
      cairo_paint(cr_);
      cairo_scale(cr_, kPixelsPerPoint, kPixelsPerPoint);
    }
    cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
  }
  ~CairoCanvas() override {
    cairo_destroy(cr_);
    cairo_surface_destroy(surface_);
  }
  CairoCanvas(const CairoCanvas&) = delete;
  CairoCanvas& operator=(const CairoCanvas&) = delete;

  void begin_group(std::string_view) override {}
  void end_group() override {}

  void clip(const Rect& r) override {
    cairo_save(cr_);
    cairo_rectangle(cr_, r.x, r.y, r.width, r.height);
    cairo_clip(cr_);
  }
  void unclip() override { cairo_restore(cr_); }

  // A few dozen marks a path: Cairo keeps every operation of a PDF until its end, and sorts all edges of a path.
  void disks(std::span<const DiskMark> marks, const Paint& style) override {
    for_chunks(marks, style, [&](const DiskMark& d) {
      cairo_new_sub_path(cr_);
      cairo_arc(cr_, d.center[0], d.center[1], d.radius, 0, 2 * std::numbers::pi);
      cairo_close_path(cr_);
    });
  }

  void balls(std::span<const DiskMark> marks, const Color& c) override {
    for (const DiskMark& d : marks) {
      const Vec2 spot = d.center + d.radius * kBallSpot;
      cairo_pattern_t* shading = cairo_pattern_create_radial(spot[0], spot[1], 0, d.center[0], d.center[1], d.radius);
      for (const BallShade& s : ball_shades(c))
        cairo_pattern_add_color_stop_rgb(shading, s.offset, s.color.red, s.color.green, s.color.blue);
      cairo_set_source(cr_, shading);
      cairo_pattern_destroy(shading);
      cairo_arc(cr_, d.center[0], d.center[1], d.radius, 0, 2 * std::numbers::pi);
      cairo_fill(cr_);
    }
  }

  void segments(std::span<const SegmentMark> marks, const Color& c) override {
    color(c);
    cairo_set_line_cap(cr_, CAIRO_LINE_CAP_ROUND);
    for (const SegmentMark& s : marks) {
      cairo_set_line_width(cr_, s.width);
      cairo_move_to(cr_, s.from[0], s.from[1]);
      cairo_line_to(cr_, s.to[0], s.to[1]);
      cairo_stroke(cr_);
    }
    cairo_set_line_cap(cr_, CAIRO_LINE_CAP_BUTT);
  }

  void polyline(std::span<const Vec2> points, const Stroke& s) override {
    for (const Vec2& p : points) cairo_line_to(cr_, p[0], p[1]);
    stroke(s);
  }

  void polygons(std::span<const Polygon> marks, const Paint& style) override {
    for_chunks(marks, style, [&](const Polygon& polygon) {
      cairo_new_sub_path(cr_);
      for (const Vec2& p : polygon) cairo_line_to(cr_, p[0], p[1]);
      cairo_close_path(cr_);
    });
  }

  void rectangle(const Rect& r, const Paint& style) override {
    cairo_rectangle(cr_, r.x, r.y, r.width, r.height);
    paint(style);
  }

  void text(const Vec2& at, const RichText& text, const TextStyle& style) override {
    double width = 0;
    for (const TextRun& run : text) width += run_width(cr_, run, style.size);
    cairo_save(cr_);
    cairo_translate(cr_, at[0], at[1]);
    if (style.upward) cairo_rotate(cr_, -std::numbers::pi / 2);
    double x = style.anchor == Anchor::start ? 0 : style.anchor == Anchor::middle ? -width / 2 : -width;
    color(style.color);
    for (const TextRun& run : text) {
      const double advance = run_width(cr_, run, style.size);
      cairo_move_to(cr_, x, style.size * (run.script > 0 ? -kScriptRaise : run.script < 0 ? kScriptDrop : 0));
      cairo_show_text(cr_, run.text.c_str());
      x += advance;
    }
    cairo_new_path(cr_);  // show_text leaves a current point behind
    cairo_restore(cr_);
  }

  std::string finish() override {
    if (kind_ == Kind::pdf) {
      cairo_show_page(cr_);
      cairo_surface_finish(surface_);
    } else {
      cairo_surface_flush(surface_);
      cairo_surface_write_to_png_stream(surface_, append, &bytes_);
    }
    for (const cairo_status_t status : {cairo_status(cr_), cairo_surface_status(surface_)})
      if (status != CAIRO_STATUS_SUCCESS)
        throw std::runtime_error(std::string("cairo: ") + cairo_status_to_string(status));
    return std::move(bytes_);
  }

 private:
  void color(const Color& c) { cairo_set_source_rgb(cr_, c.red, c.green, c.blue); }

  template <class Mark, class AddToPath>
  void for_chunks(std::span<const Mark> marks, const Paint& style, AddToPath&& add) {
    constexpr std::size_t kChunk = 64;
    for (std::size_t i = 0; i < marks.size(); ++i) {
      add(marks[i]);
      if ((i + 1) % kChunk == 0 || i + 1 == marks.size()) paint(style);
    }
  }

  void stroke(const Stroke& s) {
    color(s.color);
    cairo_set_line_width(cr_, s.width);
    cairo_set_dash(cr_, s.dash.data(), static_cast<int>(s.dash.size()), 0);
    cairo_stroke(cr_);
    cairo_set_dash(cr_, nullptr, 0, 0);
  }

  void paint(const Paint& style) {
    if (style.fill) {
      color(*style.fill);
      style.outline ? cairo_fill_preserve(cr_) : cairo_fill(cr_);
    }
    if (style.outline) stroke(*style.outline);
    cairo_new_path(cr_);
  }

  Kind kind_;
  std::string bytes_;  // before surface_: Cairo's PDF stream holds its address
  cairo_surface_t* surface_ = nullptr;
  cairo_t* cr_ = nullptr;
};

}  // namespace

std::unique_ptr<Canvas> make_pdf_canvas(const Vec2& size) {
  return std::make_unique<CairoCanvas>(CairoCanvas::Kind::pdf, size);
}
std::unique_ptr<Canvas> make_png_canvas(const Vec2& size) {
  return std::make_unique<CairoCanvas>(CairoCanvas::Kind::png, size);
}

double text_width(const RichText& text, double size) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  cairo_t* cr = cairo_create(surface);
  unhinted(cr);
  double width = 0;
  for (const TextRun& run : text) width += run_width(cr, run, size);
  cairo_destroy(cr);
  cairo_surface_destroy(surface);
  return width;
}

}  // namespace isostat
