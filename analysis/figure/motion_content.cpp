#include <algorithm>
#include <cmath>

#include "analysis/figure/nice_numbers.hpp"
#include "analysis/figure/picture_content.hpp"

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

class MotionContent final : public PictureContent {
 public:
  explicit MotionContent(MotionOptions options) : options_(std::move(options)) {
    double square = 0;
    for (const Vec2& v : options_.velocity) square += dot(v, v), largest_ = std::max(largest_, norm(v));
    const double rms = std::sqrt(square / static_cast<double>(options_.velocity.size()));
    unit_ = std::max(rms, largest_ / kLongest);
    std::vector<double> spin;
    for (const double w : options_.spin) spin.push_back(std::abs(w));
    std::sort(spin.begin(), spin.end());
    double limit = spin[static_cast<std::size_t>(kSpinPercentile * static_cast<double>(spin.size() - 1))];
    if (limit == 0) limit = spin.back();
    if (limit > 0) spin_limit_ = nice_above(limit);
  }

  // The largest arrow may start at the edge of the outermost disk.
  double margin(const Packing<2>& packing) const override {
    double diameter = 0;
    for (const double r : packing.bodies.radius) diameter += 2 * r / static_cast<double>(packing.bodies.size());
    return unit_ > 0 ? diameter * std::max(0.0, largest_ / unit_ - 0.5) : 0;
  }

  void draw(Canvas& canvas, const PicturePen& pen) const override {
    canvas.begin_group("disks");
    std::vector<std::size_t> style;
    for (const double w : options_.spin) {
      const double t = spin_limit_ > 0 ? std::clamp(w / spin_limit_, -1.0, 1.0) : 0;
      style.push_back(static_cast<std::size_t>(std::lround(kSpinSteps * (t + 1))));
    }
    std::vector<Paint> paints;
    for (int k = -kSpinSteps; k <= kSpinSteps; ++k)
      paints.push_back({diverging(static_cast<double>(k) / kSpinSteps), pen.outline(kDiskOutline)});
    pen.disks(canvas, style, paints);
    canvas.end_group();
    canvas.begin_group("velocities");
    canvas.polygons(arrows(pen), {kInk, std::nullopt});
    canvas.end_group();
  }

  std::vector<LegendItem> legend(const PicturePen& pen, double em) const override {
    std::vector<LegendItem> items;
    if (unit_ > 0) {
      const double per_speed = pen.diameter() / unit_, speed = nice_below(std::min(1.5 * unit_, 4 * em / per_speed));
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
    if (spin_limit_ > 0)
      items.push_back(color_bar_item(em, diverging, options_.spin_name + plain("  ") + number_text(-spin_limit_),
                                     number_with_unit(spin_limit_, options_.spin_unit)));
    for (const RichText& note : options_.notes) items.push_back(text_item(note));
    return items;
  }

 private:
  std::vector<Polygon> arrows(const PicturePen& pen) const {
    std::vector<Polygon> marks;
    if (!(unit_ > 0)) return marks;
    const PictureFrame& frame = pen.frame();
    const double shaft = std::clamp(0.08 * pen.diameter(), 0.3, 2.5), reach = 3 * shaft / frame.scale();
    const double per_speed = frame.mean_diameter() / unit_;  // [length]
    for (std::size_t i = 0; i < options_.velocity.size(); ++i) {
      const Vec2 d = per_speed * options_.velocity[i];
      const Vec2 on_page{{frame.scale() * d[0], -frame.scale() * d[1]}};
      if (norm(on_page) < kShortest) continue;
      const Vec2 from = frame.wrap(pen.packing().bodies.position[i]), to = from + d;
      Vec2 low, high;
      for (int k = 0; k < 2; ++k) low[k] = std::min(from[k], to[k]) - reach, high[k] = std::max(from[k], to[k]) + reach;
      frame.for_visible_images(
          low, high, [&](const Vec2& offset) { marks.push_back(arrow(frame.page(from + offset), on_page, shaft)); });
    }
    return marks;
  }

  MotionOptions options_;
  double largest_ = 0;     // speed
  double unit_ = 0;        // speed drawn as one mean diameter: the rms, unless the largest would be too long
  double spin_limit_ = 0;  // end of the colour bar; 0: nothing spins
};

}  // namespace

std::unique_ptr<PictureContent> motion_content(MotionOptions options) {
  return std::make_unique<MotionContent>(std::move(options));
}

}  // namespace isostat
