// Charts, read as a person reads them: positions against the numbers written on the axes.
#include "analysis/figure/chart.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "analysis/figure/chart_range.hpp"
#include "analysis/figure/curve_marks.hpp"
#include "analysis/figure/nice_numbers.hpp"
#include "tests/support/recording_canvas.hpp"

namespace isostat {
namespace {

using oracle::RecordingCanvas;

// The number that a label shows: "0.05", "-3", "10^{-4}", "2 x 10^{5}".
double read_number(const RichText& text) {
  std::string s, power;
  for (const TextRun& run : text) (run.script > 0 ? power : s) += run.text;
  for (std::string* t : {&s, &power})
    for (std::size_t at; (at = t->find("\u2212")) != std::string::npos;) t->replace(at, 3, "-");
  double factor = 1;
  if (!power.empty()) {
    factor = std::pow(10, std::stod(power));
    const std::size_t ten = s.rfind("10");
    s = s.substr(0, ten);
    if (const std::size_t times = s.find("\u2009"); times != std::string::npos) s = s.substr(0, times);
    if (s.empty()) s = "1";
    if (s == "-") s = "-1";
  }
  return factor * std::stod(s);
}

// Value at a page coordinate, from the two outermost labels of that axis.
struct Ruler {
  bool log;
  double at0, value0, at1, value1;
  double value(double at) const {
    const double t = (at - at0) / (at1 - at0);
    return log ? value0 * std::pow(value1 / value0, t) : value0 + t * (value1 - value0);
  }
};

struct Drawn {
  RecordingCanvas canvas;
  Vec2 size;
  Rect frame;
};

Drawn draw(std::vector<Chart> charts, bool share = false) {
  const ChartFigure figure(std::move(charts), share);
  Drawn d;
  d.size = figure.size();
  figure.draw(d.canvas);
  d.canvas.finish();
  for (const auto& box : d.canvas.boxes)
    if (box.group == "chart1" && !box.paint.fill) d.frame = box.rect;
  return d;
}

Ruler x_ruler(const Drawn& d, bool log) {
  std::vector<std::pair<double, double>> labels;
  for (const auto& t : d.canvas.texts)
    if (t.style.anchor == Anchor::middle && !t.style.upward && t.style.size < 10 && t.at[1] > d.frame.bottom())
      labels.emplace_back(t.at[0], read_number(t.text));
  EXPECT_GE(labels.size(), 2u);
  return {log, labels.front().first, labels.front().second, labels.back().first, labels.back().second};
}

Ruler y_ruler(const Drawn& d, bool log) {
  std::vector<std::pair<double, double>> labels;
  for (const auto& t : d.canvas.texts)  // baselines lie a fixed bit below the tick
    if (t.style.anchor == Anchor::end) labels.emplace_back(t.at[1] - 0.36 * t.style.size, read_number(t.text));
  EXPECT_GE(labels.size(), 2u);
  return {log, labels.front().first, labels.front().second, labels.back().first, labels.back().second};
}

RC_GTEST_PROP(Chart, PointsLieWhereTheAxesSay, (bool log_x, bool log_y)) {
  const auto decades = *rc::gen::inRange(1, 9);
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint32_t>());
  std::vector<int> raw{0, 1000};  // thousandths of the range
  while (raw.size() < 12) raw.push_back(static_cast<int>(random() % 1001));
  Curve curve;
  curve.style = CurveStyle::points;
  for (std::size_t k = 0; k < raw.size(); ++k) {
    const double t = raw[k] / 1000.0 * decades;
    curve.x.push_back(log_x ? std::pow(10, t - 3) : 2.5 * t - 1);
    curve.y.push_back(log_y ? std::pow(10, 2 - t) : 1e-7 * (t - 3));
  }
  Chart chart;
  chart.x.log = log_x, chart.y.log = log_y;
  chart.curves.push_back(curve);
  const Drawn d = draw({chart});
  // a linear axis of small numbers shares a factor, written into its title
  double factor = 1;
  for (const auto& t : d.canvas.texts)
    if (const std::string s = t.plain(); t.style.upward && s.find("\u00d7") != std::string::npos) {
      RichText number;
      for (const TextRun& run : t.text)
        if (run.script > 0) number = {{"10", false, 0}, run};
      factor = read_number(number);
    }
  const Ruler x = x_ruler(d, log_x), y = y_ruler(d, log_y);
  RC_ASSERT(d.canvas.drawn_disks.size() == curve.x.size());
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    const Vec2 at = d.canvas.drawn_disks[k].mark.center;
    RC_ASSERT(std::abs(x.value(at[0]) - curve.x[k]) <= 1e-6 * (log_x ? curve.x[k] : 2.5 * decades));
    RC_ASSERT(std::abs(factor * y.value(at[1]) - curve.y[k]) <= 1e-6 * (log_y ? curve.y[k] : 1e-7 * decades));
    RC_ASSERT(at[0] > d.frame.x && at[0] < d.frame.right() && at[1] > d.frame.y && at[1] < d.frame.bottom());
  }
}

