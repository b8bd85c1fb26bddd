#include <algorithm>

#include "analysis/figure/sphere_content.hpp"

namespace isostat {
namespace {

class SphereMotionContent final : public SphereContent {
 public:
  SphereMotionContent(MotionOptions options, const View& view) : marks_(std::move(options)), view_(view) {}

  // So that no arrow leads out of the window.
  double margin(const SpherePacking& packing) const override {
    const double unit = marks_.options().scale->unit;
    if (!(unit > 0)) return 0;
    const Extent extent = extent_of(packing, view_);
    const Vec3 middle = middle_of(packing);
    double most = 0;
    for (std::size_t k = 0; k < packing.bodies.size(); ++k) {
      const Vec3& r = packing.bodies.position[k];
      const Vec2 from = view_.flat((packing.cell ? packing.cell->wrap(r) : r) - middle);
      const Vec2 tip = from + (extent.diameter / unit) * marks_.options().velocity[k];
      for (int c = 0; c < 2; ++c) most = std::max({most, extent.low[c] - tip[c], tip[c] - extent.high[c]});
    }
    return most;
  }

  void draw(Canvas& canvas, const SpherePen& pen) const override {
    const std::vector<std::size_t> style = marks_.styles();
    std::vector<Color> colors;
    for (const Paint& paint : marks_.paints({})) colors.push_back(*paint.fill);
    std::vector<Vec2> places;
    for (std::size_t k = 0; k < style.size(); ++k) places.push_back(pen.view().flat(pen.place(k)));
    canvas.begin_group("spheres");
    for (const auto& layer : pen.layers()) {
      pen.balls(canvas, layer, style, colors);
      canvas.polygons(marks_.arrows(pen, places, layer), {kInk, std::nullopt});
    }
    canvas.end_group();
  }

  std::vector<LegendItem> legend(const SpherePen& pen, double em) const override { return marks_.legend(pen, em); }

 private:
  MotionMarks marks_;
  View view_;
};

std::vector<double> along(const SphereMotion& motion, const View& view) {
  std::vector<double> toward;
  for (const Vec3& v : motion.velocity) toward.push_back(view.depth(v));
  return toward;
}

}  // namespace

MotionScale motion_scale(const SphereMotion& motion, const View& view) {
  std::vector<Vec2> speeds;
  for (const Vec3& v : motion.velocity) speeds.push_back({{norm(v), 0}});
  return motion_scale(speeds, along(motion, view));
}

std::unique_ptr<SphereContent> sphere_motion_content(const SphereMotion& motion, const View& view,
                                                     const MotionScale& scale) {
  std::vector<Vec2> across;
  for (const Vec3& v : motion.velocity) across.push_back(view.flat(v));
  MotionOptions options{std::move(across), along(motion, view), rich("`v`"), plain("toward viewer"),
                        motion.speed_unit, motion.speed_unit,   {},          scale};
  return std::make_unique<SphereMotionContent>(std::move(options), view);
}

}  // namespace isostat
