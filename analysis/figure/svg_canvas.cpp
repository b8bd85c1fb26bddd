#include "analysis/figure/svg_canvas.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "analysis/figure/ball_shading.hpp"

namespace isostat {
namespace {

constexpr const char* kFontStack = "DejaVu Sans, Verdana, Arial, sans-serif";

constexpr std::size_t kLongestPath = 1 << 18;  // [bytes] XML parsers refuse attributes of 10 MB

std::string number(double x, int decimals = 2) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::fixed, decimals).ptr;
  std::string s(buffer, end);
  if (s.find('.') != std::string::npos) {
    s.erase(s.find_last_not_of('0') + 1);
    if (s.back() == '.') s.pop_back();
  }
  return s == "-0" ? "0" : s;
}

std::string hex(const Color& c) {
  char buffer[8];
  const auto byte = [](double v) { return static_cast<unsigned>(std::lround(255 * std::clamp(v, 0.0, 1.0))); };
  std::snprintf(buffer, sizeof buffer, "#%02x%02x%02x", byte(c.red), byte(c.green), byte(c.blue));
  return buffer;
}

std::string escaped(std::string_view text) {
  std::string s;
  for (const char c : text) switch (c) {
      case '&':
        s += "&amp;";
        break;
      case '<':
        s += "&lt;";
        break;
      case '>':
        s += "&gt;";
        break;
      case '"':
        s += "&quot;";
        break;
      default:
        s += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  return s;
}

std::string stroke_attributes(const Stroke& s) {
  std::string a = " stroke=\"" + hex(s.color) + "\" stroke-width=\"" + number(s.width, 3) + '"';
  for (std::size_t i = 0; i < s.dash.size(); ++i) a += (i ? "," : " stroke-dasharray=\"") + number(s.dash[i]);
  if (!s.dash.empty()) a += '"';
  return a;
}

std::string paint_attributes(const Paint& paint) {
  return " fill=\"" + (paint.fill ? hex(*paint.fill) : std::string("none")) + '"' +
         (paint.outline ? stroke_attributes(*paint.outline) : std::string());
}

}  // namespace

std::string SvgCanvas::box(const Rect& r) {
  return " x=\"" + number(r.x) + "\" y=\"" + number(r.y) + "\" width=\"" + number(r.width) + "\" height=\"" +
         number(r.height) + '"';
}

std::string SvgCanvas::place(const Vec2& p) const { return number(p[0], decimals_) + ',' + number(p[1], decimals_); }

SvgCanvas::SvgCanvas(const Vec2& size, int decimals) : decimals_(decimals) {
  out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(size[0]) + "pt\" height=\"" + number(size[1]) +
         "pt\" viewBox=\"0 0 " + number(size[0]) + ' ' + number(size[1]) + "\" font-family=\"" + kFontStack +
         "\" stroke-linejoin=\"round\">\n";
  rectangle({0, 0, size[0], size[1]}, {kWhite, std::nullopt});
}

void SvgCanvas::begin_group(std::string_view name) {
  const int times = ++groups_[std::string(name)];
  last_id_ = escaped(name) + (times > 1 ? '-' + std::to_string(times) : "");
  out_ += "<g id=\"" + last_id_ + "\">\n";
}

void SvgCanvas::clip(const Rect& r) {
  const std::string id = "clip" + std::to_string(++clips_);
  out_ += "<clipPath id=\"" + id + "\"><rect" + box(r) + "/></clipPath>\n<g clip-path=\"url(#" + id + ")\">\n";
}

void SvgCanvas::disks(std::span<const DiskMark> marks, const Paint& paint) {
  if (marks.empty()) return;
  out_ += "<g" + paint_attributes(paint) + ">\n";
  circles(marks);
  out_ += "</g>\n";
}

// One gradient a colour, in units of each circle's box.
void SvgCanvas::balls(std::span<const DiskMark> marks, const Color& color) {
  if (marks.empty()) return;
  const auto [gradient, is_new] = gradients_.try_emplace(hex(color), static_cast<int>(gradients_.size()) + 1);
  const std::string id = "ball" + std::to_string(gradient->second);
  if (is_new) {
    out_ += "<radialGradient id=\"" + id + "\" fx=\"" + number(0.5 + 0.5 * kBallSpot[0]) + "\" fy=\"" +
            number(0.5 + 0.5 * kBallSpot[1]) + "\">";
    for (const BallShade& s : ball_shades(color))
      out_ += "<stop offset=\"" + number(s.offset) + "\" stop-color=\"" + hex(s.color) + "\"/>";
    out_ += "</radialGradient>\n";
  }
  out_ += "<g fill=\"url(#" + id + ")\">\n";
  circles(marks);
  out_ += "</g>\n";
}

