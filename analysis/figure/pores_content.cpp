#include <algorithm>
#include <cmath>

#include "analysis/figure/nice_numbers.hpp"
#include "analysis/figure/picture_content.hpp"

namespace isostat {
namespace {

constexpr int kLevels = 24;  // colours between the smallest and the largest pore

class PoresContent final : public PictureContent {
 public:
  explicit PoresContent(PoreMapOptions options) : options_(std::move(options)) {
    const auto range = options_.range ? *options_.range : radius_range(options_.pores);
    low_ = range[0], high_ = range[1];
    std::stable_sort(options_.pores.begin(), options_.pores.end(),
                     [](const PorePatch& a, const PorePatch& b) { return a.area > b.area; });
  }

  // Only outer walls are filled, the largest first: what lies inside another pore comes later, disks last.
  void draw(Canvas& canvas, const PicturePen& pen) const override {
    canvas.begin_group("pores");
    std::vector<const Polygon*> batch;
    int level = -1;
    for (const PorePatch& p : options_.pores) {
      if (const int own = level_of(p.radius); own != level) {
        if (!batch.empty()) pen.areas(canvas, batch, {color(level), std::nullopt});
        batch.clear();
        level = own;
      }
      batch.push_back(&p.wall);
    }
    if (!batch.empty()) pen.areas(canvas, batch, {color(level), std::nullopt});
    canvas.end_group();
    canvas.begin_group("disks");
    pen.disks(canvas, std::vector<std::size_t>(pen.packing().bodies.size(), 0),
              {Paint{kGrain, Stroke{kGrainOutline, pen.outline(kGrainOutline).width, {}}}});
    canvas.end_group();
  }

  std::vector<LegendItem> legend(const PicturePen&, double em) const override {
    std::vector<LegendItem> items;
    if (high_ > low_)
      items.push_back(color_bar_item(
          em, [](double t) { return sequential((t + 1) / 2); }, rich("pore radius  ") + number_text(low_, 2),
          number_text(high_, 2) + (options_.length_unit.empty() ? RichText{} : plain("\u2009")) + options_.length_unit +
              plain(" (log scale)")));
    if (options_.percolating) items.push_back(text_item(plain("white: percolating")));
    if (options_.pores.empty() && !options_.percolating) items.push_back(text_item(plain("no pores")));
    return items;
  }

 private:
  int level_of(double radius) const {
    if (!(radius > 0) || !(high_ > low_)) return 0;
    return static_cast<int>(std::lround((kLevels - 1) * std::log(radius / low_) / std::log(high_ / low_)));
  }
  static Color color(int level) { return sequential(static_cast<double>(level) / (kLevels - 1)); }

  PoreMapOptions options_;
  double low_ = 0, high_ = 0;  // [length] smallest and largest radius
};

}  // namespace

std::array<double, 2> radius_range(const std::vector<PorePatch>& pores) {
  double low = 0, high = 0;
  for (const PorePatch& p : pores)
    if (p.radius > 0) low = low > 0 ? std::min(low, p.radius) : p.radius, high = std::max(high, p.radius);
  return {low, high};
}

std::unique_ptr<PictureContent> pores_content(PoreMapOptions options) {
  return std::make_unique<PoresContent>(std::move(options));
}

}  // namespace isostat