RC_GTEST_PROP(Ticks, AreRoundInsideAndNotCrowded, (bool log)) {
  const double low = *rc::gen::inRange(-1000, 1000) * std::pow(10, *rc::gen::inRange(-6, 4));
  const double span = *rc::gen::inRange(1, 1000) * std::pow(10, *rc::gen::inRange(-4, 4));
  Axis axis{{}, log, low, low + span};
  if (log) axis.low = std::pow(10, *rc::gen::inRange(-80, 40) / 10.0), axis.high = axis.low * (1 + span / 10);
  RC_PRE(span > 1e-6 * std::abs(low));
  const double length = 300, spacing = 40;
  const Ticks t = ticks(axis, length, spacing);
  double last = -INFINITY, last_label = -INFINITY;
  int labels = 0;
  for (const Tick& tick : t.ticks) {
    const double at = axis.fraction(tick.value);
    RC_ASSERT(at >= -1e-6 && at <= 1 + 1e-6);
    RC_ASSERT(at > last);
    last = at;
    if (tick.label.empty()) continue;
    ++labels;
    RC_ASSERT((at - last_label) * length >= 0.3 * spacing);  // of a log axis 5 and 10 are the closest, at .3 decades
    last_label = at;
    double shown = read_number(tick.label);
    if (!t.factor.empty())
      shown *= std::pow(10, std::stod([&] {
                          std::string p = t.factor.back().text;
                          if (p.starts_with("\u2212")) p.replace(0, 3, "-");
                          return p;
                        }()));
    RC_ASSERT(std::abs(shown - tick.value) <= 1e-6 * std::max(std::abs(tick.value), (axis.high - axis.low) / 10));
  }
  RC_ASSERT(labels >= 1);
  RC_ASSERT(labels <= 18);
}

TEST(Chart, HistogramCoversTheAreaOfItsBins) {
  Chart chart;
  Curve steps;
  steps.style = CurveStyle::steps;
  steps.x = {0, 1, 2, 4};
  steps.y = {0.5, 0.25, 0.125};
  chart.curves.push_back(steps);
  const Drawn d = draw({chart});
  const Ruler x = x_ruler(d, false), y = y_ruler(d, false);
  ASSERT_EQ(d.canvas.areas.size(), 1u);
  const Polygon& outline = d.canvas.areas[0].corners;
  double area = 0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 &a = outline[k], &b = outline[(k + 1) % outline.size()];
    area += 0.5 * (x.value(a[0]) * y.value(b[1]) - x.value(b[0]) * y.value(a[1]));
  }
  EXPECT_NEAR(std::abs(area), 1, 1e-9);
}

TEST(Chart, ErrorBarsReachOneErrorUpAndDown) {
  Chart chart;
  chart.y.log = true;
  Curve points;
  points.style = CurveStyle::points;
  points.x = {1, 2, 3}, points.y = {10, 1, 0.1}, points.error = {5, 0.5, 0.2};
  chart.curves.push_back(points);
  const Drawn d = draw({chart});
  const Ruler y = y_ruler(d, true);
  int found = 0;
  for (const auto& line : d.canvas.lines) {
    if (line.group != "curve1.1" || line.points[0][0] != line.points[1][0]) continue;
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(d.canvas.drawn_disks[k].mark.center[0] - line.points[0][0]) < 1e-9) {
        EXPECT_NEAR(y.value(line.points[1][1]), points.y[k] + points.error[k], 1e-6 * points.y[k]);
        if (k < 2)
          EXPECT_NEAR(y.value(line.points[0][1]), points.y[k] - points.error[k], 1e-6 * points.y[k]);
        else
          EXPECT_GT(line.points[0][1], d.frame.bottom());  // below zero: out of the frame
        ++found;
      }
  }
  EXPECT_EQ(found, 3);
}

