// The window of a picture: the periodic cell, or the box around an isolated packing, and its place on the page.
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/figure/canvas.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

// What a packing takes up, in its own units of length.
struct Extent {
  std::optional<PeriodicCell<2>> cell;  // the window is then the rectangle around it
  Vec2 low{}, high{};                   // corners of the window
  double diameter = 0;                  // mean of the grains
  bool cut = false;                     // what stands out of the window is cut off; a cell always cuts
  double smallest_edge = 280;           // [pt] bound for the longer edge of the window
};

// `margin` is left around an isolated packing, beside a narrow one of its own. Throws std::invalid_argument for a
// packing without bodies.
Extent extent_of(const Packing<2>& packing, double margin = 0);

// The window around a cell, however it leans.
void set_cell(Extent& extent, const PeriodicCell<2>& cell);

// Room for both, one over the other; cells of two sizes have their centres in common.
Extent around(const Extent& a, const Extent& b);

class PictureFrame {
 public:
  explicit PictureFrame(const Extent& own) : PictureFrame(own, own) {}
  // One of several pictures of one scale: on a page for `whole`, which has room for `own`.
  PictureFrame(const Extent& own, const Extent& whole);

  void enlarge(double factor) { scale_ *= factor; }  // before it is placed

  void place(const Vec2& top_left) { place_ = top_left + scale_ * inset_; }  // [pt] of the room for the whole
  double scale() const { return scale_; }                                    // [pt per unit length]
  Rect box() const { return {place_[0], place_[1], scale_ * size_[0], scale_ * size_[1]}; }
  Vec2 room() const { return scale_ * (size_ + 2 * inset_); }  // [pt] for the whole
  bool periodic() const { return cell_.has_value(); }
  bool cuts() const { return cut_ || periodic(); }
  double mean_diameter() const { return mean_diameter_; }

  Vec2 page(const Vec2& r) const {  // [pt] of a point of the packing; y turns over
    return {{place_[0] + scale_ * (r[0] - origin_[0]), place_[1] + scale_ * (size_[1] - (r[1] - origin_[1]))}};
  }
  std::optional<Polygon> tilted_cell() const;  // [pt] its corners, if it is no rectangle

  Vec2 wrap(const Vec2& r) const { return cell_ ? cell_->wrap(r) : r; }

  // Calls draw(offset) for each lattice offset at which something inside [low, high] shows in the window.
  template <class Draw>
  void for_visible_images(const Vec2& low, const Vec2& high, Draw&& draw) const {
    if (!cell_) return draw(Vec2{});
    const auto& l = cell_->length;
    if (const double tilt = cell_->tilt; tilt != 0) {
      const double left = std::min(0.0, tilt), right = l[0] + std::max(0.0, tilt);
      for (double n = std::floor(-high[1] / l[1]) + 1; low[1] + n * l[1] < l[1]; ++n)
        for (double m = std::floor((left - high[0] - n * tilt) / l[0]) + 1; low[0] + n * tilt + m * l[0] < right; ++m)
          draw(Vec2{{n * tilt + m * l[0], n * l[1]}});
      return;
    }
    for (double m = std::floor(-high[0] / l[0]) + 1; low[0] + m * l[0] < l[0]; ++m)
      for (double n = std::floor(-high[1] / l[1]) + 1; low[1] + n * l[1] < l[1]; ++n) draw(Vec2{{m * l[0], n * l[1]}});
  }

 private:
  std::optional<PeriodicCell<2>> cell_;
  bool cut_ = false;
  Vec2 origin_{}, size_{};  // [length of the packing] lower left corner and edges of the window
  Vec2 inset_{};            // [length of the packing] on each side, to the whole
  double mean_diameter_ = 0, scale_ = 1;
  Vec2 place_{};
};

}  // namespace isostat
