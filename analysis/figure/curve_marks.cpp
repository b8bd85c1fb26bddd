#include "analysis/figure/curve_marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/figure/chart_range.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

constexpr double kLine = 1.4, kErrorLine = 0.8, kMarker = 2.3, kDot = 0.7, kCap = 2.0;  // [pt]

// Pieces of the curve between values that the axes cannot show.
std::vector<std::vector<Vec2>> pieces(const ChartFrame& frame, const Curve& curve) {
  std::vector<std::vector<Vec2>> all(1);
  for (std::size_t i = 0; i < curve.y.size(); ++i) {
    if (frame.x.shows(curve.x[i]) && frame.y.shows(curve.y[i]))
      all.back().push_back(frame.page(curve.x[i], curve.y[i]));
    else if (!all.back().empty())
      all.emplace_back();
  }
  return all;
}

// Outline of a histogram from the baseline up, over every bin and down again.
std::vector<Vec2> step_outline(const ChartFrame& frame, const Curve& curve) {
  std::vector<Vec2> line;
  const double base = frame.box.bottom();
  for (std::size_t i = 0; i < curve.y.size(); ++i) {
    if (!frame.x.shows(curve.x[i]) || !frame.x.shows(curve.x[i + 1])) continue;
    const double left = frame.page(curve.x[i], frame.y.high)[0], right = frame.page(curve.x[i + 1], frame.y.high)[0];
    const double top = frame.y.shows(curve.y[i]) ? frame.page(curve.x[i], curve.y[i])[1] : base;
    if (line.empty()) line.push_back({{left, base}});
    line.push_back({{left, top}});
    line.push_back({{right, top}});
  }
  if (!line.empty()) line.push_back({{line.back()[0], base}});
  return line;
}

// Disk, square, diamond, triangle in turn, so that curves also differ without colour.
void markers(Canvas& canvas, const std::vector<Vec2>& centers, const Color& color, std::size_t shape) {
  const Paint paint{color, Stroke{kWhite, 0.5, {}}};
  if (shape % 4 == 0) {
    std::vector<DiskMark> disks;
    for (const Vec2& c : centers) disks.push_back({c, kMarker});
    canvas.disks(disks, paint);
    return;
  }
  static const std::array<Polygon, 3> shapes = {Polygon{{{-.9, -.9}}, {{.9, -.9}}, {{.9, .9}}, {{-.9, .9}}},
                                                Polygon{{{0, -1.3}}, {{1.3, 0}}, {{0, 1.3}}, {{-1.3, 0}}},
                                                Polygon{{{0, -1.3}}, {{1.15, .75}}, {{-1.15, .75}}}};
  std::vector<Polygon> polygons;
  for (const Vec2& c : centers) {
    Polygon p;
    for (const Vec2& corner : shapes[shape % 4 - 1]) p.push_back(c + kMarker * corner);
    polygons.push_back(std::move(p));
  }
  canvas.polygons(polygons, paint);
}

// Which of the chart's point curves this is.
std::size_t shape_of(const Chart& chart, std::size_t curve) {
  std::size_t shape = 0;
  for (std::size_t c = 0; c < curve; ++c) shape += chart.curves[c].style == CurveStyle::points;
  return shape;
}

bool first_steps(const Chart& chart, std::size_t curve) {
  for (std::size_t c = 0; c < curve; ++c)
    if (chart.curves[c].style == CurveStyle::steps) return false;
  return true;
}

void segment(Canvas& canvas, const Vec2& a, const Vec2& b, const Stroke& stroke) {
  canvas.polyline(std::array{a, b}, stroke);
}

// Lower ends that a log axis cannot show run out of the frame.
void error_bars(Canvas& canvas, const ChartFrame& frame, const Curve& curve, double shift) {
  const Stroke stroke{curve.color, kErrorLine, {}};
  for (std::size_t i = 0; i < curve.y.size() && i < curve.error.size(); ++i) {
    if (!(curve.error[i] > 0) || !frame.x.shows(curve.x[i]) || !frame.y.shows(curve.y[i])) continue;
    const double up = curve.y[i] + curve.error[i], down = curve.y[i] - curve.error[i];
    const Vec2 top = frame.page(curve.x[i] + shift, up);
    const Vec2 bottom{{top[0], frame.y.shows(down) ? frame.page(curve.x[i], down)[1] : frame.box.bottom() + 2 * kCap}};
    segment(canvas, bottom, top, stroke);
    for (const Vec2& end : {bottom, top}) segment(canvas, end - Vec2{{kCap, 0}}, end + Vec2{{kCap, 0}}, stroke);
  }
}