// Labels of the legend cover no data, whatever the data; if there is no room they go beside the frame.
RC_GTEST_PROP(Chart, LegendCoversNoData, ()) {
  Chart chart;
  const auto curves = *rc::gen::inRange(1, 5);
  for (int c = 0; c < curves; ++c) {
    Curve curve;
    curve.style = *rc::gen::element(CurveStyle::line, CurveStyle::points, CurveStyle::cloud);
    curve.label = plain("curve " + std::to_string(c));
    for (const int v : *rc::gen::container<std::vector<int>>(25, rc::gen::inRange(0, 100))) {
      curve.x.push_back(static_cast<double>(curve.x.size()));
      curve.y.push_back(v);
    }
    chart.curves.push_back(curve);
  }
  const Drawn d = draw({chart});
  std::vector<Vec2> data;
  for (const auto& disk : d.canvas.drawn_disks)
    if (disk.clip) data.push_back(disk.mark.center);
  for (const auto& line : d.canvas.lines)
    if (line.clip)
      for (std::size_t k = 0; k + 1 < line.points.size(); ++k)
        for (int s = 0; s <= 10; ++s)
          data.push_back(line.points[k] + (s / 10.0) * (line.points[k + 1] - line.points[k]));
  RC_ASSERT(!data.empty());
  int labels = 0;
  for (const auto& t : d.canvas.texts) {
    if (!t.plain().starts_with("curve ")) continue;
    ++labels;
    const double width = text_width(t.text, t.style.size);
    RC_ASSERT(t.at[0] + width <= d.size[0]);
    for (const Vec2& p : data)
      RC_ASSERT(!(p[0] > t.at[0] && p[0] < t.at[0] + width && p[1] < t.at[1] && p[1] > t.at[1] - 0.7 * t.style.size));
  }
  RC_ASSERT(labels == curves);
}

TEST(Chart, LinesBreakWhereALogAxisCannotShowThem) {
  Chart chart;
  chart.y.log = true;
  Curve line;
  line.x = {0, 1, 2, 3, 4}, line.y = {1, 10, 0, 10, 100};
  chart.curves.push_back(line);
  const Drawn d = draw({chart});
  int pieces = 0;
  for (const auto& l : d.canvas.lines) pieces += l.group == "curve1.1";
  EXPECT_EQ(pieces, 2);
}

// At both ends of the range of doubles: whatever is drawn has a place on the page.
TEST(Chart, EveryPointHasAPlaceWhateverTheNumbers) {
  for (const bool log : {false, true})
    for (const std::vector<double>& y : {std::vector<double>{0, 1e-308, 0},
                                         {1e-308, 1e-300, 2e-300},
                                         {-1.7e308, 1, 1.7e308},
                                         {1, 1e300, 1.7e308},
                                         {5e-324, 1, 1e300},
                                         {1e-308, 1, 2}}) {
      Chart chart;
      chart.y.log = log;
      Curve line;
      line.x = {0, 1, 2}, line.y = y;
      chart.curves.push_back(line);
      line.x = y, line.y = {1, 2, 3};
      Chart turned;
      turned.x.log = log;
      turned.curves.push_back(line);
      for (const Chart& c : {chart, turned}) try {
          for (const auto& l : draw({c}).canvas.lines)
            for (const Vec2& at : l.points)
              ASSERT_TRUE(std::isfinite(at[0] + at[1])) << log << ' ' << y[0] << ' ' << y[1];
        } catch (const std::invalid_argument&) {  // nothing of it can be shown
        }
    }
}

TEST(Chart, StackedChartsShareTheirAxis) {
  Chart a, b;
  Curve line;
  line.x = {0, 1}, line.y = {0, 1};
  a.curves.push_back(line);
  line.x = {2, 10};
  b.curves.push_back(line);
  const Drawn d = draw({a, b}, true);
  std::vector<Rect> frames;
  for (const auto& box : d.canvas.boxes)
    if (!box.paint.fill) frames.push_back(box.rect);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].x, frames[1].x);
  EXPECT_GT(frames[1].y, frames[0].bottom());
  const Ruler x = x_ruler(d, false);
  for (const auto& l : d.canvas.lines) {
    const double end = l.group == "curve1.1" ? 1 : 10;
    EXPECT_TRUE(!l.group.starts_with("curve") || std::abs(x.value(l.points[1][0]) - end) < 1e-9);
  }
}

