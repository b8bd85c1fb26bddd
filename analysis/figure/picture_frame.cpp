#include "analysis/figure/picture_frame.hpp"

#include <algorithm>
#include <stdexcept>

namespace isostat {
namespace {

constexpr double kDiameterOnPage = 15;  // [pt] aim for the mean diameter
constexpr double kLargestEdge = 1400;   // [pt] bound for the longer edge of the window
constexpr double kMargin = 0.1;         // [mean diameter] around an isolated packing

}  // namespace

void set_cell(Extent& extent, const PeriodicCell<2>& cell) {
  extent.cell = cell;
  extent.low = {{std::min(0.0, cell.tilt), 0}};
  extent.high = cell.length + Vec2{{std::max(0.0, cell.tilt), 0}};
}

Extent extent_of(const Packing<2>& packing, double margin) {
  const Bodies<2>& b = packing.bodies;
  if (b.size() == 0) throw std::invalid_argument("a picture needs grains");
  Extent extent;
  const std::size_t grains = count_free(packing);  // an emptied hopper: its walls set the scale
  for (std::size_t k = 0; k < b.size(); ++k)
    if (grains == 0 || is_free(packing.part, k))
      extent.diameter += 2 * b.radius[k] / static_cast<double>(grains == 0 ? b.size() : grains);
  if (packing.cell) {
    set_cell(extent, *packing.cell);
    return extent;
  }
  extent.low = extent.high = b.position[0];
  for (std::size_t i = 0; i < b.size(); ++i)
    for (int k = 0; k < 2; ++k) {
      extent.low[k] = std::min(extent.low[k], b.position[i][k] - b.radius[i]);
      extent.high[k] = std::max(extent.high[k], b.position[i][k] + b.radius[i]);
    }
  margin += kMargin * extent.diameter;
  extent.low -= Vec2{{margin, margin}};
  extent.high += Vec2{{margin, margin}};
  return extent;
}

Extent around(const Extent& a, const Extent& b) {
  Extent whole = a;
  for (int k = 0; k < 2; ++k)
    whole.low[k] = std::min(a.low[k], b.low[k]), whole.high[k] = std::max(a.high[k], b.high[k]);
  whole.diameter = std::max(a.diameter, b.diameter);
  if (whole.cell) whole.cell->length = whole.high;
  return whole;
}

PictureFrame::PictureFrame(const Extent& own, const Extent& whole)
    : cell_(own.cell), cut_(own.cut), mean_diameter_(whole.diameter) {
  const Vec2 room = whole.high - whole.low;
  origin_ = cell_ ? own.low : whole.low;
  size_ = cell_ ? own.high - own.low : room;
  inset_ = 0.5 * (room - size_);
  const double longer = std::max(room[0], room[1]);
  scale_ = std::clamp(kDiameterOnPage / mean_diameter_ * longer, whole.smallest_edge, kLargestEdge) / longer;
}

std::optional<Polygon> PictureFrame::tilted_cell() const {
  if (!cell_ || cell_->tilt == 0) return std::nullopt;
  Polygon corners;
  for (const Vec2& f : {Vec2{{0, 0}}, Vec2{{1, 0}}, Vec2{{1, 1}}, Vec2{{0, 1}}})
    corners.push_back(page(cell_->point(f)));
  return corners;
}

}  // namespace isostat
