// Picture of a packing: its content in the frame of the cell, a legend and a length scale.
#pragma once
#include <memory>
#include <optional>

#include "analysis/figure/canvas.hpp"
#include "analysis/figure/legend.hpp"
#include "analysis/figure/picture_content.hpp"
#include "dem/state/packing.hpp"

namespace isostat {

class PackingPicture {
 public:
  // Keeps a reference to the packing. length_unit: of the scale bar, may be empty. Throws std::invalid_argument for a
  // packing without bodies.
  PackingPicture(const Packing<2>& packing, std::unique_ptr<PictureContent> content, const RichText& length_unit = {});
  Vec2 size() const { return size_; }  // [pt] of the page
  void draw(Canvas& canvas) const;

 private:
  std::unique_ptr<PictureContent> content_;
  PicturePen pen_;
  std::optional<Legend> legend_;
  Vec2 legend_place_{}, size_{};
};

}  // namespace isostat