void draw_bars(Canvas& canvas, const ChartFrame& frame, const Chart& chart, std::size_t index) {
  const Curve& curve = chart.curves[index];
  for (std::size_t i = 0; i < curve.y.size(); ++i) {
    if (!frame.y.shows(curve.y[i])) continue;
    const BarPlace place = bar_place(chart, index, curve.x[i]);
    const Vec2 top = frame.page(place.left, curve.y[i]), right = frame.page(place.right, curve.y[i]);
    canvas.rectangle({top[0], top[1], right[0] - top[0], frame.box.bottom() - top[1]},
                     {blend(curve.color, kWhite, 0.35), Stroke{curve.color, 0.7, {}}});
  }
  const BarPlace origin = bar_place(chart, index, 0);
  Curve dark = curve;
  dark.color = blend(curve.color, kBlack, 0.45);
  error_bars(canvas, frame, dark, (origin.left + origin.right) / 2);
}

void draw_cells(Canvas& canvas, const ChartFrame& frame, const Curve& curve) {
  double low = 0, high = 0;
  for (const double v : curve.y)
    if (v > 0) low = low > 0 ? std::min(low, v) : v, high = std::max(high, v);
  if (!(high > 0)) return;
  constexpr int kLevels = 24;
  std::vector<std::vector<Polygon>> levels(kLevels);
  const std::size_t columns = curve.x2.size() - 1;
  for (std::size_t i = 0; i < curve.y.size(); ++i) {
    if (!(curve.y[i] > 0)) continue;
    const double t = high > low ? std::log(curve.y[i] / low) / std::log(high / low) : 1;
    const std::size_t r = i / columns, c = i % columns;
    const Vec2 a = frame.page(curve.x[r], curve.x2[c]), b = frame.page(curve.x[r + 1], curve.x2[c + 1]);
    levels[idx(std::lround(t * (kLevels - 1)))].push_back({a, {{b[0], a[1]}}, b, {{a[0], b[1]}}});
  }
  for (int level = 0; level < kLevels; ++level) {  // the outline closes the seams of antialiasing
    const Color color = sequential(static_cast<double>(level) / (kLevels - 1));
    canvas.polygons(levels[idx(level)], {color, Stroke{color, 0.4, {}}});
  }
}

}  // namespace

std::vector<Vec2> thinned(const std::vector<Vec2>& line) {
  constexpr double kColumn = 0.25;  // [pt]
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < line.size();) {
    std::size_t end = i, low = i, high = i;
    const double column = std::floor(line[i][0] / kColumn);
    for (; end < line.size() && std::floor(line[end][0] / kColumn) == column; ++end) {
      if (line[end][1] < line[low][1]) low = end;
      if (line[end][1] > line[high][1]) high = end;
    }
    std::array order{i, low, high, end - 1};
    std::sort(order.begin(), order.end());
    for (auto it = order.begin(); it != std::unique(order.begin(), order.end()); ++it) kept.push_back(line[*it]);
    i = end;
  }
  return kept;
}

void draw_curve(Canvas& canvas, const ChartFrame& frame, const Chart& chart, std::size_t index) {
  const Curve& curve = chart.curves[index];
  switch (curve.style) {
    case CurveStyle::line:
    case CurveStyle::dashed: {
      const std::vector<double> dash =
          curve.style == CurveStyle::dashed ? std::vector{5.0, 3.0} : std::vector<double>{};
      for (const auto& piece : pieces(frame, curve))
        if (piece.size() > 1) canvas.polyline(thinned(piece), {curve.color, kLine, dash});
      break;
    }
    case CurveStyle::points: {
      error_bars(canvas, frame, curve, 0);
      std::vector<Vec2> centers;
      for (const auto& piece : pieces(frame, curve)) centers.insert(centers.end(), piece.begin(), piece.end());
      markers(canvas, centers, curve.color, shape_of(chart, index));
      break;
    }
    case CurveStyle::cloud: {
      std::vector<DiskMark> dots;
      for (const auto& piece : pieces(frame, curve))
        for (const Vec2& p : piece) dots.push_back({p, kDot});
      canvas.disks(dots, {curve.color, std::nullopt});
      break;
    }
    case CurveStyle::steps: {
      const std::vector<Vec2> outline = step_outline(frame, curve);
      if (first_steps(chart, index)) canvas.polygons(std::array{outline}, {blend(curve.color, kWhite, 0.82), {}});
      canvas.polyline(outline, {curve.color, 1.1, {}});
      Curve middle = curve;  // error bars stand in the middle of the bins
      for (std::size_t i = 0; i + 1 < curve.x.size(); ++i)
        middle.x[i] = frame.x.log ? std::sqrt(curve.x[i] * curve.x[i + 1]) : (curve.x[i] + curve.x[i + 1]) / 2;
      error_bars(canvas, frame, middle, 0);
      break;
    }
    case CurveStyle::bars:
      draw_bars(canvas, frame, chart, index);
      break;
    case CurveStyle::cells:
      draw_cells(canvas, frame, curve);
      break;
  }
}

