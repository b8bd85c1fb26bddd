#include "analysis/figure/picture_frame.hpp"

#include <algorithm>
#include <stdexcept>

namespace isostat {
namespace {

constexpr double kDiameterOnPage = 15;                      // [pt] aim for the mean diameter
constexpr double kSmallestEdge = 280, kLargestEdge = 1400;  // [pt] bounds for the longer edge of the window
constexpr double kMargin = 0.1;                             // [mean diameter] around an isolated packing

}  // namespace

PictureFrame::PictureFrame(const Packing<2>& packing, double margin) : cell_(packing.cell) {
  const Bodies<2>& b = packing.bodies;
  if (b.size() == 0) throw std::invalid_argument("a picture needs grains");
  for (const double r : b.radius) mean_diameter_ += 2 * r / static_cast<double>(b.size());
  if (cell_) {
    size_ = cell_->length;
  } else {
    Vec2 low = b.position[0], high = low;
    for (std::size_t i = 0; i < b.size(); ++i)
      for (int k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], b.position[i][k] - b.radius[i]);
        high[k] = std::max(high[k], b.position[i][k] + b.radius[i]);
      }
    margin += kMargin * mean_diameter_;
    origin_ = low - Vec2{{margin, margin}};
    size_ = high - low + Vec2{{2 * margin, 2 * margin}};
  }
  const double longer = std::max(size_[0], size_[1]);
  scale_ = std::clamp(kDiameterOnPage / mean_diameter_ * longer, kSmallestEdge, kLargestEdge) / longer;
}

}  // namespace isostat
