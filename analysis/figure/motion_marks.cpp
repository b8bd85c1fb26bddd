#include "analysis/figure/motion_marks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/figure/nice_numbers.hpp"

namespace isostat {
namespace {

constexpr int kSpinSteps = 32;            // shades on each side of zero
constexpr double kSpinPercentile = 0.95;  // of |spin|: there the colours end
constexpr double kShortest = 0.3;         // [pt] arrows below it would not be seen
constexpr double kLongest = 4;            // [mean diameter] arrows of a localised motion

// Tail at `tail`, along d [pt]; seven corners.
Polygon arrow(const Vec2& tail, const Vec2& d, double shaft) {
  const double length = norm(d), head = std::min(0.45 * length, 5 * shaft), wing = 0.5 * head;
  const Vec2 u = (1 / length) * d, n{{-u[1], u[0]}};
  const Vec2 neck = tail + (length - head) * u;
  const double h = 0.5 * std::min(shaft, wing);
  return {tail + h * n, neck + h * n, neck + wing * n, tail + d, neck - wing * n, neck - h * n, tail - h * n};
}

}  // namespace

MotionScale motion_scale(const std::vector<Vec2>& velocity, const std::vector<double>& spin) {
  MotionScale scale;
  if (velocity.empty()) return scale;
  double square = 0;
  for (const Vec2& v : velocity) square += dot(v, v), scale.largest = std::max(scale.largest, norm(v));
  scale.unit = std::max(std::sqrt(square / static_cast<double>(velocity.size())), scale.largest / kLongest);
  std::vector<double> sorted;
  for (const double w : spin) sorted.push_back(std::abs(w));
  std::sort(sorted.begin(), sorted.end());
  double limit = sorted[static_cast<std::size_t>(kSpinPercentile * static_cast<double>(sorted.size() - 1))];
  if (limit == 0) limit = sorted.back();
  if (limit > 0) scale.spin_limit = nice_above(limit);
  return scale;
}

MotionMarks::MotionMarks(MotionOptions options)
    : options_(std::move(options)),
      scale_(options_.scale ? *options_.scale : motion_scale(options_.velocity, options_.spin)) {}

double MotionMarks::margin(double mean_diameter) const {
  return scale_.unit > 0 ? mean_diameter * std::max(0.0, scale_.largest / scale_.unit - 0.5) : 0;
}

std::vector<std::size_t> MotionMarks::styles() const {
  std::vector<std::size_t> style;
  for (const double w : options_.spin) {
    const double t = scale_.spin_limit > 0 ? std::clamp(w / scale_.spin_limit, -1.0, 1.0) : 0;
    style.push_back(static_cast<std::size_t>(std::lround(kSpinSteps * (t + 1))));
  }
  return style;
}

std::vector<Paint> MotionMarks::paints(const Stroke& outline) const {
  std::vector<Paint> paints;
  for (int k = -kSpinSteps; k <= kSpinSteps; ++k)
    paints.push_back({diverging(static_cast<double>(k) / kSpinSteps), outline});
  return paints;
}

void MotionMarks::draw_arrows(Canvas& canvas, const FramePen& pen, const std::vector<Vec2>& places) const {
  std::vector<std::size_t> all(options_.velocity.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  canvas.begin_group("velocities");
  canvas.polygons(arrows(pen, places, all), {kInk, std::nullopt});
  canvas.end_group();
}

std::vector<Polygon> MotionMarks::arrows(const FramePen& pen, const std::vector<Vec2>& places,
                                         std::span<const std::size_t> grains) const {
  const PictureFrame& frame = pen.frame();
  const double shaft = std::clamp(0.08 * pen.diameter(), 0.3, 2.5), reach = 3 * shaft / frame.scale();
  std::vector<Polygon> marks;
  if (!(scale_.unit > 0)) return marks;
  for (const std::size_t i : grains) {
    const Vec2 d = frame.mean_diameter() / scale_.unit * options_.velocity[i];
    const Vec2 on_page{{frame.scale() * d[0], -frame.scale() * d[1]}};
    if (norm(on_page) < kShortest) continue;
    const Vec2 from = frame.wrap(places[i]), to = from + d;
    Vec2 low, high;
    for (int k = 0; k < 2; ++k) low[k] = std::min(from[k], to[k]) - reach, high[k] = std::max(from[k], to[k]) + reach;
    frame.for_visible_images(
        low, high, [&](const Vec2& offset) { marks.push_back(arrow(frame.page(from + offset), on_page, shaft)); });
  }
  return marks;
}

std::vector<LegendItem> MotionMarks::legend(const FramePen& pen, double em) const {
  std::vector<LegendItem> items;
  if (scale_.unit > 0) {
    const double per_speed = pen.diameter() / scale_.unit,
                 speed = nice_below(std::min(1.5 * scale_.unit, 4 * em / per_speed));
    const double length = per_speed * speed, shaft = std::clamp(0.09 * length, 0.6, 2.5);
    items.push_back({length,
                     [=](Canvas& canvas, const Vec2& p) {
                       const Polygon mark = arrow(p, {{length, 0}}, shaft);
                       canvas.polygons({&mark, 1}, {kInk, std::nullopt});
                     },
                     options_.symbol + plain(" = ") + number_with_unit(speed, options_.speed_unit)});
  } else {
    items.push_back(text_item(plain("at rest")));
  }
  if (scale_.spin_limit > 0)
    items.push_back(color_bar_item(em, diverging, options_.spin_name + plain("  ") + number_text(-scale_.spin_limit),
                                   number_with_unit(scale_.spin_limit, options_.spin_unit)));
  for (const RichText& note : options_.notes) items.push_back(text_item(note));
  return items;
}

}  // namespace isostat