void draw_sample(Canvas& canvas, const Vec2& left, double width, const Chart& chart, std::size_t index) {
  const Curve& curve = chart.curves[index];
  const Vec2 middle = left + Vec2{{width / 2, 0}}, right = left + Vec2{{width, 0}};
  const Rect box{left[0], left[1] - 3.5, width, 7};
  switch (curve.style) {
    case CurveStyle::line:
      segment(canvas, left, right, {curve.color, kLine, {}});
      break;
    case CurveStyle::dashed:
      segment(canvas, left, right, {curve.color, kLine, {5, 3}});
      break;
    case CurveStyle::points:
      markers(canvas, {middle}, curve.color, shape_of(chart, index));
      break;
    case CurveStyle::cloud:
      canvas.disks(std::array{DiskMark{middle, 1.6}}, {curve.color, std::nullopt});
      break;
    case CurveStyle::steps:
      canvas.rectangle(
          box, {first_steps(chart, index) ? blend(curve.color, kWhite, 0.82) : kWhite, Stroke{curve.color, 1.1, {}}});
      break;
    case CurveStyle::bars:
      canvas.rectangle(box, {blend(curve.color, kWhite, 0.35), Stroke{curve.color, 0.7, {}}});
      break;
    case CurveStyle::cells:
      canvas.rectangle(box, {sequential(0.6), std::nullopt});
      break;
  }
}

std::vector<Vec2> covered_points(const ChartFrame& frame, const Chart& chart, std::size_t index) {
  constexpr double kApart = 4;  // [pt]
  const Curve& curve = chart.curves[index];
  std::vector<Vec2> covered;
  const auto along = [&](const Vec2& a, const Vec2& b) {
    const int n = std::max(1, static_cast<int>(std::ceil(std::min(norm(b - a), 5000.0) / kApart)));
    for (int k = 0; k <= n; ++k) covered.push_back(a + (static_cast<double>(k) / n) * (b - a));
  };
  const auto below = [&](const Vec2& left, const Vec2& right) {
    for (double x = left[0]; x <= right[0]; x += kApart) along({{x, left[1]}}, {{x, frame.box.bottom()}});
  };
  if (curve.style == CurveStyle::steps) {
    const auto outline = step_outline(frame, curve);
    for (std::size_t i = 1; i + 1 < outline.size(); i += 2) below(outline[i], outline[i + 1]);
  } else if (curve.style == CurveStyle::bars) {
    for (std::size_t i = 0; i < curve.y.size(); ++i) {
      if (!frame.y.shows(curve.y[i])) continue;
      const BarPlace place = bar_place(chart, index, curve.x[i]);
      const double top = curve.y[i] + (i < curve.error.size() && curve.error[i] > 0 ? curve.error[i] : 0);
      below(frame.page(place.left, top), frame.page(place.right, top));
    }
  } else if (curve.style == CurveStyle::cells) {
    const std::size_t columns = curve.x2.size() - 1;
    for (std::size_t i = 0; i < curve.y.size(); ++i)
      if (curve.y[i] > 0) covered.push_back(frame.page(curve.x[i / columns], curve.x2[i % columns]));
  } else {
    const bool line = curve.style == CurveStyle::line || curve.style == CurveStyle::dashed;
    for (const auto& piece : pieces(frame, curve)) {
      const auto points = line ? thinned(piece) : piece;
      covered.insert(covered.end(), points.begin(), points.end());
      for (std::size_t i = 1; line && i < points.size(); ++i) along(points[i - 1], points[i]);
    }
  }
  return covered;
}

}  // namespace isostat
