// The window of a picture: the periodic cell, or the box around an isolated packing, and its place on the page.
#pragma once
#include <cmath>
#include <optional>

#include "analysis/figure/canvas.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

class PictureFrame {
 public:
  // `margin` [length of the packing] is left around an isolated packing, beside a narrow one of its own. Throws
  // std::invalid_argument for a packing without bodies.
  explicit PictureFrame(const Packing<2>& packing, double margin = 0);

  void place(const Vec2& top_left) { place_ = top_left; }
  double scale() const { return scale_; }  // [pt per unit length]
  Rect box() const { return {place_[0], place_[1], scale_ * size_[0], scale_ * size_[1]}; }
  bool periodic() const { return cell_.has_value(); }
  double mean_diameter() const { return mean_diameter_; }

  Vec2 page(const Vec2& r) const {  // [pt] of a point of the packing; y turns over
    return {place_[0] + scale_ * (r[0] - origin_[0]), place_[1] + scale_ * (size_[1] - (r[1] - origin_[1]))};
  }
  Vec2 wrap(const Vec2& r) const { return cell_ ? cell_->wrap(r) : r; }

  // Calls draw(offset) for each lattice offset at which something inside [low, high] shows in the window.
  template <class Draw>
  void for_visible_images(const Vec2& low, const Vec2& high, Draw&& draw) const {
    if (!cell_) return draw(Vec2{});
    const auto& l = cell_->length;
    for (double m = std::floor(-high[0] / l[0]) + 1; low[0] + m * l[0] < l[0]; ++m)
      for (double n = std::floor(-high[1] / l[1]) + 1; low[1] + n * l[1] < l[1]; ++n) draw(Vec2{{m * l[0], n * l[1]}});
  }

 private:
  std::optional<PeriodicCell<2>> cell_;
  Vec2 origin_{}, size_{};  // [length of the packing] lower left corner and edges of the window
  double mean_diameter_ = 0, scale_ = 1;
  Vec2 place_{};
};

}  // namespace isostat
