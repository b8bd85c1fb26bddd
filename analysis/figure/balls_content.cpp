#include "analysis/figure/sphere_content.hpp"

namespace isostat {
namespace {

class BallsContent final : public SphereContent {
 public:
  BallsContent(std::vector<std::size_t> style, std::vector<BallStyle> styles)
      : style_(std::move(style)), styles_(std::move(styles)) {}

  void draw(Canvas& canvas, const SpherePen& pen) const override {
    std::vector<Color> colors;
    for (const BallStyle& s : styles_) colors.push_back(s.color);
    canvas.begin_group("spheres");
    for (const auto& layer : pen.layers()) pen.balls(canvas, layer, style_, colors);
    canvas.end_group();
  }

  std::vector<LegendItem> legend(const SpherePen&, double em) const override {
    std::vector<LegendItem> items;
    for (const BallStyle& s : styles_)
      if (!s.label.empty()) items.push_back(ball_item(em, s.color, s.label));
    return items;
  }

 private:
  std::vector<std::size_t> style_;
  std::vector<BallStyle> styles_;
};

}  // namespace

std::unique_ptr<SphereContent> balls_content(std::vector<std::size_t> style, std::vector<BallStyle> styles) {
  return std::make_unique<BallsContent>(std::move(style), std::move(styles));
}

}  // namespace isostat