void SvgCanvas::circles(std::span<const DiskMark> marks) {
  for (const DiskMark& d : marks)
    out_ += "<circle cx=\"" + number(d.center[0], decimals_) + "\" cy=\"" + number(d.center[1], decimals_) + "\" r=\"" +
            number(d.radius, decimals_ + 1) + "\"/>\n";
}

// One path for a run of equal widths; each link is one sub-path "M x,y l dx,dy".
void SvgCanvas::segments(std::span<const SegmentMark> marks, const Color& color) {
  if (marks.empty()) return;
  out_ += "<g fill=\"none\" stroke=\"" + hex(color) + "\" stroke-linecap=\"round\">\n";
  std::string width;
  std::size_t start = out_.size();
  for (const SegmentMark& s : marks) {
    if (std::string w = number(s.width, decimals_ + (s.width < 1)); w != width || out_.size() - start > kLongestPath) {
      if (!width.empty()) out_ += "\"/>\n";
      width = std::move(w);
      start = out_.size();
      out_ += "<path stroke-width=\"" + width + "\" d=\"";
    }
    const Vec2 d = s.to - s.from;
    out_ += 'M' + place(s.from) + 'l' + place(d);
  }
  out_ += "\"/>\n</g>\n";
}

void SvgCanvas::polyline(std::span<const Vec2> points, const Stroke& stroke) {
  if (points.empty()) return;
  out_ += "<polyline fill=\"none\"" + stroke_attributes(stroke) + " points=\"";
  for (const Vec2& p : points) out_ += place(p) + ' ';
  out_.back() = '"';
  out_ += "/>\n";
}

void SvgCanvas::polygons(std::span<const Polygon> marks, const Paint& paint) {
  if (marks.empty()) return;
  const std::string open = "<path" + paint_attributes(paint) + " d=\"";
  std::size_t start = out_.size();
  out_ += open;
  for (const Polygon& polygon : marks) {
    if (out_.size() - start > kLongestPath) {
      out_ += "\"/>\n";
      start = out_.size();
      out_ += open;
    }
    for (std::size_t i = 0; i < polygon.size(); ++i) out_ += (i == 0 ? 'M' : i == 1 ? 'L' : ' ') + place(polygon[i]);
    out_ += 'Z';
  }
  out_ += "\"/>\n";
}

void SvgCanvas::rectangle(const Rect& r, const Paint& paint) {
  out_ += "<rect" + box(r) + paint_attributes(paint) + "/>\n";
}

// Chunks of runs that share a script level; a tspan's dy is relative, so each one undoes the last.
void SvgCanvas::text(const Vec2& at, const RichText& text, const TextStyle& style) {
  const char* anchor = style.anchor == Anchor::start ? "start" : style.anchor == Anchor::middle ? "middle" : "end";
  const std::string x = number(at[0]), y = number(at[1]);
  out_ += "<text x=\"" + x + "\" y=\"" + y + "\" font-size=\"" + number(style.size) + "\" text-anchor=\"" + anchor +
          "\" fill=\"" + hex(style.color) + '"';
  if (style.upward) out_ += " transform=\"rotate(-90 " + x + ' ' + y + ")\"";
  out_ += " xml:space=\"preserve\">";
  double level = 0;
  for (const TextRun& run : text) {
    const double target = style.size * (run.script > 0 ? -kScriptRaise : run.script < 0 ? kScriptDrop : 0);
    std::string attributes;
    if (target != level) attributes += " dy=\"" + number(target - level) + '"';
    if (run.script != 0) attributes += " font-size=\"" + number(style.size * kScriptSize) + '"';
    if (run.italic) attributes += " font-style=\"italic\"";
    level = target;
    out_ += attributes.empty() ? escaped(run.text) : "<tspan" + attributes + '>' + escaped(run.text) + "</tspan>";
  }
  out_ += "</text>\n";
}

std::unique_ptr<Canvas> make_svg_canvas(const Vec2& size) { return std::make_unique<SvgCanvas>(size); }

}  // namespace isostat