TEST(Chart, RefusesNothingToShow) {
  EXPECT_THROW(ChartFigure({}), std::invalid_argument);
  Chart chart;
  EXPECT_THROW(ChartFigure({chart}), std::invalid_argument);
  Curve line;
  line.x = {1, 2}, line.y = {-1, NAN};
  chart.curves.push_back(line);
  chart.y.log = true;
  EXPECT_THROW(ChartFigure({chart}), std::invalid_argument);
}

// Thinning keeps the extremes of every column, so the line looks the same.
TEST(Chart, ThinnedLinesKeepTheirExtremes) {
  std::vector<Vec2> line;
  for (int k = 0; k < 100000; ++k) line.push_back({{k * 1e-3, std::sin(0.37 * k) * (1 + k % 7)}});
  const auto thin = thinned(line);
  EXPECT_LE(thin.size(), 4 * 401u);
  EXPECT_EQ(thin.front(), line.front());
  EXPECT_EQ(thin.back(), line.back());
  const auto lower = [](const Vec2& a, const Vec2& b) { return a[1] < b[1]; };
  for (int column = 0; column < 400; ++column) {
    const auto in_column = [&](const std::vector<Vec2>& l) {
      std::vector<Vec2> c;
      for (const Vec2& p : l)
        if (std::floor(p[0] / 0.25) == column) c.push_back(p);
      return c;
    };
    const auto all = in_column(line), kept = in_column(thin);
    EXPECT_EQ(*std::min_element(all.begin(), all.end(), lower), *std::min_element(kept.begin(), kept.end(), lower));
    EXPECT_EQ(*std::max_element(all.begin(), all.end(), lower), *std::max_element(kept.begin(), kept.end(), lower));
  }
}

std::string text_of(const RichText& text) {
  std::string s;
  for (const TextRun& run : text) s += run.script > 0 ? "^" + run.text : run.text;
  return s;
}

TEST(NiceNumbers, OneTwoFive) {
  for (const auto& [x, below, above] : {std::tuple{1.0, 1.0, 1.0},
                                        {1.5, 1.0, 2.0},
                                        {2.0, 2.0, 2.0},
                                        {4.9, 2.0, 5.0},
                                        {5.0, 5.0, 5.0},
                                        {9.99, 5.0, 10.0},
                                        {0.003, 0.002, 0.005},
                                        {7e5, 5e5, 1e6}}) {
    EXPECT_NEAR(nice_below(x), below, 1e-12 * below) << x;
    EXPECT_NEAR(nice_above(x), above, 1e-12 * above) << x;
  }
}

TEST(NiceNumbers, AsText) {
  EXPECT_EQ(text_of(number_text(0)), "0");
  EXPECT_EQ(text_of(number_text(0.05)), "0.05");
  EXPECT_EQ(text_of(number_text(-1200)), "\u22121200");
  EXPECT_EQ(text_of(number_text(1e-4)), "10^\u22124");
  EXPECT_EQ(text_of(number_text(2.5e-7)), "2.5\u2009\u00d7\u200910^\u22127");
  EXPECT_EQ(text_of(number_text(3.14159)), "3.142");
  EXPECT_EQ(text_of(number_text_with_error(1.5216, 0.0127)), "1.522 \u00b1 0.013");
  EXPECT_EQ(text_of(number_text_with_error(1.5216, 0.041)), "1.52 \u00b1 0.04");
  EXPECT_EQ(text_of(number_text_with_error(9.13, 1.12)), "9.1 \u00b1 1.1");
  EXPECT_EQ(text_of(number_text_with_error(128.3, 41)), "128 \u00b1 41");
  EXPECT_EQ(text_of(number_text_with_error(2.79, NAN)), "2.79");
}

TEST(RichText, Markup) {
  EXPECT_EQ(rich("`F`_{0} x^{-2}"), (RichText{{"F", true, 0}, {"0", false, -1}, {" x", false, 0}, {"-2", false, 1}}));
  EXPECT_EQ(plain("max_force^{a}`b`"), (RichText{{"max_force^{a}`b`", false, 0}}));
  EXPECT_GT(text_width(rich("`F`_{0}"), 10), text_width(rich("`F`"), 10));
  EXPECT_NEAR(text_width(rich("abc"), 20), 2 * text_width(rich("abc"), 10), 0.05);
}

}  // namespace
}  // namespace isostat
